/// Gasser-Ogden-Holzapfel fibres with dispersion, one family: W = k1/(2 k2) (exp(k2 E^2) - 1) [J/m^3],
/// E = kappa (I1 - 3) + (1 - 3 kappa)(I4 - 1). Gasser, Ogden & Holzapfel (2006), J. R. Soc. Interface 3, 15.
///
/// kappa = 0 are aligned fibres (Holzapfel, Gasser & Ogden 2000), kappa = 1/3 isotropic ones. A wall with two families
/// has two such terms, the other with family = "second", and a neo-Hookean matrix (mu = 2 C10). Where fibres would
/// push: `E` switches them off for E <= 0, with a continuous stress; `I4` drops I4 - 1 <= 0 from E, which makes the
/// stress jump unless kappa = 0; `none` lets them push. The tangent of `E` jumps by k1 at E = 0; a `switch_width` w
/// rounds that off, <E> = (E + sqrt(E^2 + w^2))/2 for E, at the price of a stress of the order k1 w/4 at rest.
#pragma once

#include "materials/overflow.hpp"
#include "materials/registry.hpp"

namespace titin {

struct Goh {
  static constexpr auto name = "goh";
  static constexpr auto formula = "W = k1/(2 k2) (exp(k2 E^2) - 1), E = kappa (I1 - 3) + (1 - 3 kappa)(I4 - 1)";
  static constexpr auto source = "Gasser, Ogden & Holzapfel 2006, J. R. Soc. Interface 3:15";
  static constexpr std::array uses{Invariant::I1, Invariant::I4};
  enum class Switch { E, I4, none };
  inline static const std::array published{
      ParameterSet{"human iliac artery, adventitia; beside neo_hookean mu = 7.64 kPa, families at 49.98 degrees",
                   R"(k1 = "996.6 kPa", k2 = 524.6, kappa = 0.226)",
                   "Gasser, Ogden & Holzapfel 2006, J. R. Soc. Interface 3:15, table 1"},
      ParameterSet{"rabbit carotid artery, media; beside neo_hookean mu = 3 kPa, families at 29 degrees",
                   R"(k1 = "2.3632 kPa", k2 = 0.8393)", "Holzapfel, Gasser & Ogden 2000, J. Elast. 61:1, table 2"}};

  double k1 = 0, k2 = 0, kappa = 0, switch_width = 0;
  Switch tension_only = Switch::E;

  void bind(Section& s) {
    s.read("k1", k1, {.unit = "Pa", .range = non_negative, .required = true, .doc = "stiffness of the fibres"});
    s.read("k2", k2, {.range = positive, .required = true, .doc = "how fast they stiffen"});
    s.read("kappa", kappa, {.range = {.min = 0, .max = 1.0 / 3}, .doc = "dispersion: 0 aligned, 1/3 isotropic"});
    s.choose("switch", tension_only, {{"E", Switch::E}, {"I4", Switch::I4}, {"none", Switch::none}},
             {.doc = "what turns fibres off: strain E <= 0, stretch I4 <= 1 (its share of E), or nothing"});
    s.read("switch_width", switch_width,
           {.range = non_negative, .doc = "strain over which the switch E is rounded off, say 1e-4; 0 is sharp"});
    if (switch_width > 0 && tension_only != Switch::E)
      s.error("switch_width", "only the switch E can be rounded off", "drop it, or take switch = \"E\"");
  }
  std::vector<Advice> advice() const {
    std::vector<Advice> list = advice_of_exponent("k2", k2, (1 - 3 * kappa) * strain_of_tissue);
    if (kappa > 0.333)
      list.push_back({"kappa", "1/3 makes the fibres isotropic: their direction has no effect; demiray does the same"});
    if (tension_only == Switch::I4 && kappa > 0)
      list.push_back({"switch", "with I4 and dispersion the stress jumps where fibres begin to pull; E does not"});
    if (tension_only == Switch::none) list.push_back({"switch", "with none, fibres push when they are compressed"});
    return list;
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    T E = kappa * x.e1();
    if (tension_only != Switch::I4 || x.e4() > 0.0) E += (1 - 3 * kappa) * x.e4();
    if (switch_width > 0)
      E = rounded(E);
    else if (tension_only == Switch::E && E <= 0.0)
      return 0.0;
    return 0.5 * k1 / k2 * expm1(k2 * E * E);
  }

 private:
  /// (E + sqrt(E^2 + w^2))/2, for E < 0 without the cancellation.
  template <class T>
  T rounded(const T& E) const {
    using std::sqrt;
    const double w2 = switch_width * switch_width;
    const T root = sqrt(E * E + w2);
    return E > 0.0 ? T(0.5 * (E + root)) : T(0.5 * w2 / (root - E));
  }
};
TITIN_LAW(Goh)

}  // namespace titin
