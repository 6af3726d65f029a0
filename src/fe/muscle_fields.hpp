/// Fields of a muscle run for ParaView: nodal ones as they are, those of quadrature points by a projection in each
/// cell.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/muscle_system.hpp"
#include "solve/model.hpp"

namespace titin {

class MuscleFields {
 public:
  explicit MuscleFields(MuscleSystem& system);

  /// `u_old`, and the step that the system holds, give the rates. Collective.
  void update(const mfem::Vector& u, const mfem::Vector& v, const mfem::Vector& u_old);
  void set_ellipticity(const std::vector<double>& of_cells);
  const std::vector<Field>& fields() const { return fields_; }

 private:
  mfem::ParGridFunction* add(const std::string& name, const std::string& unit, mfem::ParFiniteElementSpace& space);
  void project(int cell, const std::vector<double>& at_points, int components, mfem::ParGridFunction& field);
  void update_points(int cell, const Material& material, const ThreeField& kernel);

  MuscleSystem& system_;
  mfem::L2_FECollection cell_collection_, constant_collection_;
  mfem::ParFiniteElementSpace scalars_, vectors_, tensors_, constants_;
  mfem::DenseMatrix projection_;  // cell dofs x points: least squares in the reference cell
  std::vector<std::unique_ptr<mfem::ParGridFunction>> storage_;
  std::vector<Field> fields_;
  mfem::ParGridFunction *displacement_, *velocity_, *pressure_, *dilatation_, *stretch_, *rate_, *activation_,
      *direction_, *stress_, *ellipticity_ = nullptr;
};

}  // namespace titin
