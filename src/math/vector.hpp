/// Vectors and symmetric matrices of D = 2 or 3 dimensions, for geometry; tensors of a material are always of three
/// (math/tensor.hpp). Symmetric ones hold 11, 22, 12 or 11, 22, 33, 12, 23, 13.
#pragma once

#include "math/tensor.hpp"

namespace titin {

template <int D>
using Vector = std::array<double, D>;
template <int D>
inline constexpr int symmetric_size = D*(D + 1) / 2;
template <int D>
using Symmetric = std::array<double, symmetric_size<D>>;

/// Where component ij of a symmetric matrix is.
template <int D>
constexpr int symmetric_index(int i, int j) {
  return i == j ? i : i + j == 1 ? D : i + j == 3 ? 4 : 5;
}

template <std::size_t n>
requires(n != 3)  // of three: math/tensor.hpp
    double dot(const std::array<double, n>& a, const std::array<double, n>& b) {
  double s = a[0] * b[0];
  for (std::size_t i = 1; i < n; ++i) s += a[i] * b[i];
  return s;
}
template <std::size_t n>
requires(n != 3) double norm(const std::array<double, n>& a) { return std::sqrt(dot(a, a)); }
template <std::size_t n>
std::array<double, n> difference(const std::array<double, n>& a, const std::array<double, n>& b) {
  std::array<double, n> c;
  for (std::size_t i = 0; i < n; ++i) c[i] = a[i] - b[i];
  return c;
}
/// a + s b
template <std::size_t n>
std::array<double, n> moved(const std::array<double, n>& a, double s, const std::array<double, n>& b) {
  std::array<double, n> c;
  for (std::size_t i = 0; i < n; ++i) c[i] = a[i] + s * b[i];
  return c;
}
/// y += s x
template <std::size_t n>
void accumulate(std::array<double, n>& y, double s, const std::array<double, n>& x) {
  for (std::size_t i = 0; i < n; ++i) y[i] += s * x[i];
}
/// S += s n (x) n
template <int D>
void add_square(Symmetric<D>& S, double s, const Vector<D>& n) {
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) S[symmetric_index<D>(i, j)] += s * n[i] * n[j];
}
template <int D>
Vector<D> product(const Symmetric<D>& S, const Vector<D>& x) {
  Vector<D> y{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) y[i] += S[symmetric_index<D>(i, j)] * x[j];
  return y;
}
/// Determinant, and the cofactors of it: S^-1 = cofactors / determinant.
template <int D>
double cofactors(const Symmetric<D>& S, Symmetric<D>& C) {
  if constexpr (D == 2) {
    C = {S[1], S[0], -S[2]};
    return S[0] * S[1] - S[2] * S[2];
  } else {
    C = {S[1] * S[2] - S[4] * S[4], S[0] * S[2] - S[5] * S[5], S[0] * S[1] - S[3] * S[3],
         S[4] * S[5] - S[3] * S[2], S[3] * S[5] - S[0] * S[4], S[3] * S[4] - S[1] * S[5]};
    return S[0] * C[0] + S[3] * C[3] + S[5] * C[5];
  }
}

/// A_ij at [D i + j].
template <int D>
using Matrix = std::array<double, D * D>;

template <int D>
Matrix<D> matrix_product(const Matrix<D>& A, const Matrix<D>& B) {
  Matrix<D> C{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k)
      for (int j = 0; j < D; ++j) C[D * i + j] += A[D * i + k] * B[D * k + j];
  return C;
}
template <int D>
double determinant_of(const Matrix<D>& A) {
  if constexpr (D == 2)
    return A[0] * A[3] - A[1] * A[2];
  else
    return A[0] * (A[4] * A[8] - A[5] * A[7]) + A[1] * (A[5] * A[6] - A[3] * A[8]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}
template <int D>
Matrix<D> inverse_of(const Matrix<D>& A) {
  const double s = 1 / determinant_of<D>(A);
  if constexpr (D == 2)
    return {s * A[3], -s * A[1], -s * A[2], s * A[0]};
  else
    return {s * (A[4] * A[8] - A[5] * A[7]), s * (A[2] * A[7] - A[1] * A[8]), s * (A[1] * A[5] - A[2] * A[4]),
            s * (A[5] * A[6] - A[3] * A[8]), s * (A[0] * A[8] - A[2] * A[6]), s * (A[2] * A[3] - A[0] * A[5]),
            s * (A[3] * A[7] - A[4] * A[6]), s * (A[1] * A[6] - A[0] * A[7]), s * (A[0] * A[4] - A[1] * A[3])};
}

}  // namespace titin
