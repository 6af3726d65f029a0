#include "fe/cell_tables.hpp"

#include <cmath>

namespace titin {

namespace {

constexpr int pack = 8;  // doubles in the widest vector register we care for

}  // namespace

std::vector<std::array<int, 3>> monomials(int d, int dimension) {
  std::vector<std::array<int, 3>> list;
  for (int n = 0; n <= d; ++n)
    for (int a = n; a >= 0; --a)
      for (int b = n - a; b >= 0; --b)
        if (dimension == 3 || a + b == n) list.push_back({a, b, n - a - b});
  return list;
}

CellTables::CellTables(const mfem::ParFiniteElementSpace& space, const CellElements& elements, int points,
                       double thickness)
    : geometry_(elements.list().size() == 1 ? elements.list().front().geometry : mfem::Geometry::INVALID),
      dimension_(space.GetMesh()->Dimension()),
      cells_(space.GetNE()) {
  for (int e = 0; e < space.GetNE(); ++e) {
    const auto geometry = space.GetMesh()->GetElementGeometry(e);
    Shapes& shapes = shapes_[geometry];
    if (!shapes.rule) {
      shapes.rule = &elements.rule(geometry, points);
      set_shapes(*space.GetFE(e), elements.of(geometry), shapes);
    }
    cells_[e].shapes = &shapes;
    set_cell(*space.GetMesh()->GetElementTransformation(e), thickness, cells_[e]);
  }
  for (const Shapes& shapes : shapes_) {
    most_points_ = std::max(most_points_, shapes.points);
    most_modes_ = std::max(most_modes_, shapes.modes);
    most_values_ = std::max(most_values_, dimension_ * shapes.nodes);
    most_gradients_ = std::max(most_gradients_, 3 * shapes.points * shapes.padded);
  }
}

void CellTables::set_shapes(const mfem::FiniteElement& element, const CellElement& pair, Shapes& s) const {
  s.nodes = element.GetDof();
  s.padded = (s.nodes + pack - 1) / pack * pack;
  s.points = s.rule->GetNPoints();
  s.monomial = monomials(pair.pressure_degree, dimension_);
  s.modes = static_cast<int>(s.monomial.size());
  s.shape.assign(s.points * s.padded, 0.0);
  s.slope.assign(s.points * 3 * s.padded, 0.0);
  mfem::Vector N(s.nodes);
  mfem::DenseMatrix dN(s.nodes, dimension_);
  for (int q = 0; q < s.points; ++q) {
    element.CalcShape(s.rule->IntPoint(q), N);
    element.CalcDShape(s.rule->IntPoint(q), dN);
    for (int a = 0; a < s.nodes; ++a) {
      s.shape[q * s.padded + a] = N(a);
      for (int M = 0; M < dimension_; ++M) s.slope[(q * 3 + M) * s.padded + a] = dN(a, M);
    }
  }
}

void CellTables::set_cell(mfem::ElementTransformation& map, double thickness, Cell& cell) const {
  const Shapes& s = *cell.shapes;
  cell.weight.resize(s.points);
  cell.inverse_jacobian.assign(s.points * 9, 0.0);
  mfem::DenseMatrix X(dimension_, s.points);
  double volume = 0;
  for (int q = 0; q < s.points; ++q) {
    const auto& point = s.rule->IntPoint(q);
    map.SetIntPoint(&point);
    cell.weight[q] = point.weight * map.Weight() * thickness;
    volume += point.weight * map.Weight();
    const mfem::DenseMatrix& inverse = map.InverseJacobian();  // dxi_M / dX_J
    for (int M = 0; M < dimension_; ++M)
      for (int J = 0; J < dimension_; ++J) cell.inverse_jacobian[q * 9 + 3 * M + J] = inverse(M, J);
    mfem::Vector x;
    X.GetColumnReference(q, x);
    map.Transform(point, x);
  }
  mfem::Vector centre(dimension_);
  map.Transform(mfem::Geometries.GetCenter(map.GetGeometryType()), centre);
  if (s.modes > 0) set_modes(centre, X, std::pow(volume, 1.0 / dimension_), cell);
}

/// Pressure modes are monomials in physical reference coordinates, centred and scaled: mapped ones lose an order on
/// cells that are no parallelepipeds (Boffi, Gastaldi 2002).
void CellTables::set_modes(const mfem::Vector& centre, const mfem::DenseMatrix& X, double size, Cell& cell) const {
  const Shapes& s = *cell.shapes;
  cell.mode.resize(s.points * s.modes);
  mfem::DenseMatrix mass(s.modes);
  mass = 0.0;
  for (int q = 0; q < s.points; ++q) {
    double* psi = &cell.mode[q * s.modes];
    for (int l = 0; l < s.modes; ++l) {
      psi[l] = 1;
      for (int d = 0; d < dimension_; ++d) psi[l] *= std::pow((X(d, q) - centre(d)) / size, s.monomial[l][d]);
    }
    for (int l = 0; l < s.modes; ++l)
      for (int m = 0; m < s.modes; ++m) mass(l, m) += cell.weight[q] * psi[l] * psi[m];
  }
  mass.Invert();
  cell.mass_inverse.assign(mass.GetData(), mass.GetData() + s.modes * s.modes);
}

void CellTables::gradients(int cell, double* G) const {
  const Shapes& s = of(cell);
  for (int q = 0; q < s.points; ++q) {
    const double* inverse = &cells_[cell].inverse_jacobian[q * 9];
    const double* dN = &s.slope[q * 3 * s.padded];
    for (int J = 0; J < 3; ++J) {
      double* g = G + (q * 3 + J) * s.padded;
      for (int a = 0; a < s.padded; ++a)
        g[a] = dN[a] * inverse[J] + dN[s.padded + a] * inverse[3 + J] + dN[2 * s.padded + a] * inverse[6 + J];
    }
  }
}

}  // namespace titin
