#include "fe/patch_fit.hpp"

#include <algorithm>
#include <cmath>

namespace titin {

namespace {

/// Added to the normal equations, whose diagonal is 1: above the round-off of their sums, far below any error. Where
/// points do not determine the polynomial it takes a short one.
constexpr double ridge = 1e-10;
/// Gradients of a vertex' function sum to zero over the cells around it, unless it is at the surface: then to part of
/// the area there. This part is round-off and the quadrature of curved cells.
constexpr double closed = 1e-3;
constexpr int components = 9;

constexpr int packed(int row, int column) { return row * (row + 1) / 2 + column; }

}  // namespace

CellPoints::CellPoints(mfem::ParMesh& mesh, const CellTables& tables)
    : tables_(tables), collection_(1, tables.dimension()), space_(&mesh, &collection_) {
  const auto place = [&](mfem::ElementTransformation& map, const mfem::IntegrationPoint& point) {
    Vec3 X{};
    mfem::Vector view(X.data(), tables.dimension());
    map.Transform(point, view);
    return X;
  };
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    first_.push_back(static_cast<int>(place_.size()));
    first_corner_.push_back(static_cast<int>(corner_.size()));
    auto& map = *space_.GetElementTransformation(cell);
    for (int q = 0; q < tables.points(cell); ++q) place_.push_back(place(map, tables.rule(cell).IntPoint(q)));
    for (int a = 0; a < corners(cell); ++a) corner_.push_back(place(map, space_.GetFE(cell)->GetNodes().IntPoint(a)));
  }
}

double CellPoints::volume(int cell) const {
  double volume = 0;
  for (int q = 0; q < tables_.points(cell); ++q) volume += tables_.weight(cell, q);
  return volume;
}

void CellPoints::shape(int cell, int q, mfem::Vector& N) const {
  N.SetSize(corners(cell));
  space_.GetFE(cell)->CalcShape(tables_.rule(cell).IntPoint(q), N);
}

mfem::DenseMatrix CellPoints::gradients(int cell, int q) const {
  mfem::DenseMatrix slope(corners(cell), tables_.dimension()), gradient(corners(cell), tables_.dimension());
  auto* map = space_.GetElementTransformation(cell);
  map->SetIntPoint(&tables_.rule(cell).IntPoint(q));
  space_.GetFE(cell)->CalcDShape(map->GetIntPoint(), slope);
  mfem::Mult(slope, map->InverseJacobian(), gradient);
  return gradient;
}

Vec3 CellPoints::offset(int cell, int q, int corner) const {
  Vec3 X = place_[first_[cell] + q];
  for (int d = 0; d < 3; ++d) X[d] -= corner_[first_corner_[cell] + corner][d];
  return X;
}

void CellPoints::sum_over_ranks(std::vector<double>& values) const {
  mfem::Vector whole(space_.GetTrueVSize());
  for (std::size_t first = 0; first < values.size(); first += vertices()) {
    mfem::Vector part(&values[first], vertices());
    space_.GetProlongationMatrix()->MultTranspose(part, whole);
    space_.GetProlongationMatrix()->Mult(whole, part);
  }
}

PatchFit::PatchFit(const CellPoints& points, std::vector<int> cells, int degree)
    : points_(points), cells_(std::move(cells)), monomial_(monomials(degree, points.tables().dimension())) {
  find_inner();
  factorise();
}

void PatchFit::take_monomials(const Vec3& X, double* m) const {
  for (const auto& exponents : monomial_) {
    *m = 1;
    for (int d = 0; d < 3; ++d)
      for (int power = 0; power < exponents[d]; ++power) *m *= X[d];
    ++m;
  }
}

template <class Visit>
void PatchFit::for_each_pair(Visit visit) const {
  mfem::Array<int> vertices;
  std::vector<double> m(terms());
  for (int cell : cells_) {
    points_.vertices_of(cell, vertices);
    for (int a = 0; a < vertices.Size(); ++a)
      for (int q = 0; q < points_.tables().points(cell); ++q) {
        take_monomials(points_.offset(cell, q, a), m.data());
        visit(vertices[a], points_.first(cell) + q, points_.tables().weight(cell, q), m);
      }
  }
}

/// int Grad N_v dV over the cells around v is the integral of N_v over the surface there: zero inside.
void PatchFit::find_inner() {
  const int dimension = points_.tables().dimension(), n = points_.vertices();
  std::vector<double> sums(std::size_t(dimension + 1) * n);
  mfem::Array<int> vertices;
  for (int cell : cells_) {
    points_.vertices_of(cell, vertices);
    for (int q = 0; q < points_.tables().points(cell); ++q) {
      mfem::DenseMatrix part = points_.gradients(cell, q);
      part *= points_.tables().weight(cell, q);
      for (int a = 0; a < vertices.Size(); ++a)
        for (int J = 0; J < dimension; ++J) {
          sums[std::size_t(J) * n + vertices[a]] += part(a, J);
          sums[std::size_t(dimension) * n + vertices[a]] += std::abs(part(a, J));
        }
    }
  }
  points_.sum_over_ranks(sums);
  for (int v = 0; v < n; ++v) {
    double open = 0;
    for (int J = 0; J < dimension; ++J) open = std::max(open, std::abs(sums[std::size_t(J) * n + v]));
    inner_.push_back(open <= closed * sums[std::size_t(dimension) * n + v]);
  }
}

/// Cholesky's decomposition of int m m^T dV around each vertex, m the monomials about it, scaled to a diagonal of 1.
void PatchFit::factorise() {
  const int n = terms(), entries = packed(n, 0), vertices = points_.vertices();
  std::vector<double> sums(std::size_t(entries) * vertices);
  for_each_pair([&](int vertex, int, double weight, const std::vector<double>& m) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c <= r; ++c) sums[std::size_t(packed(r, c)) * vertices + vertex] += weight * m[r] * m[c];
  });
  points_.sum_over_ranks(sums);
  factor_.assign(sums.size(), 0.0);
  scale_.assign(std::size_t(n) * vertices, 0.0);
  for (int v = 0; v < vertices; ++v) {
    double *L = &factor_[std::size_t(entries) * v], *scale = &scale_[std::size_t(n) * v];
    const auto A = [&](int r, int c) { return sums[std::size_t(packed(r, c)) * vertices + v]; };
    for (int r = 0; r < n; ++r) {
      scale[r] = A(r, r) > 0 ? 1 / std::sqrt(A(r, r)) : 0;
      for (int c = 0; c <= r; ++c) {
        double rest = A(r, c) * scale[r] * scale[c] + (r == c ? ridge : 0);
        for (int k = 0; k < c; ++k) rest -= L[packed(r, k)] * L[packed(c, k)];
        L[packed(r, c)] = r == c ? std::sqrt(std::max(rest, ridge)) : rest / L[packed(c, c)];
      }
    }
  }
}

/// b, whose entries lie `stride` apart, becomes the coefficients of a polynomial.
void PatchFit::solve(int vertex, double* b, int stride) const {
  const int n = terms();
  const double *L = &factor_[std::size_t(packed(n, 0)) * vertex], *scale = &scale_[std::size_t(n) * vertex];
  const auto x = [&](int row) -> double& { return b[std::size_t(row) * stride]; };
  for (int r = 0; r < n; ++r) {
    x(r) *= scale[r];
    for (int c = 0; c < r; ++c) x(r) -= L[packed(r, c)] * x(c);
    x(r) /= L[packed(r, r)];
  }
  for (int r = n - 1; r >= 0; --r) {
    for (int c = r + 1; c < n; ++c) x(r) -= L[packed(c, r)] * x(c);
    x(r) /= L[packed(r, r)];
  }
  for (int r = 0; r < n; ++r) x(r) *= scale[r];
}

void PatchFit::update(const std::vector<Mat3>& values) {
  const int n = terms(), vertices = points_.vertices();
  polynomials_.assign(std::size_t(n) * components * vertices, 0.0);
  for_each_pair([&](int vertex, int point, double weight, const std::vector<double>& m) {
    for (int l = 0; l < n; ++l)
      for (int i = 0; i < components; ++i)
        polynomials_[(std::size_t(l) * components + i) * vertices + vertex] += weight * m[l] * values[point][i];
  });
  points_.sum_over_ranks(polynomials_);
  for (int i = 0; i < components; ++i)
    for (int v = 0; v < vertices; ++v) solve(v, &polynomials_[std::size_t(i) * vertices + v], components * vertices);
}

Mat3 PatchFit::at(int cell, int q) const {
  mfem::Array<int> vertices;
  mfem::Vector N;
  std::vector<double> m(terms());
  points_.vertices_of(cell, vertices);
  points_.shape(cell, q, N);
  const bool some_inner = std::any_of(vertices.begin(), vertices.end(), [&](int v) { return inner_[v] != 0; });
  double parts = 0;
  Mat3 sum{};
  for (int a = 0; a < vertices.Size(); ++a) {
    if (some_inner && !inner_[vertices[a]]) continue;
    parts += N(a);
    take_monomials(points_.offset(cell, q, a), m.data());
    for (int l = 0; l < terms(); ++l)
      for (int i = 0; i < components; ++i)
        sum[i] += N(a) * m[l] * polynomials_[(std::size_t(l) * components + i) * points_.vertices() + vertices[a]];
  }
  for (double& x : sum) x /= parts;
  return sum;
}

}  // namespace titin
