/// Several points side by side in one vector register: the number type of kernels that run over points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#include <limits>

namespace titin {

using Lanes = std::experimental::native_simd<double>;
inline constexpr int lane_count = static_cast<int>(Lanes::size());

/// Component `c` of the points first, first+1, ...; the last of `n` points fills the lanes that are left over.
template <class Array>
Lanes gather(const Array* points, std::size_t c, int first, int n) {
  return Lanes([&](auto lane) {
    const int p = first + static_cast<int>(lane);
    return points[p < n ? p : n - 1][c];
  });
}

/// x^(-1/3) for x > 0, NaN otherwise; vectorises, which std::cbrt does not.
/// Start from the exponent (relative error 4 %), then two steps of fourth order: y (1 + e/3 + 2 e^2/9 + 14 e^3/81) with
/// e = 1 - x y^3, which is the series of (1 - e)^(-1/3).
template <class T>
T refine_inverse_cbrt(const T& x, T y) {
  for (int step = 0; step < 2; ++step) {
    const T e = 1.0 - x * y * y * y;
    y += y * e * (1.0 / 3 + e * (2.0 / 9 + e * (14.0 / 81)));
  }
  return y;
}
inline double guess_inverse_cbrt(double x) {
  if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = 0x553EF0FF289DD796ULL - bits / 3;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline double inverse_cbrt(double x) { return refine_inverse_cbrt(x, guess_inverse_cbrt(x)); }
inline Lanes inverse_cbrt(const Lanes& x) {
  return refine_inverse_cbrt(x, Lanes([&](auto lane) { return guess_inverse_cbrt(x[lane]); }));
}

}  // namespace titin
