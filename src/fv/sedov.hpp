/// Sedov's point blast in a uniform perfect gas at no pressure: the similarity solution, with a quadrature that holds
/// at the centre.
///
/// The shock is at R(t) = (E t^2 / (alpha rho_0))^(1/(j+2)), E the energy of the whole line (j = 2, per length) or
/// point (j = 3). Behind it x = r/R, u, rho and p are products of powers of four linear functions of V = (j+2)/2 t u /
/// r ... Kamm & Timmes (2007), LA-UR-07-2849, eqs. 22-33 (standard case, uniform density). Towards the centre x grows
/// as (V - V_0)^k with a small k; with y = ((V - V_0) / (V_2 - V_0))^k as variable all integrands are smooth, and alpha
/// = S_j int_0^1 (rho u^2 / 2 + p / (gamma - 1)) x^(j-1) dx, S_j = 2 pi or 4 pi, for R = t = rho_0 = 1, is the energy
/// itself: nothing is looked up.
#pragma once

#include "fv/exact_flow.hpp"

namespace titin {

class Sedov final : public ExactFlow {
 public:
  struct Blast {
    double density = 1, pressure = 1e-6;  // ahead [kg/m^3], [Pa]
    double energy = 1;                    // all around the origin [J], in the plane [J/m]
    double gamma = 1.4;                   // below 2
  };
  Sedov(const Blast& blast, int dimension);
  /// At t = 0 the gas at rest without the blast, which the scene adds.
  FlowPoint at(const Vec3& x, double t) const override;
  double shock_radius(double t) const;     ///< [m]
  double alpha() const { return alpha_; }  ///< of the energy

 private:
  struct Profile {
    double x, velocity, density, pressure;  // over R and the values behind the shock
  };
  Profile profile(double y) const;

  Blast blast_;
  int j_;
  double alpha_ = 1;
};

}  // namespace titin
