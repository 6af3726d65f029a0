#include "fv/predictor.hpp"

#include <cmath>

namespace titin {
namespace {

/// Picard's iteration gains a factor of the Courant number each sweep; what it changes below this is round-off.
constexpr double converged = 1e-13;
constexpr int most_sweeps = 12;

/// Velocity gradient, in the plane or in space.
template <int D>
Matrix<D> velocity_gradient(const Slopes<D>& g) {
  Matrix<D> G;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) G[D * i + j] = g[j][i];
  return G;
}

/// sum_j d T_ij / d x_j with gradients g_k . A: A turns derivatives by the place at the start into such by the place
/// now.
template <int D>
Vector<D> divergence(const Slopes<D>& g, const Matrix<D>& A) {
  Vector<D> sum{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      for (int m = 0; m < D; ++m) sum[i] += g[m][D + symmetric_index<D>(i, j)] * A[D * m + j];
  return sum;
}

template <int D>
double power(const PackedFields<D>& q, const Matrix<D>& G) {
  double sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += q[D + symmetric_index<D>(i, j)] * G[D * i + j];
  return sum;
}

template <int D>
Matrix<D> unit_plus(double s, const Matrix<D>& G) {
  Matrix<D> A;
  for (int k = 0; k < D * D; ++k) A[k] = s * G[k];
  for (int i = 0; i < D; ++i) A[(D + 1) * i] += 1;
  return A;
}

/// F <- A F in the plane or in space.
template <int D>
void deform(const Matrix<D>& A, Mat3& F) {
  Mat3 B = F;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      B[3 * i + j] = 0;
      for (int m = 0; m < D; ++m) B[3 * i + j] += A[D * i + m] * F[3 * m + j];
    }
  F = B;
}

template <int D>
void take_stresses(const Closure& closure, double time, PredictedBlock<D>& block) {
  std::array<Sym3, cells_per_block> T;
  closure.stress({block.n, block.F.data(), block.density.data(), block.energy.data(), nullptr, time}, T.data());
  for (int b = 0; b < block.n; ++b) {
    if constexpr (D == 2)
      block.q[b][2] = T[b][0], block.q[b][3] = T[b][1], block.q[b][4] = T[b][3];
    else
      for (int k = 0; k < 6; ++k) block.q[b][3 + k] = T[b][k];
    for (int i = 0; i < D; ++i) block.q[b][D + i] += block.shift[b];
  }
}

template <int D>
void hancock(const Closure& closure, double t, double dt, PredictedBlock<D>& block) {
  for (int b = 0; b < block.n; ++b) {
    const Matrix<D> G = velocity_gradient<D>(block.g[b]);
    const double rho = block.density[b];
    block.energy[b] += 0.5 * dt / rho * power<D>(block.q[b], G);
    const Vector<D> acceleration = divergence_of_stress<D>(block.g[b]);
    for (int i = 0; i < D; ++i) block.q[b][i] += 0.5 * dt / rho * acceleration[i];
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += G[(D + 1) * i];
    block.density[b] = rho / (1 + 0.5 * dt * trace);
    if (!closure.is_solid()) continue;
    deform<D>(matrix_product<D>(inverse_of<D>(unit_plus<D>(-0.25 * dt, G)), unit_plus<D>(0.25 * dt, G)), block.F[b]);
  }
  take_stresses(closure, t + dt / 2, block);
}

/// Linear in time through t_n, its equations held at the middle (one point of Gauss): q = q_n + dt/2 f(q). Places move
/// with the velocity, so F = A F_n, A = I + dt/2 grad v, is known at once; energy and stress of fluids need each other.
template <int D>
void ader(const Closure& closure, double t, double dt, PredictedBlock<D>& block) {
  std::array<Matrix<D>, cells_per_block> back;  // A^-1
  const auto start = block.energy;
  for (int b = 0; b < block.n; ++b) {
    const Matrix<D> A = unit_plus<D>(0.5 * dt, velocity_gradient<D>(block.g[b]));
    back[b] = inverse_of<D>(A);
    block.density[b] /= determinant_of<D>(A);
    deform<D>(A, block.F[b]);
    const Vector<D> acceleration = divergence<D>(block.g[b], back[b]);
    for (int i = 0; i < D; ++i) block.q[b][i] += 0.5 * dt / block.density[b] * acceleration[i];
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (int b = 0; b < block.n && !closure.is_solid(); ++b) {
      const Matrix<D> G = matrix_product<D>(velocity_gradient<D>(block.g[b]), back[b]);
      const double energy = start[b] + 0.5 * dt / block.density[b] * power<D>(block.q[b], G);
      change = std::max(change, std::abs(energy - block.energy[b]) / std::abs(energy));
      block.energy[b] = energy;
    }
    take_stresses(closure, t + dt / 2, block);
    if (change <= converged) break;
  }
}

}  // namespace

template <int D>
void predict(Predictor predictor, const Closure& closure, double t, double dt, PredictedBlock<D>& block) {
  if (predictor == Predictor::hancock) return hancock<D>(closure, t, dt, block);
  if (predictor == Predictor::ader) ader<D>(closure, t, dt, block);
}

template void predict<2>(Predictor, const Closure&, double, double, PredictedBlock<2>&);
template void predict<3>(Predictor, const Closure&, double, double, PredictedBlock<3>&);

}  // namespace titin
