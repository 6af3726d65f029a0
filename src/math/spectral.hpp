/// Eigenpairs of symmetric tensors and divided differences of powers, both exact also at equal and nearly equal values.
#pragma once

#include <array>
#include <cmath>

#include "math/tensor.hpp"

namespace titin {

struct Eigenpairs {
  Vec3 values;                  ///< in no order
  std::array<Vec3, 3> vectors;  ///< orthonormal
};

/// Turns rows and columns p and q of S such that S_pq = 0, and the vectors with them.
inline void jacobi_rotation(Mat3& S, std::array<Vec3, 3>& vectors, int p, int q) {
  const double off = S[3 * p + q];
  if (off == 0) return;
  const double theta = 0.5 * (S[4 * q] - S[4 * p]) / off;
  const double t = std::copysign(1, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const int r = 3 - p - q;
  const double rp = S[3 * r + p], rq = S[3 * r + q];
  S[4 * p] -= t * off;
  S[4 * q] += t * off;
  S[3 * p + q] = S[3 * q + p] = 0;
  S[3 * r + p] = S[3 * p + r] = c * rp - s * rq;
  S[3 * r + q] = S[3 * q + r] = s * rp + c * rq;
  for (int i = 0; i < 3; ++i) {
    const double vp = vectors[p][i], vq = vectors[q][i];
    vectors[p][i] = c * vp - s * vq;
    vectors[q][i] = s * vp + c * vq;
  }
}

/// By Jacobi's rotations, which keep all digits of small and of repeated eigenvalues where closed forms lose half.
inline Eigenpairs eigenpairs(Mat3 S) {
  constexpr int most_sweeps = 10;           // quadratic convergence: four to six do
  constexpr double negligible_off = 1e-36;  // square of what is below round-off beside the diagonal
  std::array<Vec3, 3> vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double off = S[1] * S[1] + S[2] * S[2] + S[5] * S[5];
    if (off <= negligible_off * (S[0] * S[0] + S[4] * S[4] + S[8] * S[8])) break;
    jacobi_rotation(S, vectors, 0, 1);
    jacobi_rotation(S, vectors, 0, 2);
    jacobi_rotation(S, vectors, 1, 2);
  }
  return {{S[0], S[4], S[8]}, vectors};
}

/// (exp(m b) - exp(m a)) / (exp(b) - exp(a)), the divided difference of x^m between exp(a) and exp(b); its limit at a =
/// b is m exp((m - 1) a).
inline double divided_difference_of_power(double m, double a, double b) {
  const double difference = b - a;
  const double ratio = difference == 0 ? m : std::expm1(m * difference) / std::expm1(difference);
  return std::exp((m - 1) * a) * ratio;
}

/// (b - a) / (exp(b) - exp(a)), the divided difference of ln x between exp(a) and exp(b); its limit at a = b is
/// exp(-a).
inline double divided_difference_of_log(double a, double b) {
  const double difference = b - a;
  return std::exp(-a) * (difference == 0 ? 1 : difference / std::expm1(difference));
}

}  // namespace titin
