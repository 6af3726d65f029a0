#include "mesh/named_motion.hpp"

#include <cmath>
#include <numbers>

namespace titin {
namespace {

/// The first mode of a bar with free ends, 2 at its ends; s from 0 to 1 along it.
double free_bar_mode(double s) {
  using std::cos, std::sin, std::sinh, std::cosh;
  constexpr double k = 4.730040744862704;  // cosh(k) cos(k) = 1
  const double ratio = (cosh(k) - cos(k)) / (sinh(k) - sin(k));
  return cosh(k * s) + cos(k * s) - ratio * (sinh(k * s) + sin(k * s));
}

}  // namespace

void NamedMotion::bind(Section& s) {
  s.choose(
      "motion", kind,
      {{"uniform", Kind::uniform},
       {"radial", Kind::radial},
       {"twist", Kind::twist},
       {"swing", Kind::swing},
       {"bend", Kind::bend}},
      {.doc =
           "added to the velocity. radial: rate x / |x|; twist: rate sin(pi z / (2 length)) about z; swing: rate "
           "(-sin cos, cos sin)(pi x / length, pi y / length); bend: rate times the first bending of a free bar along "
           "x in [-length / 2, length / 2], along y"});
  s.read("rate", rate, {.doc = "of the motion, in m/s (twist: 1/s)"});
  s.read("length", length, {.unit = "m", .range = positive, .doc = "of the motion"});
}

Vec3 NamedMotion::velocity_at(const Vec3& x) const {
  constexpr double pi = std::numbers::pi;
  const double a = pi * x[0] / length, b = pi * x[1] / length;
  switch (kind) {
    case Kind::uniform:
      break;
    case Kind::radial: {
      const double r = norm(x);
      return r > 0 ? Vec3{rate * x[0] / r, rate * x[1] / r, rate * x[2] / r} : Vec3{};
    }
    case Kind::twist: {
      const double spin = rate * std::sin(0.5 * pi * x[2] / length);
      return {-spin * x[1], spin * x[0], 0};
    }
    case Kind::swing:
      return {-rate * std::sin(a) * std::cos(b), rate * std::cos(a) * std::sin(b), 0};
    case Kind::bend:
      return {0, rate * free_bar_mode(x[0] / length + 0.5), 0};
  }
  return {};
}

}  // namespace titin
