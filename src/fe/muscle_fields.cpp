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

/// The matrix that takes dofs of one element to values at the nodes of another in the same cell.
mfem::DenseMatrix evaluation_matrix(const mfem::FiniteElement& from, const mfem::FiniteElement& at) {
  mfem::DenseMatrix values(at.GetDof(), from.GetDof());
  mfem::Vector N(from.GetDof());
  for (int a = 0; a < at.GetDof(); ++a) {
    from.CalcShape(at.GetNodes().IntPoint(a), N);
    values.SetRow(a, N);
  }
  return values;
}

}  // namespace

MuscleFields::MuscleFields(MuscleSystem& system)
    : system_(system),
      nodal_collection_(system.config().elements.list().front().nodal_order, system.tables().dimension()),
      cell_collection_(system.config().order - 1, system.tables().dimension()),
      constant_collection_(0, system.tables().dimension()),
      nodal_(system.space().GetParMesh(), &nodal_collection_, 3, mfem::Ordering::byVDIM),
      scalars_(system.space().GetParMesh(), &cell_collection_),
      vectors_(system.space().GetParMesh(), &cell_collection_, 3, mfem::Ordering::byVDIM),
      tensors_(system.space().GetParMesh(), &cell_collection_, tensor_components, mfem::Ordering::byVDIM),
      constants_(system.space().GetParMesh(), &constant_collection_) {
  for (int cell = 0; cell < scalars_.GetNE(); ++cell) {
    const auto geometry = geometry_of(cell);
    if (projection_[geometry].Height() > 0) continue;
    projection_[geometry] = projection_matrix(*scalars_.GetFE(cell), system.tables().rule(cell));
    evaluation_[geometry] = evaluation_matrix(*system.space().GetFE(cell), *nodal_.GetFE(cell));
  }
  displacement_ = fields_.add("displacement", "m", nodal_);
  velocity_ = fields_.add("velocity", "m/s", nodal_);
  pressure_ = fields_.add("pressure", "Pa", scalars_);
  dilatation_ = fields_.add("dilatation", "", scalars_);
  stretch_ = fields_.add("fibre_stretch", "", scalars_);
  rate_ = fields_.add("fibre_rate", "1/s", scalars_);
  activation_ = fields_.add("activation", "", scalars_);
  direction_ = fields_.add("fibre_direction", "", vectors_);
  stress_ = fields_.add("cauchy_stress", "Pa", tensors_);
  if (system.config().error_estimate) stress_error_ = fields_.add("stress_error", "Pa", constants_);
  if (system.config().ellipticity) ellipticity_ = fields_.add("legendre_hadamard", "Pa", constants_);
  auto* region = fields_.add("region", "", constants_);
  for (int cell = 0; cell < constants_.GetNE(); ++cell) (*region)(cell) = constants_.GetParMesh()->GetAttribute(cell);
}

void MuscleFields::update(const mfem::Vector& u, const mfem::Vector& v) {
  draw(u, *displacement_);
  draw(v, *velocity_);
  system_.for_each_cell(
      u, [&](int cell, const Material& material, const ThreeField& kernel) { update_points(cell, material, kernel); });
}

void MuscleFields::set_stress_error(const StressRecovery& recovery) {
  for (int cell = 0; cell < constants_.GetNE(); ++cell) (*stress_error_)(cell) = recovery.density(cell);
}

void MuscleFields::set_ellipticity(const std::vector<double>& of_cells) {
  std::copy(of_cells.begin(), of_cells.end(), ellipticity_->begin());
}

mfem::Geometry::Type MuscleFields::geometry_of(int cell) const {
  return system_.space().GetParMesh()->GetElementGeometry(cell);
}

/// Values at the nodes of the drawn space: bubbles are left out, and plane vectors get a third component of zero.
void MuscleFields::draw(const mfem::Vector& true_values, mfem::ParGridFunction& field) {
  const std::vector<double> values = system_.cell_values(true_values);
  mfem::Array<int> dofs;
  mfem::Vector drawn;
  for (int cell = 0; cell < nodal_.GetNE(); ++cell) {
    const mfem::DenseMatrix& evaluation = evaluation_[geometry_of(cell)];
    drawn.SetSize(evaluation.Height());
    nodal_.GetElementDofs(cell, dofs);
    for (int i = 0; i < system_.tables().dimension(); ++i) {
      evaluation.Mult(&values[system_.first_value(cell) + i * evaluation.Width()], drawn.GetData());
      for (int a = 0; a < dofs.Size(); ++a) field(nodal_.DofToVDof(dofs[a], i)) = drawn(a);
    }
  }
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
  const mfem::DenseMatrix& projection = projection_[geometry_of(cell)];
  const int n = projection.Height();
  for (int c = 0; c < components; ++c)
    for (int a = 0; a < n; ++a) {
      double value = 0;
      for (int q = 0; q < projection.Width(); ++q) value += projection(a, q) * at_points[q * components + c];
      field(dofs[c * n + a]) = value;
    }
}

}  // namespace titin
