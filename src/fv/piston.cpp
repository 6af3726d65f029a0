#include "fv/piston.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

constexpr int most_shocks = 20;  // by then the gas is as thin as a thousandth of its length

}  // namespace

Piston::Piston(const Setup& setup) : setup_(setup) {
  FlowPoint ahead{setup.density, setup.pressure, {}};
  double t = 0, x = 0;
  for (int k = 0; k < most_shocks; ++k) {
    const double way = k % 2 == 0 ? 1 : -1, du = setup.speed;
    const double q = 0.25 * (setup.gamma + 1) * du;
    const double D = q + std::sqrt(q * q + setup.gamma * ahead.pressure / ahead.density);
    FlowPoint behind{ahead.density * D / (D - du), ahead.pressure + ahead.density * D * du, {}};
    behind.velocity[0] = k % 2 == 0 ? setup.speed : 0;
    const double seen = ahead.velocity[0] + way * D;
    shocks_.push_back({t, x, seen, behind});
    // It meets the wall, which rests, or the piston, which comes towards it.
    const double gap = k % 2 == 0 ? setup.length - x : x - setup.speed * t;
    const double time = gap / (k % 2 == 0 ? seen : setup.speed - seen);
    t += time;
    x += seen * time;
    ahead = behind;
  }
}

FlowPoint Piston::at(const Vec3& x, double t) const {
  const auto later = std::find_if(shocks_.begin(), shocks_.end(), [&](const Shock& s) { return s.start > t; });
  const auto last = later - 1;  // the first sets off at 0
  const double front = last->place + last->velocity * (t - last->start);
  if (last->velocity > 0 ? x[0] < front : x[0] > front) return last->behind;
  if (last == shocks_.begin()) return {setup_.density, setup_.pressure, {}};
  return (last - 1)->behind;
}

}  // namespace titin
