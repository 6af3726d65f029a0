#include "materials/fibre_maxwell.hpp"

#include <algorithm>
#include <cmath>

#include "math/symmetric.hpp"

namespace titin {
namespace {

constexpr int most_iterations = 60;
constexpr double converged = 1e-15;  // of ln lambda_i: round-off

/// P = W_4 G and A = W_4 D + W_44 G x G for the squared stretch I4 = J^(-2m/3) |F a|^2, m = 1 isochoric or 0.
void assemble(const Mat3& F, const Vec3& a, FibreMeasure measure, double W4, double W44, Mat3& P, Mat9* A) {
  const double m = measure == FibreMeasure::isochoric ? 1.0 : 0.0;
  const Mat3 Ft = transpose(inverse(F));
  const Vec3 f = multiply(F, a);
  const double I = dot(f, f), scale = 2 * std::pow(determinant(F), -2 * m / 3);
  Mat3 G;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) G[3 * i + J] = scale * (f[i] * a[J] - m * I / 3 * Ft[3 * i + J]);
  for (int i = 0; i < 9; ++i) P[i] = W4 * G[i];
  if (!A) return;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int k = 0; k < 3; ++k)
        for (int L = 0; L < 3; ++L) {
          const double iJ = Ft[3 * i + J], kL = Ft[3 * k + L];
          const double D = (i == k ? a[J] * a[L] : 0.0) - 2 * m / 3 * (f[i] * a[J] * kL + iJ * f[k] * a[L]) +
                           m * 2 * I / 9 * iJ * kL + m * I / 3 * Ft[3 * i + L] * Ft[3 * k + J];
          (*A)[9 * (3 * i + J) + 3 * k + L] = W4 * scale * D + W44 * G[3 * i + J] * G[3 * k + L];
        }
}

}  // namespace

void FibreMaxwellResponse::start(const PointInput&, double* row) const { std::fill_n(row, own_size, 0.0); }

FibreMaxwellResponse::Tension FibreMaxwellResponse::pull(double log_stretch) const {
  const Vec3 along{1, 0, 0};
  const double l = std::exp(log_stretch), m = 1 / std::sqrt(l);
  const Mat3 F{l, 0, 0, 0, m, 0, 0, 0, m}, dF{l, 0, 0, 0, -0.5 * m, 0, 0, 0, -0.5 * m};  // dF / d ln l
  PointInput in;
  in.n = 1;
  in.F = in.F_old = &F;
  in.fibre = in.second_fibre = &along;
  Mat3 P;
  Mat9 A;
  double W;
  spring_->evaluate(in, {}, &P, &A, &W);
  double dP11 = 0, dP22 = 0;
  for (int j = 0; j < 9; ++j) {
    dP11 += A[j] * dF[j];
    dP22 += A[9 * 4 + j] * dF[j];
  }
  return {P[0] * l - P[4] * m, dP11 * l + P[0] * l - dP22 * m + 0.5 * P[4] * m, W};
}

void FibreMaxwellResponse::evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const {
  const bool first = options_.family == FibreFamily::first;
  for (int p = 0; p < in.n; ++p) {
    const Vec3& a = first ? in.fibre[p] : in.second_fibre[p];
    const Vec3 f = multiply(in.F[p], a);
    double I4 = dot(f, f);
    if (options_.measure == FibreMeasure::isochoric) I4 *= std::pow(determinant(in.F[p]), -2.0 / 3);
    const double total = 0.5 * std::log(I4), per_time = in.dt / viscosity_;
    const double* old = history.old + p * history.stride;
    double* now = history.now + p * history.stride;
    // g(x) = x - x_n - dt tau / eta grows with x where the spring is monotone; its root lies between x_n and ln lambda
    double x = old[1], low = std::min(old[1], total), high = std::max(old[1], total);
    Tension spring = pull(total - x);
    for (int i = 0; i < most_iterations; ++i) {
      const double g = x - old[1] - per_time * spring.tau;
      (g > 0 ? high : low) = x;
      double next = x - g / (1 + per_time * spring.slope);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - x);
      x = next;
      spring = pull(total - x);
      if (change <= converged) break;
    }
    now[0] = old[0] + (x - old[1]) * spring.tau;
    now[1] = x;
    W[p] = spring.energy;
    const double slope = spring.slope / (1 + per_time * spring.slope);
    assemble(in.F[p], a, options_.measure, spring.tau / (2 * I4), (slope - 2 * spring.tau) / (4 * I4 * I4), P[p],
             A ? A + p : nullptr);
  }
}

}  // namespace titin
