/// Symmetric second-order tensors as six numbers: 11, 22, 33, 12, 23, 13.
#pragma once

#include "math/tensor.hpp"

namespace titin {

using Sym3 = std::array<double, 6>;

inline Sym3 symmetric_part(const Mat3& A) {
  return {A[0], A[4], A[8], 0.5 * (A[1] + A[3]), 0.5 * (A[5] + A[7]), 0.5 * (A[2] + A[6])};
}
inline Mat3 full(const Sym3& a) { return {a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2]}; }
inline double contract(const Sym3& a, const Sym3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
inline Mat3 inverse(const Mat3& A) {
  const Mat3 c = cofactor(A);
  const double J = determinant(A);
  return {c[0] / J, c[3] / J, c[6] / J, c[1] / J, c[4] / J, c[7] / J, c[2] / J, c[5] / J, c[8] / J};
}
/// Green-Lagrange strain (F^T F - I) / 2.
inline Sym3 green_strain(const Mat3& F) {
  Mat3 C = multiply(transpose(F), F);
  for (int i = 0; i < 3; ++i) C[4 * i] -= 1;
  Sym3 E = symmetric_part(C);
  for (double& e : E) e *= 0.5;
  return E;
}

}  // namespace titin
