#include "rod/rod_fields.hpp"

#include "base/parallel.hpp"

namespace titin {

RodFields::RodFields(RodSystem& system, mfem::ParMesh& mesh)
    : system_(system),
      first_(0),
      nodal_collection_(system.config().element_order(), 1),
      cell_collection_(system.config().element_order() - 1, 1),
      nodal_(&mesh, &nodal_collection_, 3, mfem::Ordering::byVDIM),
      cells_(&mesh, &cell_collection_) {
  const int count = static_cast<int>(system.lattice().elements().size());
  while (first_ < count && static_cast<long>(first_) * ranks() / count < rank()) ++first_;
  displacement_ = fields_.add("displacement", "m", nodal_);
  velocity_ = fields_.add("velocity", "m/s", nodal_);
  stretch_ = fields_.add("stretch", "", cells_);
  rate_ = fields_.add("stretch_rate", "1/s", cells_);
}

void RodFields::update(const mfem::Vector& u, const mfem::Vector& v) {
  draw(u, *displacement_);
  draw(v, *velocity_);
  draw_slope(u, 1, *stretch_);
  draw_slope(v, 0, *rate_);
}

/// Along x; y and z are zero.
void RodFields::draw(const mfem::Vector& values, mfem::ParGridFunction& field) const {
  mfem::Array<int> dofs;
  for (int e = 0; e < nodal_.GetNE(); ++e) {
    const RodElement& element = system_.lattice().elements()[first_ + e];
    nodal_.GetElementDofs(e, dofs);
    const mfem::IntegrationRule& places = nodal_.GetFE(e)->GetNodes();
    for (int k = 0; k < dofs.Size(); ++k) {
      const auto N = element.shape(places.IntPoint(k).x);
      double value = 0;
      for (int a = 0; a < element.nodes; ++a) value += N[a] * values(element.first + a);
      field(nodal_.DofToVDof(dofs[k], 0)) = value;
    }
  }
}

void RodFields::draw_slope(const mfem::Vector& values, double rest, mfem::ParGridFunction& field) const {
  mfem::Array<int> dofs;
  for (int e = 0; e < cells_.GetNE(); ++e) {
    const RodElement& element = system_.lattice().elements()[first_ + e];
    cells_.GetElementDofs(e, dofs);
    const mfem::IntegrationRule& places = cells_.GetFE(e)->GetNodes();
    for (int k = 0; k < dofs.Size(); ++k) {
      const auto G = element.gradient(places.IntPoint(k).x);
      field(dofs[k]) = rest;
      for (int a = 0; a < element.nodes; ++a) field(dofs[k]) += G[a] * values(element.first + a);
    }
  }
}

}  // namespace titin
