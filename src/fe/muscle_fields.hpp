/// Fields of a muscle run for ParaView: nodal ones as they are, those of quadrature points by a projection in each
/// cell.
#pragma once

#include <array>
#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/muscle_system.hpp"
#include "fe/stress_recovery.hpp"
#include "solve/field_list.hpp"

namespace titin {

class MuscleFields {
 public:
  explicit MuscleFields(MuscleSystem& system);

  /// The step that the system holds gives the rates. Collective.
  void update(const mfem::Vector& u, const mfem::Vector& v);
  void set_stress_error(const StressRecovery& recovery);
  void set_ellipticity(const std::vector<double>& of_cells);
  const std::vector<Field>& fields() const { return fields_.fields(); }

 private:
  mfem::Geometry::Type geometry_of(int cell) const;
  void draw(const mfem::Vector& true_values, mfem::ParGridFunction& field);
  void project(int cell, const std::vector<double>& at_points, int components, mfem::ParGridFunction& field);
  void update_points(int cell, const Material& material, const ThreeField& kernel);

  MuscleSystem& system_;
  mfem::H1_FECollection nodal_collection_;
  mfem::L2_FECollection cell_collection_, constant_collection_;
  mfem::ParFiniteElementSpace nodal_, scalars_, vectors_, tensors_, constants_;
  // By geometry of the cell:
  std::array<mfem::DenseMatrix, mfem::Geometry::NumGeom> projection_;  // cell dofs x points: least squares in the cell
  std::array<mfem::DenseMatrix, mfem::Geometry::NumGeom> evaluation_;  // drawn nodes x nodes
  FieldList fields_;
  mfem::ParGridFunction *displacement_, *velocity_, *pressure_, *dilatation_, *stretch_, *rate_, *activation_,
      *direction_, *stress_, *stress_error_ = nullptr, *ellipticity_ = nullptr;
};

}  // namespace titin
