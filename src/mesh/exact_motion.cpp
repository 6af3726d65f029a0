#include "mesh/exact_motion.hpp"

#include <cmath>
#include <numbers>

namespace titin {
namespace {

enum class Solution { none, swing, blake };

/// s ff + r (1 - ff) for a unit vector f.
Sym3 around(const Vec3& f, double along, double across) {
  const double d = along - across;
  return {across + d * f[0] * f[0], across + d * f[1] * f[1], across + d * f[2] * f[2],
          d * f[0] * f[1],          d * f[1] * f[2],          d * f[0] * f[2]};
}

}  // namespace

std::shared_ptr<const ExactMotion> ExactMotion::read(Section s) {
  Solution solution = Solution::none;
  s.choose("solution", solution, {{"none", Solution::none}, {"swing", Solution::swing}, {"blake", Solution::blake}},
           {.doc = "a solid's motion that is known exactly: what its errors are against; it does not start the run"});
  if (!s.describing() && solution == Solution::none) return nullptr;
  LinearSolid solid;
  solid.bind(s);
  double amplitude = 1e-3, length = 1, radius = 1, pressure = 1;
  if (s.describing() || solution == Solution::swing) {
    Section of = s.section("swing", "a plate [0, length]^2 swings between slippery walls");
    of.read("amplitude", amplitude, {.unit = "m", .range = positive, .doc = "of its displacement"});
    of.read("length", length, {.unit = "m", .range = positive, .doc = "of the plate"});
  }
  if (s.describing() || solution == Solution::blake) {
    Section of = s.section("blake", "a spherical cavity about the origin is pressed open");
    of.read("radius", radius, {.unit = "m", .range = positive, .doc = "of the cavity"});
    of.read("pressure", pressure, {.unit = "Pa", .range = positive, .doc = "in it, from the start on"});
  }
  if (solution == Solution::blake) return std::make_shared<Blake>(solid, radius, pressure);
  return std::make_shared<Swing>(solid, amplitude, length);
}

void LinearSolid::bind(Section& s) {
  s.read("bulk_modulus", bulk_modulus, {.unit = "Pa", .range = positive, .required = true, .doc = "at small strains"});
  s.read("shear_modulus", shear_modulus,
         {.unit = "Pa", .range = positive, .required = true, .doc = "at small strains"});
  s.read("density", density, {.unit = "kg/m^3", .range = positive, .required = true, .doc = "at rest"});
}

Sym3 LinearSolid::stress(const Sym3& strain) const {
  const double trace = strain[0] + strain[1] + strain[2];
  Sym3 T;
  for (int k = 0; k < 6; ++k)
    T[k] = 2 * shear_modulus * strain[k] + (k < 3 ? (bulk_modulus - 2 * shear_modulus / 3) * trace : 0);
  return T;
}

Swing::Swing(const LinearSolid& solid, double amplitude, double length)
    : solid_(solid),
      amplitude_(amplitude),
      wave_number_(std::numbers::pi / length),
      frequency_(wave_number_ * std::sqrt(2 * solid.shear_modulus / solid.density)) {}

MotionPoint Swing::at(const Vec3& X, double t) const {
  using std::cos, std::sin;
  const double a = wave_number_ * X[0], b = wave_number_ * X[1];
  const Vec3 shape{-sin(a) * cos(b), cos(a) * sin(b), 0};
  MotionPoint point;
  for (int i = 0; i < 3; ++i) {
    point.displacement[i] = amplitude_ * sin(frequency_ * t) * shape[i];
    point.velocity[i] = amplitude_ * frequency_ * cos(frequency_ * t) * shape[i];
  }
  const double stretch = amplitude_ * wave_number_ * sin(frequency_ * t) * cos(a) * cos(b);
  point.strain = {-stretch, stretch, 0, 0, 0, 0};  // the shears cancel
  point.stress = solid_.stress(point.strain);
  return point;
}

Blake::Blake(const LinearSolid& solid, double radius, double pressure) : solid_(solid), radius_(radius) {
  const double K = solid.bulk_modulus, mu = solid.shear_modulus, nu = (3 * K - 2 * mu) / (6 * K + 2 * mu);
  speed_ = std::sqrt((K + 4 * mu / 3) / solid.density);
  n_ = (1 - 2 * nu) / (1 - nu) * speed_ / radius;
  b_ = std::sqrt(1 - 2 * nu) / (1 - nu) * speed_ / radius;
  strength_ = radius * pressure / (solid.density * (n_ * n_ + b_ * b_));
}

Vec3 Blake::direction(const Vec3& X) const {
  const double r = norm(X);
  return {X[0] / r, X[1] / r, X[2] / r};
}

MotionPoint Blake::at(const Vec3& X, double t) const {
  const double r = norm(X), since = t - (r - radius_) / speed_, q = n_ * n_ + b_ * b_;
  MotionPoint point;
  if (since <= 0) return point;
  const double decay = std::exp(-n_ * since), f = decay * std::cos(b_ * since), g = decay * std::sin(b_ * since),
               df = -n_ * f - b_ * g, dg = -n_ * g + b_ * f, s = (q * r / speed_ - n_) / b_,
               scale = strength_ / (r * r);
  const double u = scale * (1 - f + s * g), v = scale * (s * dg - df),
               du_dr = -2 * u / r - v / speed_ + scale * q / (speed_ * b_) * g;
  const Vec3 along = direction(X);
  for (int i = 0; i < 3; ++i) point.displacement[i] = u * along[i], point.velocity[i] = v * along[i];
  point.strain = around(along, du_dr, u / r);
  point.stress = solid_.stress(point.strain);
  return point;
}

}  // namespace titin
