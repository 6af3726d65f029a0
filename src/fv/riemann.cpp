#include "fv/riemann.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

constexpr int most_iterations = 100;
constexpr double round_off = 1e-15;
/// What an iteration may leave of the distance to the least pressure that both sides can have.
constexpr double least_part = 1e-8;

/// w and P of the perfect gas that a side's waves are those of.
struct Perfect {
  double volume, pressure, gamma;
  explicit Perfect(const Riemann::Side& s)
      : volume(1 / s.density - s.covolume), pressure(s.pressure + s.stiffening), gamma(s.gamma) {}
  double sound() const { return std::sqrt(gamma * pressure * volume); }
};

Riemann::Side mirrored(Riemann::Side s) {
  s.velocity = -s.velocity;
  return s;
}

}  // namespace

Riemann::Riemann(const Side& left, const Side& right, double position)
    : left_(left), right_(right), position_(position) {
  solve();
}

Riemann::Riemann(Side left, Side right, double position, double gamma)
    : left_(left), right_(right), position_(position) {
  left_.gamma = right_.gamma = gamma;
  solve();
}

void Riemann::solve() {
  const double least = -std::min(left_.stiffening, right_.stiffening);
  p_ = std::max(left_.pressure, right_.pressure);  // which both sides can have
  for (int k = 0; k < most_iterations; ++k) {
    const Wave l = wave(left_, p_), r = wave(right_, p_);
    const double next = std::max(p_ - (l.jump + r.jump + right_.velocity - left_.velocity) / (l.slope + r.slope),
                                 least + least_part * (p_ - least));
    const bool done = std::abs(next - p_) <= round_off * (p_ - least);
    p_ = next;
    if (done) break;
  }
  u_ = 0.5 * (left_.velocity + right_.velocity + wave(right_, p_).jump - wave(left_, p_).jump);
}

/// Shock (Rankine-Hugoniot) or rarefaction (isentropic) between a side and the star state.
Riemann::Wave Riemann::wave(const Side& s, double p) {
  const Perfect side(s);
  const double P = p + s.stiffening, gamma = s.gamma, c = side.sound(), ratio = P / side.pressure;
  if (P > side.pressure) {
    const double A = 2 * side.volume / (gamma + 1), B = (gamma - 1) / (gamma + 1) * side.pressure,
                 root = std::sqrt(A / (P + B));
    return {root * (1 - 0.5 * (P - side.pressure) / (P + B)), (P - side.pressure) * root};
  }
  const double exponent = 0.5 * (gamma - 1) / gamma;
  return {std::pow(ratio, exponent - 1) * side.volume / c, 2 * c / (gamma - 1) * (std::pow(ratio, exponent) - 1)};
}

/// What the left side's wave leaves at x / t = speed left of the contact; the right side's is its mirror image.
Riemann::Side Riemann::sample(const Side& s, double p, double u, double speed) {
  const Perfect side(s);
  const double gamma = s.gamma, c = side.sound(), ratio = (p + s.stiffening) / side.pressure,
               g = (gamma - 1) / (gamma + 1);
  if (ratio > 1) {
    Side star = s;
    const double volume = side.volume * (g * ratio + 1) / (ratio + g);
    star.density = 1 / (volume + s.covolume), star.pressure = p, star.velocity = u;
    const double flux = std::sqrt((ratio - 1) * side.pressure / (side.volume - volume));
    return speed < s.velocity - flux / s.density ? s : star;
  }
  // Along the isentrope, by the speed of sound of the perfect gas over that of the side.
  const auto state = [&](double part) {
    Side inside = s;
    inside.density = 1 / (side.volume * std::pow(part, -2 / (gamma - 1)) + s.covolume);
    inside.pressure = side.pressure * std::pow(part, 2 * gamma / (gamma - 1)) - s.stiffening;
    inside.velocity = s.velocity + 2 * c / (gamma - 1) * (1 - part);
    return inside;
  };
  const auto characteristic = [&](double part) {
    const Side inside = state(part);
    return inside.velocity - part * c / (1 - s.covolume * inside.density);
  };
  double behind = std::pow(ratio, 0.5 * (gamma - 1) / gamma), ahead = 1;
  if (speed < characteristic(ahead)) return s;
  if (speed > characteristic(behind)) return state(behind);
  for (int k = 0; k < most_iterations && ahead - behind > round_off; ++k) {
    const double middle = 0.5 * (ahead + behind);
    (characteristic(middle) > speed ? behind : ahead) = middle;
  }
  return state(ahead);
}

FlowPoint Riemann::at(const Vec3& x, double t) const {
  Side s = x[0] < position_ ? left_ : right_;
  if (t > 0) {
    const double speed = (x[0] - position_) / t;
    s = speed < u_ ? sample(left_, p_, u_, speed) : mirrored(sample(mirrored(right_), p_, -u_, -speed));
  }
  return {s.density, s.pressure, {s.velocity, 0, 0}};
}

}  // namespace titin
