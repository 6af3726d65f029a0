#include "fv/simple_wave.hpp"

#include <cmath>
#include <numbers>

namespace titin {
namespace {

constexpr int bisections = 60;  // to round-off of the width

}  // namespace

double SimpleWave::start(double xi) const {
  const double s = (xi - setup_.centre) / setup_.width;
  return std::abs(s) < 0.5 ? setup_.amplitude * std::pow(std::cos(std::numbers::pi * s), 4) : 0;
}

/// 1 / max of -(gamma + 1) / 2 u_0', which for cos^4 is at tan^2 = 1/3: 4 (sqrt(3)/2)^3 / 2 = 3 sqrt(3) / 4.
double SimpleWave::breaking_time() const {
  const double steepest = 0.75 * std::sqrt(3.0) * std::numbers::pi * std::abs(setup_.amplitude) / setup_.width;
  return 2 / ((setup_.gamma + 1) * steepest);
}

FlowPoint SimpleWave::at(const Vec3& x, double t) const {
  const double c0 = std::sqrt(setup_.gamma * setup_.pressure / setup_.density), half = 0.5 * (setup_.gamma + 1);
  const auto arrives = [&](double xi) { return xi + (c0 + half * start(xi)) * t; };  // u + c
  double low = setup_.centre - 0.5 * setup_.width, high = setup_.centre + 0.5 * setup_.width, u = 0;
  if (x[0] > arrives(low) && x[0] < arrives(high)) {
    for (int k = 0; k < bisections; ++k) {
      const double middle = 0.5 * (low + high);
      (arrives(middle) < x[0] ? low : high) = middle;
    }
    u = start(0.5 * (low + high));
  }
  const double ratio = 1 + 0.5 * (setup_.gamma - 1) * u / c0;
  const double rho = setup_.density * std::pow(ratio, 2 / (setup_.gamma - 1));
  return {rho, setup_.pressure * std::pow(ratio, 2 * setup_.gamma / (setup_.gamma - 1)), {u, 0, 0}};
}

}  // namespace titin
