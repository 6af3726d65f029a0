#include "fv/exact_flow.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

constexpr int most_iterations = 100;
constexpr double round_off = 1e-15;

Vec3 scaled_velocity(const Vec3& x, double s) { return {s * x[0], s * x[1], s * x[2]}; }

}  // namespace

Kidder::Kidder(const Shell& shell, int dimension) : shell_(shell), gamma_(1 + 2.0 / dimension) {
  const auto square_of_sound = [&](double density) { return gamma_ * shell.entropy * std::pow(density, gamma_ - 1); };
  const double radii = shell.outer_radius * shell.outer_radius - shell.inner_radius * shell.inner_radius;
  tau_ = std::sqrt(0.5 * (gamma_ - 1) * radii /
                   (square_of_sound(shell.outer_density) - square_of_sound(shell.inner_density)));
}

FlowPoint Kidder::at(const Vec3& x, double t) const {
  const double h = shrinkage(t), R2 = dot(x, x) / (h * h);
  const double ri2 = shell_.inner_radius * shell_.inner_radius, re2 = shell_.outer_radius * shell_.outer_radius;
  const double mixed = ((re2 - R2) * std::pow(shell_.inner_density, gamma_ - 1) +
                        (R2 - ri2) * std::pow(shell_.outer_density, gamma_ - 1)) /
                       (re2 - ri2);
  const double rho0 = std::pow(mixed, 1 / (gamma_ - 1));
  FlowPoint point;
  point.density = std::pow(h, -2 / (gamma_ - 1)) * rho0;
  point.pressure = shell_.entropy * std::pow(point.density, gamma_);
  point.velocity = scaled_velocity(x, -t / (tau_ * tau_ * h * h));
  return point;
}

double Kidder::pressure_on_boundary(const Vec3& x, double t) const {
  const double h = shrinkage(t), middle = 0.5 * (shell_.inner_radius + shell_.outer_radius);
  const double radius = norm(x) / h < middle ? shell_.inner_radius : shell_.outer_radius;
  return at({radius * h, 0, 0}, t).pressure;
}

double Kidder::off_surface(const Vec3& x, double t) const {
  const double h = shrinkage(t), r = norm(x);
  return std::min(std::abs(r - h * shell_.inner_radius), std::abs(r - h * shell_.outer_radius));
}

Riemann::Riemann(const Side& left, const Side& right, double position, double gamma)
    : left_(left), right_(right), position_(position), gamma_(gamma) {
  p_ = 0.5 * (left.pressure + right.pressure);
  for (int k = 0; k < most_iterations; ++k) {
    const Wave l = wave(left, p_), r = wave(right, p_);
    const double next =
        std::max(p_ - (l.jump + r.jump + right.velocity - left.velocity) / (l.slope + r.slope), 1e-8 * p_);
    const bool done = std::abs(next - p_) <= round_off * p_;
    p_ = next;
    if (done) break;
  }
  u_ = 0.5 * (left.velocity + right.velocity + wave(right, p_).jump - wave(left, p_).jump);
}

/// Shock (Rankine-Hugoniot) or rarefaction (isentropic) between a side and the star state.
Riemann::Wave Riemann::wave(const Side& s, double p) const {
  const double c = sound(s), ratio = p / s.pressure;
  if (p > s.pressure) {
    const double A = 2 / ((gamma_ + 1) * s.density), B = (gamma_ - 1) / (gamma_ + 1) * s.pressure,
                 root = std::sqrt(A / (p + B));
    return {root * (1 - 0.5 * (p - s.pressure) / (p + B)), (p - s.pressure) * root};
  }
  const double exponent = 0.5 * (gamma_ - 1) / gamma_;
  return {std::pow(ratio, exponent - 1) / (s.density * c), 2 * c / (gamma_ - 1) * (std::pow(ratio, exponent) - 1)};
}

/// What the left side's wave leaves at x / t = speed left of the contact; the right side's is its mirror image.
Riemann::Side Riemann::sample(const Side& s, double speed) const {
  const double c = sound(s), ratio = p_ / s.pressure, g = (gamma_ - 1) / (gamma_ + 1);
  const bool shock = p_ > s.pressure;
  const Side star{s.density * (shock ? (ratio + g) / (g * ratio + 1) : std::pow(ratio, 1 / gamma_)), p_, u_};
  if (shock) {
    const double front = s.velocity - c * std::sqrt(0.5 / gamma_ * ((gamma_ + 1) * ratio + gamma_ - 1));
    return speed < front ? s : star;
  }
  if (speed < s.velocity - c) return s;
  if (speed > star.velocity - sound(star)) return star;
  const double inside = 2 / (gamma_ + 1) + g / c * (s.velocity - speed);
  return {s.density * std::pow(inside, 2 / (gamma_ - 1)), s.pressure * std::pow(inside, 2 * gamma_ / (gamma_ - 1)),
          2 / (gamma_ + 1) * (c + 0.5 * (gamma_ - 1) * s.velocity + speed)};
}

FlowPoint Riemann::at(const Vec3& x, double t) const {
  Side s = x[0] < position_ ? left_ : right_;
  if (t > 0) {
    const double speed = (x[0] - position_) / t;
    if (speed < u_) {
      s = sample(left_, speed);
    } else {
      Riemann mirror = *this;
      mirror.u_ = -u_;
      s = mirror.sample({right_.density, right_.pressure, -right_.velocity}, -speed);
      s.velocity = -s.velocity;
    }
  }
  return {s.density, s.pressure, {s.velocity, 0, 0}};
}

FlowPoint Noh::at(const Vec3& x, double t) const {
  const double r = norm(x);
  if (r < shock_radius(t)) {
    const double behind = density_ * std::pow((gamma_ + 1) / (gamma_ - 1), dimension_);
    return {behind, 0.5 * (gamma_ - 1) * behind * speed_ * speed_, {}};
  }
  const double gathered = std::pow(1 + speed_ * t / r, dimension_ - 1);
  return {density_ * gathered, pressure_ * std::pow(gathered, gamma_), scaled_velocity(x, r > 0 ? -speed_ / r : 0)};
}

}  // namespace titin
