/// Several points side by side in one vector register: the number type of kernels that run over points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#include <limits>
#include <utility>

namespace titin {

using Lanes = std::experimental::native_simd<double>;
inline constexpr int lane_count = static_cast<int>(Lanes::size());

inline bool all_zero(const Lanes& x) { return all_of(x == 0.0); }
inline bool all_zero(double x) { return x == 0; }

/// Component `c` of the points first, first+1, ...; the last of `n` points fills the lanes that are left over.
template <class Array>
Lanes gather(const Array* points, std::size_t c, int first, int n) {
  return Lanes([&](auto lane) {
    const int p = first + static_cast<int>(lane);
    return points[p < n ? p : n - 1][c];
  });
}

namespace detail {

/// What Lanes are underneath: the standard's lanes cannot be exchanged, the compiler's can. At any address of numbers,
/// because copies by memcpy are cut into halves that the next load has to wait for.
using Register [[gnu::vector_size(sizeof(Lanes)), gnu::aligned(alignof(double)), gnu::may_alias]] = double;
static_assert(sizeof(Register) == lane_count * sizeof(double));
struct Square {
  Register row[lane_count];
};

/// The 2 x 2 matrix of blocks of s lanes (a; b), transposed.
template <int s, int... lane>
[[gnu::always_inline]] inline void exchange(Register& a, Register& b, std::integer_sequence<int, lane...>) {
  const Register low = __builtin_shufflevector(a, b, (lane & s ? lane_count + lane - s : lane)...);
  b = __builtin_shufflevector(a, b, (lane & s ? lane_count + lane : lane + s)...);
  a = low;
}

/// Row i becomes column i.
template <int s = 1>
[[gnu::always_inline]] inline void transpose(Square& x) {
  if constexpr (s < lane_count) {
#pragma GCC unroll 16
    for (int i = 0; i < lane_count; ++i)
      if (!(i & s)) exchange<s>(x.row[i], x.row[i + s], std::make_integer_sequence<int, lane_count>{});
    transpose<2 * s>(x);
  }
}

}  // namespace detail

/// The other way round: components x of the points first, first+1, ... < n. A square of lanes at a time is turned in
/// registers; number by number it takes as long as the tangent itself.
template <std::size_t size>
void scatter(const std::array<Lanes, size>& x, std::array<double, size>* points, int first, int n) {
  const int count = std::min(lane_count, n - first);
  constexpr std::size_t whole = size / lane_count * lane_count;
  for (std::size_t c = 0; c < whole; c += lane_count) {
    detail::Square square;
#pragma GCC unroll 16
    for (int i = 0; i < lane_count; ++i) square.row[i] = *reinterpret_cast<const detail::Register*>(&x[c + i]);
    detail::transpose(square);
#pragma GCC unroll 16
    for (int p = 0; p < lane_count; ++p)
      if (p < count) *reinterpret_cast<detail::Register*>(&points[first + p][c]) = square.row[p];
  }
  for (std::size_t c = whole; c < size; ++c) {
    alignas(Lanes) double lanes[lane_count];
    x[c].copy_to(lanes, std::experimental::vector_aligned);
    for (int p = 0; p < count; ++p) points[first + p][c] = lanes[p];
  }
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
