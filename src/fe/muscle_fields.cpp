#include "fe/muscle_fields.hpp"

namespace titin {

namespace {

constexpr int tensor_components = 6;  // xx, yy, zz, xy, yz, xz: VTK's order of symmetric tensors
constexpr int tensor_row[] = {0, 1, 2, 0, 1, 0}, tensor_column[] = {0, 1, 2, 1, 2, 2};

/// The matrix that takes values at points to the dofs of the polynomial nearest to them, weighted as the rule weighs.
mfem::DenseMatrix projection_matrix(const mfem::FiniteElement& element, const mfem::IntegrationRule& rule) {
  const int dofs = element.GetDof(), points = rule.GetNPoints();
  mfem::DenseMatrix mass(dofs), moment(dofs, points), projection(dofs, points);
  mfem::Vector N(dofs);
  mass = 0.0;
  for (int q = 0; q < points; ++q) {
    element.CalcShape(rule.IntPoint(q), N);
    mfem::AddMult_a_VVt(rule.IntPoint(q).weight, N, mass);
    for (int a = 0; a < dofs; ++a) moment(a, q) = rule.IntPoint(q).weight * N(a);
  }
  mass.Invert();
  mfem::Mult(mass, moment, projection);
  return projection;
}

}  // namespace

MuscleFields::MuscleFields(MuscleSystem& system)
    : system_(system),
      cell_collection_(system.config().order - 1, 3),
      constant_collection_(0, 3),
      scalars_(system.space().GetParMesh(), &cell_collection_),
      vectors_(system.space().GetParMesh(), &cell_collection_, 3, mfem::Ordering::byVDIM),
      tensors_(system.space().GetParMesh(), &cell_collection_, tensor_components, mfem::Ordering::byVDIM),
      constants_(system.space().GetParMesh(), &constant_collection_),
      projection_(projection_matrix(*scalars_.GetFE(0), system.tables().rule())) {
  displacement_ = add("displacement", "m", system.space());
  velocity_ = add("velocity", "m/s", system.space());
  pressure_ = add("pressure", "Pa", scalars_);
  dilatation_ = add("dilatation", "", scalars_);
  stretch_ = add("fibre_stretch", "", scalars_);
  rate_ = add("fibre_rate", "1/s", scalars_);
  activation_ = add("activation", "", scalars_);
  direction_ = add("fibre_direction", "", vectors_);
  stress_ = add("cauchy_stress", "Pa", tensors_);
  if (system.config().ellipticity) ellipticity_ = add("legendre_hadamard", "Pa", constants_);
  auto* region = add("region", "", constants_);
  for (int cell = 0; cell < constants_.GetNE(); ++cell) (*region)(cell) = constants_.GetParMesh()->GetAttribute(cell);
}

mfem::ParGridFunction* MuscleFields::add(const std::string& name, const std::string& unit,
                                         mfem::ParFiniteElementSpace& space) {
  storage_.push_back(std::make_unique<mfem::ParGridFunction>(&space));
  *storage_.back() = 0.0;
  fields_.push_back({name, unit, storage_.back().get()});
  return storage_.back().get();
}

void MuscleFields::update(const mfem::Vector& u, const mfem::Vector& v, const mfem::Vector& u_old) {
  displacement_->SetFromTrueDofs(u);
  velocity_->SetFromTrueDofs(v);
  system_.for_each_cell(u, u_old, [&](int cell, const Material& material, const ThreeField& kernel) {
    update_points(cell, material, kernel);
  });
}

void MuscleFields::set_ellipticity(const std::vector<double>& of_cells) {
  std::copy(of_cells.begin(), of_cells.end(), ellipticity_->begin());
}

void MuscleFields::update_points(int cell, const Material& material, const ThreeField& kernel) {
  const PointInput in = kernel.points(system_.point_input(cell));
  std::vector<double> stretch(in.n), rate(in.n), activation(in.n), direction(3 * in.n),
      stress(tensor_components * in.n);
  std::vector<Mat3> P(in.n);
  material.fibre_state(in, stretch.data(), rate.data(), activation.data());
  material.stress(in, P.data(), nullptr);
  for (int q = 0; q < in.n; ++q) {
    const Mat3& F = kernel.F()[q];
    const Vec3 a = multiply(F, in.fibre[q]);
    const double length = material.has_fibres() ? norm(a) : 1.0;
    for (int i = 0; i < 3; ++i) direction[3 * q + i] = a[i] / length;
    const Mat3 PF = multiply(P[q], transpose(F));  // Cauchy stress: P F^T / J + p I
    for (int c = 0; c < tensor_components; ++c) {
      const int i = tensor_row[c], j = tensor_column[c];
      stress[tensor_components * q + c] = PF[3 * i + j] / kernel.J()[q] + (i == j ? kernel.pressure()[q] : 0.0);
    }
  }
  project(cell, kernel.pressure(), 1, *pressure_);
  project(cell, kernel.dilatation(), 1, *dilatation_);
  project(cell, stretch, 1, *stretch_);
  project(cell, rate, 1, *rate_);
  project(cell, activation, 1, *activation_);
  project(cell, direction, 3, *direction_);
  project(cell, stress, tensor_components, *stress_);
}

void MuscleFields::project(int cell, const std::vector<double>& at_points, int components,
                           mfem::ParGridFunction& field) {
  mfem::Array<int> dofs;
  field.ParFESpace()->GetElementVDofs(cell, dofs);  // component first
  const int n = projection_.Height();
  for (int c = 0; c < components; ++c)
    for (int a = 0; a < n; ++a) {
      double value = 0;
      for (int q = 0; q < projection_.Width(); ++q) value += projection_(a, q) * at_points[q * components + c];
      field(dofs[c * n + a]) = value;
    }
}

}  // namespace titin
