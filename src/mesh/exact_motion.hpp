/// Motions of solids whose exact solution is known, by linear elasticity: what the errors of a run are against.
///
/// * swing: a plate between slippery walls, u = U sin(w t) (-sin a cos b, cos a sin b), (a, b) = pi (x, y) / L,
///   w = (pi / L) sqrt(2 mu / rho): free of divergence, so the bulk modulus plays no part.
/// * blake: a pressure p that is put at once into a spherical cavity of radius r0 in an endless body. With
///   t' = t - (r - r0) / c, c^2 = (K + 4/3 mu) / rho, n = (1 - 2 nu) / (1 - nu) c / r0, b = n / sqrt(1 - 2 nu),
///   q = n^2 + b^2:  u = r0 p / (rho q r^2) {1 - e^(-n t') [cos b t' - (q r / c - n) / b sin b t']} behind the front.
///   Blake (1952), J. Acoust. Soc. Am. 24:211; Kamm & Ankeny (2009), LA-UR-09-01255.
///
/// True to the order of the strain: keep it small. Units SI.
#pragma once

#include <memory>

#include "base/config.hpp"
#include "math/symmetric.hpp"
#include "math/tensor.hpp"

namespace titin {

struct MotionPoint {
  Vec3 displacement{}, velocity{};  // [m], [m/s]
  Sym3 strain{}, stress{};          // [], [Pa]
};

class ExactMotion {
 public:
  virtual ~ExactMotion() = default;
  virtual MotionPoint at(const Vec3& X, double t) const = 0;  ///< X: at rest
  /// The direction in which normal components are compared.
  virtual Vec3 direction(const Vec3& X) const = 0;
  /// Reads [exact_motion]; null when the scene names no solution.
  static std::shared_ptr<const ExactMotion> read(Section section);
};

struct LinearSolid {
  double bulk_modulus = 0, shear_modulus = 0, density = 0;  // [Pa], [Pa], [kg/m^3]
  void bind(Section& s);
  Sym3 stress(const Sym3& strain) const;
};

class Swing final : public ExactMotion {
 public:
  Swing(const LinearSolid& solid, double amplitude, double length);
  MotionPoint at(const Vec3& X, double t) const override;
  Vec3 direction(const Vec3&) const override { return {1, 0, 0}; }
  double frequency() const { return frequency_; }  ///< [rad/s]

 private:
  LinearSolid solid_;
  double amplitude_, wave_number_, frequency_;
};

class Blake final : public ExactMotion {
 public:
  Blake(const LinearSolid& solid, double radius, double pressure);
  MotionPoint at(const Vec3& X, double t) const override;
  Vec3 direction(const Vec3& X) const override;

 private:
  LinearSolid solid_;
  double radius_, speed_, n_, b_, strength_;  // [m], [m/s], [1/s], [1/s], [m^3]
};

}  // namespace titin
