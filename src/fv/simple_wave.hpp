/// A smooth wave that runs along x into a perfect gas at rest, and steepens: exact until it breaks.
///
/// Along x = xi + (u + c) t the state of the start stays: u = u_0(xi), c = c_0 + (gamma - 1) / 2 u, and the entropy is
/// the same everywhere, rho = rho_0 (c / c_0)^(2 / (gamma - 1)). Courant & Friedrichs (1948), sec. 30. The pulse is u_0
/// = amplitude cos^4(pi (xi - centre) / width) within its width. Units SI.
#pragma once

#include "fv/exact_flow.hpp"

namespace titin {

class SimpleWave final : public ExactFlow {
 public:
  struct Setup {
    double density = 1, pressure = 1;                   // at rest [kg/m^3], [Pa]
    double amplitude = 0.1, centre = 0.4, width = 0.5;  // of the velocity [m/s]; [m]
    double gamma = 1.4;
  };
  explicit SimpleWave(const Setup& setup) : setup_(setup) {}
  FlowPoint at(const Vec3& x, double t) const override;
  double breaking_time() const;  ///< [s]

 private:
  double start(double xi) const;  // u_0
  Setup setup_;
};

}  // namespace titin
