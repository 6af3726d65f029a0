/// Fields of a Lagrangian run for ParaView: one value for each cell, on the mesh where its nodes are now.
#pragma once

#include <memory>

#include "fv/scheme.hpp"
#include "solve/field_list.hpp"

namespace titin {

template <int D>
class LagrangeFields {
 public:
  /// Both stay the caller's. The mesh is moved by update.
  LagrangeFields(mfem::ParMesh& mesh, const FlowScheme<D>& scheme);
  void update(double time);
  const std::vector<Field>& fields() const { return fields_.fields(); }

 private:
  void write(std::span<const int> cells, const Closure& closure, double time);

  mfem::ParMesh& mesh_;
  const FlowScheme<D>& scheme_;
  mfem::L2_FECollection constant_;
  mfem::ParFiniteElementSpace scalars_, vectors_, tensors_;
  FieldList fields_;
  mfem::ParGridFunction *density_, *pressure_, *energy_, *ratio_, *order_, *velocity_, *stress_,
      *fibre_stretch_ = nullptr;  // null: no rank has fibres
};

extern template class LagrangeFields<2>;
extern template class LagrangeFields<3>;

}  // namespace titin
