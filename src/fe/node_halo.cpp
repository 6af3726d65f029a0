#include "fe/node_halo.hpp"

#include <algorithm>

#include "solve/petsc.hpp"

namespace titin {

NodeHalo::NodeHalo(const mfem::ParFiniteElementSpace& space)
    : components_(space.GetVDim()), owned_(space.GetTrueVSize() / space.GetVDim()), number_(space.GetNDofs()) {
  struct Other {
    PetscInt global;
    int node;
  };
  std::vector<Other> others;
  for (int node = 0; node < space.GetNDofs(); ++node) {
    const int dof = components_ * node, own = space.GetLocalTDofNumber(dof);
    number_[node] = own / components_;
    if (own < 0) others.push_back({static_cast<PetscInt>(space.GetGlobalTDofNumber(dof) / components_), node});
  }
  std::sort(others.begin(), others.end(), [](const Other& a, const Other& b) { return a.global < b.global; });
  PetscLayout layout;
  check(PetscLayoutCreateFromSizes(PETSC_COMM_WORLD, owned_, PETSC_DECIDE, 1, &layout));
  std::vector<Exchange::Part> parts;
  std::vector<PetscInt> asked;
  for (const Other& other : others) {
    PetscMPIInt owner;
    check(PetscLayoutFindOwner(layout, other.global, &owner));
    if (parts.empty() || parts.back().rank != owner) parts.push_back({owner, 0});
    ++parts.back().count;
    number_[other.node] = owned_ + static_cast<int>(asked.size());
    asked.push_back(other.global);
  }
  PetscInt first;
  check(PetscLayoutGetRange(layout, &first, nullptr));
  check(PetscLayoutDestroy(&layout));
  exchange_ = std::make_unique<Exchange>(parts);
  back_ = std::make_unique<Exchange>(exchange_->reversed());
  std::vector<PetscInt> lent(exchange_->received());
  exchange_->begin(asked.data(), lent.data());
  exchange_->end();
  for (PetscInt global : lent) lent_.push_back(static_cast<int>(global - first));
  doubles_.resize(lent_.size() * components_);
  floats_.resize(lent_.size() * components_);
}

}  // namespace titin
