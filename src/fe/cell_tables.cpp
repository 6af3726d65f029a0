#include "fe/cell_tables.hpp"

namespace titin {

namespace {

constexpr int pack = 8;  // doubles in the widest vector register we care for

/// Exponents (a, b, c) of the monomials of degree <= d, constant first.
std::vector<std::array<int, 3>> monomials(int d) {
  std::vector<std::array<int, 3>> list;
  for (int n = 0; n <= d; ++n)
    for (int a = n; a >= 0; --a)
      for (int b = n - a; b >= 0; --b) list.push_back({a, b, n - a - b});
  return list;
}

}  // namespace

const mfem::IntegrationRule& cell_rule(int points) { return mfem::IntRules.Get(mfem::Geometry::CUBE, 2 * points - 1); }

CellTables::CellTables(const mfem::ParFiniteElementSpace& space, int order, int points)
    : order_(order), modes_(static_cast<int>(monomials(order - 1).size())) {
  const mfem::FiniteElement& element = *space.GetFE(0);
  rule_ = &cell_rule(points);
  nodes_ = element.GetDof();
  padded_ = (nodes_ + pack - 1) / pack * pack;
  points_ = rule_->GetNPoints();
  shape_.assign(points_ * padded_, 0.0);
  reference_slope_.assign(points_ * 3 * padded_, 0.0);
  mfem::Vector N(nodes_);
  mfem::DenseMatrix dN(nodes_, 3);
  for (int q = 0; q < points_; ++q) {
    element.CalcShape(rule_->IntPoint(q), N);
    element.CalcDShape(rule_->IntPoint(q), dN);
    for (int a = 0; a < nodes_; ++a) {
      shape_[q * padded_ + a] = N(a);
      for (int M = 0; M < 3; ++M) reference_slope_[(q * 3 + M) * padded_ + a] = dN(a, M);
    }
  }
  cells_.resize(space.GetNE());
  for (int e = 0; e < space.GetNE(); ++e) {
    const double size = std::cbrt(space.GetMesh()->GetElementVolume(e));
    set_cell(*space.GetMesh()->GetElementTransformation(e), size, cells_[e]);
  }
}

void CellTables::set_cell(mfem::ElementTransformation& map, double size, Cell& cell) const {
  cell.weight.resize(points_);
  cell.inverse_jacobian.resize(points_ * 9);
  mfem::DenseMatrix X(3, points_);
  for (int q = 0; q < points_; ++q) {
    const auto& point = rule_->IntPoint(q);
    map.SetIntPoint(&point);
    cell.weight[q] = point.weight * map.Weight();
    const mfem::DenseMatrix& inverse = map.InverseJacobian();  // dxi_M / dX_J
    for (int M = 0; M < 3; ++M)
      for (int J = 0; J < 3; ++J) cell.inverse_jacobian[q * 9 + 3 * M + J] = inverse(M, J);
    mfem::Vector x;
    X.GetColumnReference(q, x);
    map.Transform(point, x);
  }
  mfem::Vector centre(3);
  map.Transform(mfem::Geometries.GetCenter(mfem::Geometry::CUBE), centre);
  set_modes(centre, X, size, cell);
}

/// Pressure modes are monomials in physical reference coordinates, centred and scaled: mapped ones lose an order on
/// cells that are no parallelepipeds (Boffi, Gastaldi 2002).
void CellTables::set_modes(const mfem::Vector& centre, const mfem::DenseMatrix& X, double size, Cell& cell) const {
  const auto exponents = monomials(order_ - 1);
  cell.mode.resize(points_ * modes_);
  mfem::DenseMatrix mass(modes_);
  mass = 0.0;
  for (int q = 0; q < points_; ++q) {
    double* psi = &cell.mode[q * modes_];
    for (int l = 0; l < modes_; ++l) {
      psi[l] = 1;
      for (int d = 0; d < 3; ++d) psi[l] *= std::pow((X(d, q) - centre(d)) / size, exponents[l][d]);
    }
    for (int l = 0; l < modes_; ++l)
      for (int m = 0; m < modes_; ++m) mass(l, m) += cell.weight[q] * psi[l] * psi[m];
  }
  mass.Invert();
  cell.mass_inverse.assign(mass.GetData(), mass.GetData() + modes_ * modes_);
}

void CellTables::gradients(int cell, double* G) const {
  for (int q = 0; q < points_; ++q) {
    const double* inverse = &cells_[cell].inverse_jacobian[q * 9];
    const double* dN = &reference_slope_[q * 3 * padded_];
    for (int J = 0; J < 3; ++J) {
      double* g = G + (q * 3 + J) * padded_;
      for (int a = 0; a < padded_; ++a)
        g[a] = dN[a] * inverse[J] + dN[padded_ + a] * inverse[3 + J] + dN[2 * padded_ + a] * inverse[6 + J];
    }
  }
}

}  // namespace titin
