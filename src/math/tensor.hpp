/// Vectors and second-order tensors of three dimensions: plain arrays of numbers, row-major.
#pragma once

#include <array>
#include <cmath>

namespace titin {

using Vec3 = std::array<double, 3>;
/// T_ij at [3 i + j]; for the deformation gradient F_iJ at [3 i + J].
using Mat3 = std::array<double, 9>;
/// A_iJkL = dP_iJ / dF_kL at [9 (3 i + J) + 3 k + L].
using Mat9 = std::array<double, 81>;

inline constexpr Mat3 identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 multiply(const Mat3& A, const Vec3& x) {
  return {A[0] * x[0] + A[1] * x[1] + A[2] * x[2], A[3] * x[0] + A[4] * x[1] + A[5] * x[2],
          A[6] * x[0] + A[7] * x[1] + A[8] * x[2]};
}
inline Mat3 multiply(const Mat3& A, const Mat3& B) {
  Mat3 C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  return C;
}
inline Mat3 transpose(const Mat3& A) { return {A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8]}; }
inline double trace(const Mat3& A) { return A[0] + A[4] + A[8]; }
inline double contract(const Mat3& A, const Mat3& B) {  // A : B
  double s = 0;
  for (int i = 0; i < 9; ++i) s += A[i] * B[i];
  return s;
}
/// Cofactor tensor: det(A) A^-T.
inline Mat3 cofactor(const Mat3& A) {
  return {A[4] * A[8] - A[5] * A[7], A[5] * A[6] - A[3] * A[8], A[3] * A[7] - A[4] * A[6],
          A[2] * A[7] - A[1] * A[8], A[0] * A[8] - A[2] * A[6], A[1] * A[6] - A[0] * A[7],
          A[1] * A[5] - A[2] * A[4], A[2] * A[3] - A[0] * A[5], A[0] * A[4] - A[1] * A[3]};
}
inline double determinant(const Mat3& A) {
  return A[0] * (A[4] * A[8] - A[5] * A[7]) + A[1] * (A[5] * A[6] - A[3] * A[8]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}

}  // namespace titin
