#include "solve/block_dofs.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace titin {

LocalDofs::LocalDofs(PetscInt owned, std::vector<PetscInt> touched) : owned_(owned) {
  PetscLayout layout;
  check(PetscLayoutCreate(PETSC_COMM_WORLD, &layout));
  check(PetscLayoutSetLocalSize(layout, owned));
  check(PetscLayoutSetUp(layout));
  check(PetscLayoutGetRange(layout, &first_, nullptr));
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (PetscInt dof : touched)
    if (dof >= 0 && (dof < first_ || dof >= first_ + owned)) ghosts_.push_back(dof);
  if (ranks() > 1) {
    check(PetscSFCreate(PETSC_COMM_WORLD, &exchange_));
    check(PetscSFSetGraphLayout(exchange_, layout, static_cast<PetscInt>(ghosts_.size()), nullptr, PETSC_COPY_VALUES,
                                ghosts_.data()));
    check(PetscSFSetUp(exchange_));
  }
  check(PetscLayoutDestroy(&layout));
}

LocalDofs::~LocalDofs() { PetscSFDestroy(&exchange_); }

int LocalDofs::local(PetscInt global) const {
  if (global < 0) return zero();
  if (global >= first_ && global < first_ + owned_) return static_cast<int>(global - first_);
  return owned_ + static_cast<int>(std::lower_bound(ghosts_.begin(), ghosts_.end(), global) - ghosts_.begin());
}

void LocalDofs::fetch(void* v, MPI_Datatype type) const {
  if (!exchange_) return;
  char* ghosts = static_cast<char*>(v) + owned_ * (type == MPI_FLOAT ? sizeof(float) : sizeof(double));
  check(PetscSFBcastBegin(exchange_, type, v, ghosts, MPI_REPLACE));
  check(PetscSFBcastEnd(exchange_, type, v, ghosts, MPI_REPLACE));
}

void LocalDofs::add(void* v, MPI_Datatype type, std::size_t bytes) const {
  if (!exchange_) return;
  const char* ghosts = static_cast<const char*>(v) + owned_ * bytes;
  check(PetscSFReduceBegin(exchange_, type, ghosts, v, MPI_SUM));
  check(PetscSFReduceEnd(exchange_, type, ghosts, v, MPI_SUM));
}

}  // namespace titin
