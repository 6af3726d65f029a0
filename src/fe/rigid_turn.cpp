#include "fe/rigid_turn.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "fe/places_of_dofs.hpp"
#include "mesh/simplex_geometry.hpp"

namespace titin {

namespace {

constexpr int max_iterations = 30;  // of the polar decomposition, which doubles its digits
constexpr double round_off = 1e-14;

/// The rotation about `angle` by its length (Rodrigues).
Mat3 rotation(const Vec3& angle) {
  const double size = norm(angle);
  if (size == 0) return identity;
  const Mat3 W{0, -angle[2], angle[1], angle[2], 0, -angle[0], -angle[1], angle[0], 0};
  Mat3 R = identity;
  add(R, std::sin(size) / size, W);
  add(R, (1 - std::cos(size)) / (size * size), multiply(W, W));
  return R;
}

/// Axis times angle of a rotation; zero for half turns, whose sense is unknown.
Vec3 angle_of(const Mat3& R) {
  const Vec3 twice_sine{R[7] - R[5], R[2] - R[6], R[3] - R[1]};
  const double sine = 0.5 * norm(twice_sine), angle = std::atan2(sine, 0.5 * (trace(R) - 1));
  Vec3 result{};
  if (sine > round_off)
    for (int i = 0; i < 3; ++i) result[i] = 0.5 * twice_sine[i] * angle / sine;
  return result;
}

/// Orthogonal factor of A: Newton's iteration R <- (R + R^-T) / 2 (Higham 1986). No turn if A mirrors or is flat.
Mat3 orthogonal_factor(Mat3 R) {
  for (int n = 0; n < max_iterations; ++n) {
    const double J = determinant(R);
    if (!(J > 0)) return identity;
    Mat3 next = scaled(0.5, R);
    add(next, 0.5 / J, cofactor(R));
    double change = 0;
    for (int i = 0; i < 9; ++i) change = std::max(change, std::abs(next[i] - R[i]));
    R = next;
    if (change < round_off) break;
  }
  return R;
}

}  // namespace

RigidTurn::RigidTurn(mfem::ParFiniteElementSpace& space)
    : dimension_(space.GetVDim()), nodes_(space.GetTrueVSize() / dimension_), X_(places_of_dofs(space)) {}

Vec3 RigidTurn::at(const mfem::Vector& v, int node) const {
  Vec3 x{};
  for (int i = 0; i < dimension_; ++i) x[i] = v(dimension_ * node + i);
  return x;
}

Vec3 RigidTurn::mean(const mfem::Vector& v) const {
  Vec3 total{};
  for (int node = 0; node < nodes_; ++node)
    for (int i = 0; i < dimension_; ++i) total[i] += v(dimension_ * node + i);
  const double count = sum(double(nodes_));
  for (double& x : total) x = sum(x) / count;
  return total;
}

Mat3 RigidTurn::moment(const mfem::Vector& x, const mfem::Vector& y) const {
  const Vec3 x_mean = mean(x), y_mean = mean(y);
  Mat3 M{};
  for (int node = 0; node < nodes_; ++node) {
    const Vec3 a = at(x, node), b = at(y, node);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M[3 * i + j] += (a[i] - x_mean[i]) * (b[j] - y_mean[j]);
  }
  for (double& entry : M) entry = sum(entry);
  return M;
}

Vec3 RigidTurn::angle_of_step(const mfem::Vector& x, const Integrator& motion) const {
  mfem::Vector x_old(x);
  x_old -= motion.last_change();
  Mat3 M = moment(x, x_old);
  if (dimension_ == 2) M[8] = 0.5 * trace(M);  // a plane body turns in its plane
  const double size = std::sqrt(contract(M, M));
  return size > 0 ? angle_of(orthogonal_factor(scaled(1 / size, M))) : Vec3{};
}

/// Least squares: the angular momentum of equal masses at the nodes over their inertia.
Vec3 RigidTurn::angular_velocity(const mfem::Vector& x, const mfem::Vector& v) const {
  const Mat3 M = moment(x, x), L = moment(x, v);
  Mat3 inertia = scaled(-1.0, M);
  add(inertia, trace(M), identity);
  const double J = determinant(inertia);
  if (!(J > 0)) return {};
  return multiply(scaled(1 / J, cofactor(inertia)), Vec3{L[5] - L[7], L[6] - L[2], L[1] - L[3]});
}

mfem::Vector RigidTurn::guess(const Integrator& motion, double dt) const {
  mfem::Vector x(X_);
  x += motion.u();
  const mfem::Vector& v = motion.seen_velocity();
  const double dt_old = motion.dt_old();
  const bool chord = dt_old > 0 && motion.config().velocity == VelocityForm::rothe;
  Vec3 rate = dt_old > 0 ? angle_of_step(x, motion) : angular_velocity(x, v);
  if (dt_old > 0)
    for (double& r : rate) r /= dt_old;
  const Mat3 Q = rotation({dt * rate[0], dt * rate[1], dt * rate[2]});
  const Mat3 back = rotation({-dt_old * rate[0], -dt_old * rate[1], -dt_old * rate[2]});
  const Vec3 c = mean(x), v_c = mean(v);
  mfem::Vector u(x.Size());
  for (int node = 0; node < nodes_; ++node) {
    Vec3 r = at(x, node), w = at(v, node);
    for (int i = 0; i < 3; ++i) r[i] -= c[i], w[i] -= v_c[i];
    Vec3 turning = cross(rate, r);
    if (chord) {
      const Vec3 before = multiply(back, r);
      for (int i = 0; i < 3; ++i) turning[i] = (r[i] - before[i]) / dt_old;
    }
    for (int i = 0; i < 3; ++i) r[i] += dt * (w[i] - turning[i]);
    const Vec3 turned = multiply(Q, r);
    for (int i = 0; i < dimension_; ++i)
      u(dimension_ * node + i) = c[i] + dt * v_c[i] + turned[i] - X_(dimension_ * node + i);
  }
  return u;
}

}  // namespace titin
