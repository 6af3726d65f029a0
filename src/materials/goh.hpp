/// Gasser-Ogden-Holzapfel fibres with dispersion, one family: W = k1/(2 k2) (exp(k2 E^2) - 1) [J/m^3],
/// E = kappa (I1 - 3) + (1 - 3 kappa)(I4 - 1). Gasser, Ogden & Holzapfel (2006), J. R. Soc. Interface 3, 15.
///
/// kappa = 0 are aligned fibres (Holzapfel, Gasser & Ogden 2000), kappa = 1/3 isotropic ones. A wall with two families
/// has two such terms, the other with family = "second", and a neo-Hookean matrix (mu = 2 C10). Where fibres would
/// push: `E` switches them off for E <= 0, with a continuous stress; `I4` drops I4 - 1 <= 0 from E, which makes the
/// stress jump unless kappa = 0; `none` lets them push.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Goh {
  static constexpr auto name = "goh";
  static constexpr auto formula = "W = k1/(2 k2) (exp(k2 E^2) - 1), E = kappa (I1 - 3) + (1 - 3 kappa)(I4 - 1)";
  static constexpr auto source = "Gasser, Ogden & Holzapfel 2006, J. R. Soc. Interface 3:15";
  static constexpr std::array uses{Invariant::I1, Invariant::I4};
  enum class Switch { E, I4, none };

  double k1 = 0, k2 = 0, kappa = 0;
  Switch tension_only = Switch::E;

  void bind(Section& s) {
    s.read("k1", k1, {.unit = "Pa", .range = non_negative, .required = true, .doc = "stiffness of the fibres"});
    s.read("k2", k2, {.range = positive, .required = true, .doc = "how fast they stiffen"});
    s.read("kappa", kappa, {.range = {.min = 0, .max = 1.0 / 3}, .doc = "dispersion: 0 aligned, 1/3 isotropic"});
    s.choose("switch", tension_only, {{"E", Switch::E}, {"I4", Switch::I4}, {"none", Switch::none}},
             {.doc = "what turns fibres off: strain E <= 0, stretch I4 <= 1 (its share of E), or nothing"});
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    T E = kappa * x.e1();
    if (tension_only != Switch::I4 || x.e4() > 0.0) E += (1 - 3 * kappa) * x.e4();
    if (tension_only == Switch::E && E <= 0.0) return 0.0;
    return 0.5 * k1 / k2 * expm1(k2 * E * E);
  }
};
TITIN_LAW(Goh)

}  // namespace titin
