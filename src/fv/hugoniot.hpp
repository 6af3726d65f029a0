/// A piston runs at once into a material at rest, without pressure, whose shocks run with D = c0 + s u (u the speed of
/// the piston): rho = rho_0 D / (D - u) and p = rho_0 D u behind the shock at x = D t (Rankine-Hugoniot; Meyers 1994,
/// Dynamic Behavior of Materials, ch. 4). A Mie-Grueneisen law meets it for any Gamma. Units SI.
#pragma once

#include "fv/exact_flow.hpp"

namespace titin {

class HugoniotShock final : public ExactFlow {
 public:
  struct Setup {
    double density = 8930, sound_speed = 3940, slope = 1.489;  // copper
    double speed = 1000;                                       // of the piston, along x from x = 0 [m/s]
  };
  explicit HugoniotShock(const Setup& setup) : setup_(setup) {}
  double shock_speed() const { return setup_.sound_speed + setup_.slope * setup_.speed; }  ///< [m/s]
  FlowPoint at(const Vec3& x, double t) const override {
    const double D = shock_speed();
    if (x[0] >= D * t) return {setup_.density, 0, {}};
    return {setup_.density * D / (D - setup_.speed), setup_.density * D * setup_.speed, {setup_.speed, 0, 0}};
  }

 private:
  Setup setup_;
};

}  // namespace titin
