/// Geometry of triangles (D = 2, per unit thickness) and tetrahedra (D = 3) whose corners move.
///
/// The corner normal is the derivative of the volume, (a n)_p = d|w| / dx_p = -N_p / D, N_p the outward area vector of
/// the face opposite to corner p. It is exact in motion: with x_p(t) = x_p + t v_p the volume is a polynomial of degree
/// D in t, whose rate is sum_p (a n)_p . v_p. The linear field through the corners gives F = D_s D_m^-1 (edges of the
/// deformed cell times the inverse of those at rest) with det F = |w| / |w_0|.
///
/// Maire (2009), J. Comput. Phys. 228:2391, secs. 2-3; Boscheri, Loubere, Maire (2022), J. Comput. Phys. 449:110779.
/// Lengths in any unit; corners in the order that makes the volume positive.
#pragma once

#include "math/vector.hpp"

namespace titin {

template <int D>
using Corners = std::array<Vector<D>, D + 1>;

inline Vector<3> cross(const Vector<3>& a, const Vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Edges from corner 0, as columns.
template <int D>
Matrix<D> edges(const Corners<D>& x) {
  Matrix<D> E;
  for (int i = 0; i < D; ++i)
    for (int p = 0; p < D; ++p) E[D * i + p] = x[p + 1][i] - x[0][i];
  return E;
}

template <int D>
double simplex_volume(const Corners<D>& x) {
  return determinant_of<D>(edges<D>(x)) / (D == 2 ? 2 : 6);
}

template <int D>
Vector<D> centroid(const Corners<D>& x) {
  Vector<D> c = x[0];
  for (int p = 1; p <= D; ++p) accumulate(c, 1, x[p]);
  for (double& component : c) component /= D + 1;
  return c;
}

/// Length^(D-1).
template <int D>
Corners<D> corner_normals(const Corners<D>& x) {
  Corners<D> an;
  if constexpr (D == 2) {
    for (int p = 0; p < 3; ++p) {
      const auto &a = x[(p + 1) % 3], &b = x[(p + 2) % 3];
      an[p] = {0.5 * (a[1] - b[1]), 0.5 * (b[0] - a[0])};
    }
  } else {
    const Vector<3> a = difference(x[1], x[0]), b = difference(x[2], x[0]), c = difference(x[3], x[0]);
    an = {Vector<3>{}, cross(b, c), cross(c, a), cross(a, b)};
    for (int p = 1; p <= 3; ++p)
      for (int i = 0; i < 3; ++i) an[p][i] /= 6;
    for (int i = 0; i < 3; ++i) an[0][i] = -(an[1][i] + an[2][i] + an[3][i]);
  }
  return an;
}

/// Area vector of a boundary face with corners x, its length the area; turned as the order of the corners says.
template <int D>
Vector<D> area_vector(const std::array<Vector<D>, D>& x) {
  if constexpr (D == 2)
    return {x[1][1] - x[0][1], x[0][0] - x[1][0]};
  else {
    Vector<3> N = cross(difference(x[1], x[0]), difference(x[2], x[0]));
    for (double& component : N) component /= 2;
    return N;
  }
}

/// Diameter of the ball inside: 2 D |w| / surface. Small for slivers too.
template <int D>
double inner_diameter(double volume, const Corners<D>& normals) {
  double surface = 0;
  for (const auto& an : normals) surface += D * norm(an);
  return 2 * D * volume / surface;
}

}  // namespace titin
