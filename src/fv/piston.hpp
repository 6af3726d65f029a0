/// A piston runs into a perfect gas at rest before a wall: the shock, its reflections at wall and piston, and so on.
///
/// Ahead of a shock the gas moves with u_1, behind it with u_2 (the piston's velocity or none). With du = |u_2 - u_1|,
/// c the speed of sound ahead and q = (gamma + 1) / 4 du, the shock runs into the gas with D = q + sqrt(q^2 + c^2), and
/// rho_2 = rho_1 D / (D - du), p_2 = p_1 + rho_1 D du (Rankine-Hugoniot). It is seen to run with u_1 +- D until it
/// meets the other end. Units SI.
#pragma once

#include <vector>

#include "fv/exact_flow.hpp"

namespace titin {

class Piston final : public ExactFlow {
 public:
  struct Setup {
    double density = 1, pressure = 1e-4;  // at the start [kg/m^3], [Pa]
    double speed = 1;                     // of the piston, along x from x = 0 [m/s]
    double length = 1;                    // of the gas; beyond is the wall [m]
    double gamma = 5.0 / 3;
  };
  explicit Piston(const Setup& setup);
  FlowPoint at(const Vec3& x, double t) const override;

  struct Shock {
    double start, place;  // when and where it sets off [s], [m]
    double velocity;      // as seen [m/s]; odd ones run to the wall
    FlowPoint behind;
  };
  const std::vector<Shock>& shocks() const { return shocks_; }

 private:
  Setup setup_;
  std::vector<Shock> shocks_;
};

}  // namespace titin
