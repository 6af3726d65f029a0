/// Velocities that a body may start with, by name; x is the position at rest.
///
/// * radial: rate x / |x|
/// * twist: rate sin(pi z / (2 length)) about the z axis; Haider, Lee, Gil, Bonet (2017)
/// * swing: rate (-sin a cos b, cos a sin b), (a, b) = pi (x, y) / length; Scovazzi, Carnes, Zeng, Rossi (2016)
/// * bend: rate times the first mode of a bar with free ends, along x in [-length / 2, length / 2], in y;
///   cosh k cos k = 1: Timoshenko (1937), Vibration Problems in Engineering, art. 37
#pragma once

#include "base/config.hpp"
#include "math/tensor.hpp"

namespace titin {

struct NamedMotion {
  enum class Kind { uniform, radial, twist, swing, bend };
  Kind kind = Kind::uniform;
  double rate = 0, length = 1;  // [m/s], of a twist [1/s]; [m]
  void bind(Section& s);
  Vec3 velocity_at(const Vec3& x) const;  ///< [m/s]; zero when uniform
};

}  // namespace titin
