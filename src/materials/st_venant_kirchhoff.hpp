/// St Venant-Kirchhoff: W = lambda/2 (tr E)^2 + mu E : E [J/m^3], E = (C - I)/2. Holzapfel (2000), sec. 6.5.
/// For small strains and for checks: under compression it softens (below a stretch of 0.577 in uniaxial strain) and
/// lets volumes vanish at finite energy. Takes no volumetric law.
#pragma once

#include "materials/full_strain.hpp"
#include "materials/registry.hpp"

namespace titin {

struct StVenantKirchhoff {
  static constexpr auto name = "st_venant_kirchhoff";
  static constexpr auto formula = "W = lambda/2 (tr E)^2 + mu E : E";
  static constexpr auto source = "Holzapfel 2000, Nonlinear Solid Mechanics, sec. 6.5";
  inline static const std::array published{
      ParameterSet{"elastic flag of a benchmark, E = 1.4 MPa, nu = 0.4", R"(mu = "0.5 MPa", lambda = "2 MPa")",
                   "Turek & Hron 2006, Lect. Notes Comput. Sci. Eng. 53:371, FSI1"}};
  static constexpr std::array uses{Invariant::I1, Invariant::I2, Invariant::J};

  double mu = 0, lambda = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus"});
    s.read("lambda", lambda, {.unit = "Pa", .required = true, .doc = "first Lame constant"});
    if (!s.describing() && !(3 * lambda + 2 * mu > 0))
      s.error("lambda", "the bulk modulus lambda + 2/3 mu is not positive", "raise lambda above -2/3 mu");
  }
  /// tr E = e1/2 and E : E = (4 e1 - 2 e2 + e1^2)/4 in the invariants of C.
  std::vector<Advice> advice() const {
    constexpr double nearly_incompressible = 50;  // Poisson's ratio 0.49
    if (lambda <= nearly_incompressible * mu) return {};
    return {{"lambda",
             "Poisson's ratio is above 0.49: elements of displacements alone lock; take neo_hookean with a "
             "volumetric law"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    const auto [e1, e2, log_J] = full_strain(x);
    return 0.125 * lambda * e1 * e1 + 0.25 * mu * (4.0 * e1 - 2.0 * e2 + e1 * e1);
  }
};
TITIN_LAW(StVenantKirchhoff)

}  // namespace titin
