#include "fv/exact_flow.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

constexpr int most_iterations = 100;
constexpr double round_off = 1e-15;

Vec3 scaled_velocity(const Vec3& x, double s) { return {s * x[0], s * x[1], s * x[2]}; }

enum class Solution { none, kidder, riemann, noh };

std::shared_ptr<const ExactFlow> read_kidder(Section s, int dimension) {
  Kidder::Shell shell;
  s.read("inner_radius", shell.inner_radius, {.unit = "m", .range = positive, .doc = "of the shell at the start"});
  s.read("outer_radius", shell.outer_radius, {.unit = "m", .range = positive, .doc = "of the shell at the start"});
  s.read("inner_density", shell.inner_density, {.unit = "kg/m^3", .range = positive, .doc = "at the inner radius"});
  s.read("outer_density", shell.outer_density, {.unit = "kg/m^3", .range = positive, .doc = "at the outer radius"});
  s.read("entropy", shell.entropy, {.range = positive, .doc = "p / rho^gamma in SI units, gamma = 1 + 2 / dimension"});
  if (shell.inner_radius >= shell.outer_radius || shell.inner_density >= shell.outer_density) {
    s.error("", "the shell must be denser outside than inside",
            "take inner_radius < outer_radius and inner_density < outer_density");
    return nullptr;
  }
  return std::make_shared<Kidder>(shell, dimension);
}

void read_side(Section s, Riemann::Side& side) {
  s.read("density", side.density, {.unit = "kg/m^3", .range = positive, .doc = "of this side"});
  s.read("pressure", side.pressure, {.unit = "Pa", .range = positive, .doc = "of this side"});
  s.read("velocity", side.velocity, {.unit = "m/s", .doc = "along x"});
}

std::shared_ptr<const ExactFlow> read_riemann(Section s) {
  Riemann::Side left{1, 1, 0}, right{0.125, 0.1, 0};
  double position = 0.5, gamma = 1.4;
  s.read("position", position, {.unit = "m", .doc = "x of the plane between the two sides"});
  s.read("gamma", gamma, {.range = {.min = 1, .open_min = true}, .doc = "of the perfect gas on both sides"});
  read_side(s.section("left", "the state where x is less"), left);
  read_side(s.section("right", "the state where x is more"), right);
  return std::make_shared<Riemann>(left, right, position, gamma);
}

std::shared_ptr<const ExactFlow> read_noh(Section s, int dimension) {
  double density = 1, pressure = 1e-6, speed = 1, gamma = 5.0 / 3;
  s.read("density", density, {.unit = "kg/m^3", .range = positive, .doc = "at the start"});
  s.read("pressure", pressure, {.unit = "Pa", .range = positive, .doc = "at the start: nearly none"});
  s.read("speed", speed, {.unit = "m/s", .range = positive, .doc = "towards the origin"});
  s.read("gamma", gamma, {.range = {.min = 1, .open_min = true}, .doc = "of the perfect gas"});
  return std::make_shared<Noh>(density, pressure, speed, gamma, dimension);
}

}  // namespace

std::shared_ptr<const ExactFlow> ExactFlow::read(Section s, int dimension) {
  Solution solution = Solution::none;
  s.choose(
      "solution", solution,
      {{"none", Solution::none}, {"kidder", Solution::kidder}, {"riemann", Solution::riemann}, {"noh", Solution::noh}},
      {.doc = "a flow that is known exactly: the start of the run and what its errors are against"});
  const bool all = s.describing();
  std::shared_ptr<const ExactFlow> flow;
  if (all || solution == Solution::kidder)
    flow = read_kidder(s.section("kidder", "isentropic compression of a shell"), dimension);
  if (all || solution == Solution::riemann) flow = read_riemann(s.section("riemann", "a shock tube along x"));
  if (all || solution == Solution::noh) flow = read_noh(s.section("noh", "implosion onto the origin"), dimension);
  return flow;
}

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
