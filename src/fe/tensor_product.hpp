/// Tensor-product polynomials on the cube, a direction at a time (sum factorisation; Orszag 1980): from the values at
/// n^3 nodes to values and slopes at q^3 Gauss points, and the transpose. The first index runs fastest.
///
/// A polynomial through the nodes is one through the points too (q >= n), so slopes are taken at the points: six sums
/// of n terms a point where nodes x points sums have n^3.
#pragma once

namespace titin {

/// One-dimensional tables of n node polynomials and q points.
template <class Real, int n, int q>
struct LineTables {
  Real value[q][n], node_slope[q][n];  ///< of node polynomials at the points
  Real slope[q][q];                    ///< of the polynomials through the points, at the points
};

/// out[a][r][b] = sum_c A[r][c] in[a][c][b] for a < before, b < after; with A[c][r] when transposed.
template <int rows, int columns, int before, int after, bool transposed, bool add, class V, class Matrix>
[[gnu::always_inline]] inline void along(const Matrix& A, const V* in, V* out) {
  for (int a = 0; a < before; ++a)
    for (int b = 0; b < after; ++b) {
      V x[columns];
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) x[c] = in[(a * columns + c) * after + b];
#pragma GCC unroll 8
      for (int r = 0; r < rows; ++r) {
        V sum = (transposed ? A[0][r] : A[r][0]) * x[0];
#pragma GCC unroll 8
        for (int c = 1; c < columns; ++c) sum += (transposed ? A[c][r] : A[r][c]) * x[c];
        V& to = out[(a * rows + r) * after + b];
        if constexpr (add)
          to += sum;
        else
          to = sum;
      }
    }
}

/// Values at the points.
template <int n, int q, class V, class Tables>
[[gnu::always_inline]] inline void to_points(const Tables& t, const V* nodes, V* points) {
  V x[q * n * n], y[q * q * n];
  along<q, n, n * n, 1, false, false>(t.value, nodes, x);
  along<q, n, n, q, false, false>(t.value, x, y);
  along<q, n, 1, q * q, false, false>(t.value, y, points);
}

/// The transpose.
template <int n, int q, class V, class Tables>
[[gnu::always_inline]] inline void from_points(const Tables& t, const V* points, V* nodes) {
  V x[q * q * n], y[q * n * n];
  along<n, q, 1, q * q, true, false>(t.value, points, x);
  along<n, q, n, q, true, false>(t.value, x, y);
  along<n, q, n * n, 1, true, false>(t.value, y, nodes);
}

/// Slopes along the three directions of what has these values at the points.
template <int q, class V, class Tables>
[[gnu::always_inline]] inline void slopes(const Tables& t, const V* values, V* x, V* y, V* z) {
  along<q, q, q * q, 1, false, false>(t.slope, values, x);
  along<q, q, q, q, false, false>(t.slope, values, y);
  along<q, q, 1, q * q, false, false>(t.slope, values, z);
}

/// The transpose, added to `values`.
template <int q, class V, class Tables>
[[gnu::always_inline]] inline void add_slopes_transposed(const Tables& t, const V* x, const V* y, const V* z,
                                                         V* values) {
  along<q, q, q * q, 1, true, true>(t.slope, x, values);
  along<q, q, q, q, true, true>(t.slope, y, values);
  along<q, q, 1, q * q, true, true>(t.slope, z, values);
}

}  // namespace titin
