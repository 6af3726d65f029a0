/// Two uniform states of fluids beside a plane x = position, which may be of two materials.
///
/// Each side is a Noble-Abel stiffened gas, p = (gamma - 1) rho e / (1 - b rho) - gamma Pi; a perfect gas has b = Pi =
/// 0. With w = 1 / rho - b and P = p + Pi the jumps over a shock (Rankine-Hugoniot) and the isentrope P w^gamma = const
/// are those of a perfect gas of density 1 / w and pressure P, and so are velocities over waves (Toro 2009, Riemann
/// Solvers, ch. 4). Waves are seen to run with the fluid's own density: shocks with u -+ m / rho, characteristics with
/// u -+ c, c = sqrt(gamma P w) (w + b) / w. Units SI.
#pragma once

#include "fv/exact_flow.hpp"

namespace titin {

class Riemann final : public ExactFlow {
 public:
  struct Side {
    double density = 1, pressure = 1, velocity = 0;
    double gamma = 1.4, covolume = 0, stiffening = 0;  // b [m^3/kg], Pi [Pa]
  };
  Riemann(const Side& left, const Side& right, double position);
  /// Of one perfect gas.
  Riemann(Side left, Side right, double position, double gamma);
  FlowPoint at(const Vec3& x, double t) const override;
  double star_pressure() const { return p_; }
  double star_velocity() const { return u_; }

 private:
  struct Wave {
    double slope;  // of the velocity over the pressure [m/s/Pa]
    double jump;   // of the velocity from the side's to the star state [m/s]
  };
  void solve();
  static Wave wave(const Side& side, double p);
  static Side sample(const Side& side, double p, double u, double speed);

  Side left_, right_;
  double position_, p_ = 0, u_ = 0;
};

}  // namespace titin
