/// Vectors and second-order tensors of three dimensions: plain arrays of numbers, row-major.
///
/// The functions are templates of the number, so that the same formula runs for one point (double) or for several at
/// once (math/lanes.hpp).
#pragma once

#include <array>
#include <cmath>

namespace titin {

template <class T>
using Vector3 = std::array<T, 3>;
/// T_ij at [3 i + j]; for the deformation gradient F_iJ at [3 i + J].
template <class T>
using Tensor3 = std::array<T, 9>;

using Vec3 = Vector3<double>;
using Mat3 = Tensor3<double>;
/// A_iJkL = dP_iJ / dF_kL at [9 (3 i + J) + 3 k + L].
using Mat9 = std::array<double, 81>;

inline constexpr Mat3 identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
T norm(const Vector3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
Vector3<T> multiply(const Tensor3<T>& A, const Vector3<T>& x) {
  return {A[0] * x[0] + A[1] * x[1] + A[2] * x[2], A[3] * x[0] + A[4] * x[1] + A[5] * x[2],
          A[6] * x[0] + A[7] * x[1] + A[8] * x[2]};
}
template <class T>
Tensor3<T> multiply(const Tensor3<T>& A, const Tensor3<T>& B) {
  Tensor3<T> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  return C;
}
template <class T>
Tensor3<T> transpose(const Tensor3<T>& A) {
  return {A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8]};
}
template <class T>
T trace(const Tensor3<T>& A) {
  return A[0] + A[4] + A[8];
}
/// A : B
template <class T>
T contract(const Tensor3<T>& A, const Tensor3<T>& B) {
  T s = A[0] * B[0];
  for (int i = 1; i < 9; ++i) s += A[i] * B[i];
  return s;
}
/// a (x) b
template <class T>
Tensor3<T> dyad(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[0] * b[0], a[0] * b[1], a[0] * b[2], a[1] * b[0], a[1] * b[1],
          a[1] * b[2], a[2] * b[0], a[2] * b[1], a[2] * b[2]};
}
/// s X
template <class T>
Tensor3<T> scaled(const T& s, const Tensor3<T>& X) {
  Tensor3<T> Y;
  for (int i = 0; i < 9; ++i) Y[i] = s * X[i];
  return Y;
}
/// Y += s X
template <class T>
void add(Tensor3<T>& Y, const T& s, const Tensor3<T>& X) {
  for (int i = 0; i < 9; ++i) Y[i] += s * X[i];
}
/// Cofactor tensor: det(A) A^-T.
template <class T>
Tensor3<T> cofactor(const Tensor3<T>& A) {
  return {A[4] * A[8] - A[5] * A[7], A[5] * A[6] - A[3] * A[8], A[3] * A[7] - A[4] * A[6],
          A[2] * A[7] - A[1] * A[8], A[0] * A[8] - A[2] * A[6], A[1] * A[6] - A[0] * A[7],
          A[1] * A[5] - A[2] * A[4], A[2] * A[3] - A[0] * A[5], A[0] * A[4] - A[1] * A[3]};
}
template <class T>
T determinant(const Tensor3<T>& A) {
  return A[0] * (A[4] * A[8] - A[5] * A[7]) + A[1] * (A[5] * A[6] - A[3] * A[8]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}

}  // namespace titin
