#include "fv/exact_flow.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

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
