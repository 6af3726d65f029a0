/// Tangents at the Gauss points of several Q_k hexahedra side by side in the lanes of a register, in coordinates xi of
/// each cell:
///
///   A_iM,kN = w dxi_M/dX_J [A + f (cof (x) cof)']_iJkL dxi_N/dX_L,   c_iM = w cof_iJ dxi_M/dX_J.
///
/// Kronbichler, Kormann 2012 (cells in lanes); Davydov et al. 2020 (finite strain tangents by values at points).
#pragma once

#include <experimental/simd>

#include "fe/cell_tables.hpp"
#include "fe/tangent_points.hpp"
#include "fe/tensor_product.hpp"

namespace titin {

/// n nodes and q points a direction.
template <class Real, int n, int q, bool symmetric>
struct HexahedronBatch {
  using V = std::experimental::native_simd<Real>;
  static constexpr int lanes = static_cast<int>(V::size()), nodes = n * n * n, points = q * q * q;
  static constexpr int modes = n * (n - 1) * (n + 1) / 6;  // polynomials of degree <= n - 2
  static constexpr int entries = symmetric ? 45 : 81;

  struct Point {
    V A[entries], c[9], psi[modes], inertia;
  };
  Point point[points];
  V S[modes * modes];

  /// Of A: the upper triangle by rows, when it is symmetric.
  static constexpr int entry(int r, int s) {
    if (!symmetric) return 9 * r + s;
    return r <= s ? 9 * r - r * (r - 1) / 2 + s - r : entry(s, r);
  }
};

/// Fills batches: cells one by one into lanes, then all lanes together into the coordinates of their cells.
template <class Real, int n, int q, bool symmetric>
class HexahedronFiller {
 public:
  using Batch = HexahedronBatch<Real, n, q, symmetric>;
  using V = typename Batch::V;

  explicit HexahedronFiller(const CellTables& tables) : tables_(tables), raw_(Batch::points) {}

  /// cells[lane], or -1 for a lane without one, which does as the first.
  void fill(const int* cells, const TangentOfCell& at, Batch& batch) {
    for (int lane = 0; lane < Batch::lanes; ++lane) {
      const int cell = cells[lane] >= 0 ? cells[lane] : cells[0];
      set_lane(lane, cell, at(cell), batch);
    }
    for (int p = 0; p < Batch::points; ++p) change_coordinates(raw_[p], batch.point[p]);
  }

 private:
  struct Raw {
    V A[Batch::entries], cofactor[9], to_cell[9], weight, factor;
  };
  void set_lane(int lane, int cell, const TangentPoints& tangent, Batch& batch);
  static void change_coordinates(const Raw& raw, typename Batch::Point& point);

  const CellTables& tables_;
  std::vector<Raw> raw_;
};

template <class Real, int n, int q, bool symmetric>
void HexahedronFiller<Real, n, q, symmetric>::set_lane(int lane, int cell, const TangentPoints& tangent, Batch& batch) {
  const auto put = [lane](V& to, double x) { to[lane] = static_cast<Real>(x); };
  for (int p = 0; p < Batch::points; ++p) {
    Raw& raw = raw_[p];
    const double* to_cell = tables_.inverse_jacobian(cell, p);  // dxi_M / dX_J
    const double w = tables_.weight(cell, p);
    int entry = 0;
    for (int r = 0; r < 9; ++r)
      for (int s = symmetric ? r : 0; s < 9; ++s) put(raw.A[entry++], tangent.moduli[p][9 * r + s]);
    for (int r = 0; r < 9; ++r) put(raw.cofactor[r], tangent.cofactors[p][r]);
    for (int r = 0; r < 9; ++r) put(raw.to_cell[r], to_cell[r]);
    put(raw.weight, w);
    put(raw.factor, tangent.factor[p]);
    for (int l = 0; l < Batch::modes; ++l) put(batch.point[p].psi[l], tables_.mode(cell, p)[l]);
    put(batch.point[p].inertia, w * tangent.inertia);
  }
  for (int l = 0; l < Batch::modes * Batch::modes; ++l) put(batch.S[l], tangent.stiffness[l]);
}

template <class Real, int n, int q, bool symmetric>
void HexahedronFiller<Real, n, q, symmetric>::change_coordinates(const Raw& raw, typename Batch::Point& point) {
  const V* cof = raw.cofactor;
  const V* X = raw.to_cell;
  V half[81];  // second index changed
  for (int r = 0; r < 9; ++r)
    for (int k = 0; k < 3; ++k) {
      const int i = r / 3, J = r % 3;
      V A[3];
      for (int L = 0; L < 3; ++L) {
        const int s = 3 * k + L;
        const V pressure = cof[r] * cof[s] - cof[3 * i + L] * cof[3 * k + J];
        A[L] = raw.weight * (raw.A[Batch::entry(r, s)] + raw.factor * pressure);
      }
      for (int N = 0; N < 3; ++N) half[9 * r + 3 * k + N] = A[0] * X[3 * N] + A[1] * X[3 * N + 1] + A[2] * X[3 * N + 2];
    }
  for (int i = 0; i < 3; ++i)
    for (int M = 0; M < 3; ++M) {
      const int r = 3 * i + M;
      const V* row = &half[27 * i];
      for (int s = symmetric ? r : 0; s < 9; ++s)
        point.A[Batch::entry(r, s)] = X[3 * M] * row[s] + X[3 * M + 1] * row[9 + s] + X[3 * M + 2] * row[18 + s];
      point.c[r] = raw.weight * (cof[3 * i] * X[3 * M] + cof[3 * i + 1] * X[3 * M + 1] + cof[3 * i + 2] * X[3 * M + 2]);
    }
}

/// The one-dimensional tables of an element's basis and rule. Slopes of the Lagrange polynomials through the points by
/// barycentric weights (Berrut, Trefethen 2004, section 9).
template <class Real, int n, int q>
LineTables<Real, n, q> line_tables(const mfem::FiniteElement& element, const mfem::IntegrationRule& of_cell) {
  LineTables<Real, n, q> line;
  const auto& rule = mfem::IntRules.Get(mfem::Geometry::SEGMENT, of_cell.GetOrder());
  const auto& basis = dynamic_cast<const mfem::TensorBasisElement&>(element).GetBasis1D();
  mfem::Vector N(n), dN(n);
  double weight[q], x[q];
  for (int r = 0; r < q; ++r) {
    x[r] = rule.IntPoint(r).x;
    basis.Eval(x[r], N, dN);
    for (int a = 0; a < n; ++a) {
      line.value[r][a] = static_cast<Real>(N(a));
      line.node_slope[r][a] = static_cast<Real>(dN(a));
    }
  }
  for (int r = 0; r < q; ++r) {
    weight[r] = 1;
    for (int s = 0; s < q; ++s)
      if (s != r) weight[r] /= x[r] - x[s];
  }
  for (int r = 0; r < q; ++r) {
    double diagonal = 0;
    for (int s = 0; s < q; ++s) {
      if (s == r) continue;
      const double slope = weight[s] / weight[r] / (x[r] - x[s]);
      line.slope[r][s] = static_cast<Real>(slope);
      diagonal -= slope;
    }
    line.slope[r][r] = static_cast<Real>(diagonal);
  }
  return line;
}

}  // namespace titin
