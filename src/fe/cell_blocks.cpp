#include "fe/cell_blocks.hpp"

#include <algorithm>
#include <limits>

namespace titin {

namespace {

constexpr double nothing = 1e-9;       // of a function of order 1: zero but for round-off
constexpr double softest_part = 1e-6;  // of the bulk modulus: an indefinite tangent has no shear modulus of its own

/// The functions of order 1 at the nodes of the element.
std::vector<double> hats(const mfem::FiniteElement& element, const mfem::FiniteElement& corner) {
  std::vector<double> hat;
  mfem::Vector N(corner.GetDof());
  for (int a = 0; a < element.GetDof(); ++a) {
    corner.CalcShape(element.GetNodes().IntPoint(a), N);
    for (int v = 0; v < corner.GetDof(); ++v) hat.push_back(std::abs(N(v)) < nothing ? 0.0 : N(v));
  }
  return hat;
}

/// Of this rank's vertices, at rest.
std::vector<double> positions(const mfem::ParFiniteElementSpace& corners, int components) {
  std::vector<double> all(std::size_t(components) * corners.GetTrueVSize());
  double x[3];
  for (int vertex = 0; vertex < corners.GetNV(); ++vertex) {
    const int own = corners.GetLocalTDofNumber(vertex);
    if (own < 0) continue;
    corners.GetMesh()->GetNode(vertex, x);
    std::copy_n(x, components, &all[std::size_t(own) * components]);
  }
  return all;
}

}  // namespace

CellLayout cell_layout(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                       const Constraints& constraints) {
  const mfem::H1_FECollection order_1(1, space.GetMesh()->Dimension());
  const mfem::ParFiniteElementSpace corners(space.GetParMesh(), &order_1);
  CellLayout layout;
  layout.cells = space.GetNE();
  layout.components = space.GetVDim();
  layout.owned_dofs = space.GetTrueVSize();
  layout.owned_corners = corners.GetTrueVSize();
  if (layout.cells == 0) return layout;
  layout.nodes = tables.nodes(0);
  layout.modes = tables.modes(0);
  layout.corners = corners.GetFE(0)->GetDof();
  layout.hat = hats(*space.GetFE(0), *corners.GetFE(0));
  layout.position = positions(corners, layout.components);
  mfem::Array<int> dofs;
  for (int cell = 0; cell < layout.cells; ++cell) {
    mfem::Mesh& mesh = *space.GetMesh();
    layout.elongation = std::max(layout.elongation, mesh.GetElementSize(cell, 2) / mesh.GetElementSize(cell, 1));
    space.GetElementVDofs(cell, dofs);
    for (int dof : dofs)
      layout.dofs.push_back(
          constraints.is_constrained_local(dof) ? -1 : static_cast<PetscInt>(space.GetGlobalTDofNumber(dof)));
    corners.GetElementDofs(cell, dofs);
    for (int dof : dofs) layout.corner.push_back(static_cast<PetscInt>(corners.GetGlobalTDofNumber(dof)));
    double volume = 0;
    std::vector<double> square(layout.modes, 0.0);
    for (int q = 0; q < tables.points(cell); ++q) {
      volume += tables.weight(cell, q);
      for (int l = 0; l < layout.modes; ++l)
        square[l] += tables.weight(cell, q) * tables.mode(cell, q)[l] * tables.mode(cell, q)[l];
    }
    for (double s : square) layout.mode_size.push_back(std::sqrt(s / volume));
  }
  return layout;
}

TangentCells::TangentCells(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                           const Constraints& constraints, double gamma)
    : tables_(tables),
      blocks_(cell_layout(space, tables, constraints), gamma),
      B_(std::size_t(blocks_.layout().modes) * blocks_.layout().size()),
      S_(blocks_.layout().modes * blocks_.layout().modes),
      inertia_(blocks_.layout().nodes) {
  std::vector<double> G(tables.most_gradients());
  for (int cell = 0; cell < space.GetNE(); ++cell) {
    const int nodes = tables.nodes(cell), padded = tables.padded(cell);
    tables.gradients(cell, G.data());
    double gradients = 0, functions = 0, volume = 0;
    for (int q = 0; q < tables.points(cell); ++q) {
      const double w = tables.weight(cell, q);
      volume += w;
      for (int a = 0; a < nodes; ++a) functions += w * tables.shape(cell, q)[a] * tables.shape(cell, q)[a];
      for (int J = 0; J < 3; ++J)
        for (int a = 0; a < nodes; ++a) gradients += w * G[(3 * q + J) * padded + a] * G[(3 * q + J) * padded + a];
    }
    gradient_square_.push_back(gradients);
    mass_square_.push_back(functions);
    volume_.push_back(volume);
    size_.push_back(std::pow(space.GetParMesh()->GetElementVolume(cell), 1.0 / tables.dimension()));
  }
}

void TangentCells::set(int cell, const ThreeField& kernel, const Material& material, const double* K, double mass) {
  set_divergence(cell, kernel);
  set_stiffness(cell, kernel, material);
  // lumped in proportion to the diagonal, positive for all elements (Hinton, Rock, Zienkiewicz 1976)
  std::fill(inertia_.begin(), inertia_.end(), 0.0);
  for (int q = 0; q < tables_.points(cell) && mass > 0; ++q)
    for (int a = 0; a < tables_.nodes(cell); ++a)
      inertia_[a] += mass * volume_[cell] / mass_square_[cell] * tables_.weight(cell, q) * tables_.shape(cell, q)[a] *
                     tables_.shape(cell, q)[a];
  CellTangent tangent;
  tangent.K = K;
  tangent.B = B_.data();
  tangent.mass_inverse = tables_.mode_mass_inverse(cell);
  tangent.stiffness = S_.data();
  tangent.inertia = inertia_.data();
  tangent.bulk = least_bulk_;
  tangent.shear = shear_modulus(cell, K, mass);
  tangent.size = size_[cell];
  blocks_.set(cell, tangent);
}

/// B_l = int psi_l cof F : Grad N
void TangentCells::set_divergence(int cell, const ThreeField& kernel) {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell), modes = tables_.modes(cell);
  const int components = tables_.dimension();
  std::fill(B_.begin(), B_.end(), 0.0);
  std::vector<double> row(components * nodes);
  for (int q = 0; q < tables_.points(cell); ++q) {
    const Mat3 cof = cofactor(kernel.F()[q]);
    const double* G = kernel.gradients() + 3 * q * padded;
    for (int i = 0; i < components; ++i)
      for (int a = 0; a < nodes; ++a)
        row[i * nodes + a] = cof[3 * i] * G[a] + cof[3 * i + 1] * G[padded + a] + cof[3 * i + 2] * G[2 * padded + a];
    for (int l = 0; l < modes; ++l) {
      const double factor = tables_.weight(cell, q) * tables_.mode(cell, q)[l];
      for (int c = 0; c < components * nodes; ++c) B_[l * components * nodes + c] += factor * row[c];
    }
  }
}

/// S = M^-1 [int U'' psi psi^T] M^-1
void TangentCells::set_stiffness(int cell, const ThreeField& kernel, const Material& material) {
  const int modes = tables_.modes(cell);
  const double* inverse = tables_.mode_mass_inverse(cell);
  std::fill(S_.begin(), S_.end(), 0.0);
  least_bulk_ = std::numeric_limits<double>::max();
  std::vector<double> scaled(modes);  // M^-1 psi
  for (int q = 0; q < tables_.points(cell); ++q) {
    const double bulk = material.volumetric(kernel.dilatation()[q]).d2U;
    least_bulk_ = std::min(least_bulk_, bulk);
    const double* psi = tables_.mode(cell, q);
    for (int l = 0; l < modes; ++l) {
      scaled[l] = 0;
      for (int k = 0; k < modes; ++k) scaled[l] += inverse[l * modes + k] * psi[k];
    }
    for (int l = 0; l < modes; ++l)
      for (int k = 0; k < modes; ++k) S_[l * modes + k] += tables_.weight(cell, q) * bulk * scaled[l] * scaled[k];
  }
}

/// That of the vector Laplacian with the trace of A = K - B^T S B - inertia.
double TangentCells::shear_modulus(int cell, const double* K, double mass) const {
  const int components = tables_.dimension(), n = tables_.values(cell), modes = tables_.modes(cell);
  double trace = -components * mass * mass_square_[cell];
  for (int c = 0; c < n; ++c) {
    trace += K[c * n + c];
    for (int l = 0; l < modes; ++l)
      for (int k = 0; k < modes; ++k) trace -= B_[l * n + c] * S_[l * modes + k] * B_[k * n + c];
  }
  return std::max(trace / (components * gradient_square_[cell]), softest_part * least_bulk_);
}

}  // namespace titin
