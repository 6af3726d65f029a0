/// The explosion of a ball (3-D), cylinder (2-D) or slab (1-D) of perfect gas, computed along the radius alone.
///
///   d(V_i U_i)/dt = A_{i-1/2} F_{i-1/2} - A_{i+1/2} F_{i+1/2} + (0, p_i (A_{i+1/2} - A_{i-1/2}), 0),
///
/// U = (rho, rho u, rho E), on shells fixed in space: slopes of rho, u, p limited by van Leer's mean (1977), fluxes of
/// HLLC (Toro, Spruce, Speares 1994), Heun's two stages. A reference that shares nothing with the scheme it judges.
/// Units SI.
#pragma once

#include <vector>

#include "fv/exact_flow.hpp"

namespace titin {

/// [shell] at time `time`, shells of width `width` from the origin.
struct RadialProfile {
  double time = 0, width = 0;
  std::vector<double> density, velocity, pressure;
  FlowPoint at(double radius) const;  ///< linear between middles of shells; the velocity along x
};

class Explosion final : public ExactFlow {
 public:
  struct Side {
    double density = 1, pressure = 1;
  };
  struct Setup {
    Side inside{1, 1}, outside{0.125, 0.1};
    double radius = 0.5, end = 1.5;  // between the two; of the last shell, which nothing may reach [m]
    double gamma = 1.4;
    int shells = 2000;
  };
  Explosion(const Setup& setup, int dimension) : setup_(setup), dimension_(dimension) {}
  /// The run is made once for each time that is asked for.
  FlowPoint at(const Vec3& x, double t) const override;
  RadialProfile profile(double t) const;

 private:
  Setup setup_;
  int dimension_;
  mutable RadialProfile known_;
};

}  // namespace titin
