#include "fv/sedov.hpp"

#include <cmath>
#include <numbers>

namespace titin {
namespace {

constexpr int panels = 400;  // of Simpson's rule: alpha to twelve digits
constexpr int bisections = 60;

}  // namespace

Sedov::Sedov(const Blast& blast, int dimension) : blast_(blast), j_(dimension) {
  const double D = 2.0 / (j_ + 2), g = blast_.gamma;  // of a shock at R = t = 1
  const double u = 2 * D / (g + 1), rho = (g + 1) / (g - 1), p = 2 * D * D / (g + 1);
  // dx/dy from the profile itself: energy of the shell between two places, by Simpson's rule in y.
  double energy = 0;
  const auto density_of_energy = [&](const Profile& at) {
    const double v = u * at.velocity;
    return (0.5 * rho * at.density * v * v + p * at.pressure / (g - 1)) * std::pow(at.x, j_ - 1);
  };
  for (int k = 0; k < panels; ++k) {
    const Profile a = profile(double(k) / panels), m = profile((k + 0.5) / panels), b = profile((k + 1.0) / panels);
    // The parabola through x at the three places gives dx there, in units of a panel.
    const double first = -3 * a.x + 4 * m.x - b.x, middle = b.x - a.x, last = a.x - 4 * m.x + 3 * b.x;
    energy += (density_of_energy(a) * first + 4 * density_of_energy(m) * middle + density_of_energy(b) * last) / 6;
  }
  alpha_ = (j_ == 2 ? 2 : 4) * std::numbers::pi * energy;
}

/// Kamm & Timmes' lambda, f, g, h at V = V_0 + (V_2 - V_0) y^(1/k).
Sedov::Profile Sedov::profile(double y) const {
  const double g = blast_.gamma, j = j_;
  const double a2 = -(g - 1) / (2 * (g - 1) + j), a0 = 2 / (j + 2);
  const double a1 = (j + 2) * g / (2 + j * (g - 1)) * (2 * j * (2 - g) / (g * (j + 2) * (j + 2)) - a2);
  const double a3 = j / (2 * (g - 1) + j), a4 = (j + 2) * a1 / (2 - g), a5 = -2 / (2 - g);
  const double above = std::pow(y, -1 / a2);  // (V - V_0) / (V_2 - V_0)
  const double V0 = 2 / ((j + 2) * g), V2 = 4 / ((j + 2) * (g + 1)), V = V0 + (V2 - V0) * above;
  const double steep = (j + 2) * (g + 1) / ((j + 2) * (g + 1) - 2 * (2 + j * (g - 1)));
  const double x1 = 0.25 * (j + 2) * (g + 1) * V, x3 = steep * (1 - 0.5 * (2 + j * (g - 1)) * V),
               x4 = (g + 1) / (g - 1) * (1 - 0.5 * (j + 2) * V);
  // x2 = (gamma + 1) / (gamma - 1) ((j + 2) gamma V / 2 - 1) is `above` itself: 0 at the centre, 1 at the shock.
  Profile at;
  at.x = std::pow(x1, -a0) * y * std::pow(x3, -a1);
  at.velocity = x1 * at.x;
  at.density = std::pow(above, a3) * std::pow(x3, a4) * std::pow(x4, a5);
  at.pressure = std::pow(x1, a0 * j) * std::pow(x3, a4 - 2 * a1) * std::pow(x4, 1 + a5);
  return at;
}

double Sedov::shock_radius(double t) const {
  return std::pow(blast_.energy * t * t / (alpha_ * blast_.density), 1.0 / (j_ + 2));
}

FlowPoint Sedov::at(const Vec3& x, double t) const {
  const double r = norm(x), R = shock_radius(t), g = blast_.gamma;
  FlowPoint point{blast_.density, blast_.pressure, {}};
  if (!(t > 0) || r >= R) return point;
  double low = 0, high = 1;
  for (int k = 0; k < bisections; ++k) (profile(0.5 * (low + high)).x * R < r ? low : high) = 0.5 * (low + high);
  const Profile here = profile(high);
  const double D = 2 * R / ((j_ + 2) * t);
  point.density *= (g + 1) / (g - 1) * here.density;
  point.pressure = 2 * blast_.density * D * D / (g + 1) * here.pressure;
  for (int i = 0; i < 3 && r > 0; ++i) point.velocity[i] = 2 * D / (g + 1) * here.velocity * x[i] / r;
  return point;
}

}  // namespace titin
