/// Fields of a rod for ParaView, on the mesh of its elements.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <vector>

#include "rod/rod_system.hpp"
#include "solve/field_list.hpp"

namespace titin {

class RodFields {
 public:
  RodFields(RodSystem& system, mfem::ParMesh& mesh);
  void update(const mfem::Vector& u, const mfem::Vector& v);
  const std::vector<Field>& fields() const { return fields_.fields(); }

 private:
  void draw(const mfem::Vector& values, mfem::ParGridFunction& field) const;
  void draw_slope(const mfem::Vector& values, double rest, mfem::ParGridFunction& field) const;

  RodSystem& system_;
  int first_;  // of this rank's elements
  mfem::H1_FECollection nodal_collection_;
  mfem::L2_FECollection cell_collection_;
  mfem::ParFiniteElementSpace nodal_, cells_;
  FieldList fields_;
  mfem::ParGridFunction *displacement_, *velocity_, *stretch_, *rate_;
};

}  // namespace titin
