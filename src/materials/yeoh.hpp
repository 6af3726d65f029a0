/// Yeoh: W = c1 (I1 - 3) + c2 (I1 - 3)^2 + c3 (I1 - 3)^3 [J/m^3], I1 = tr Cbar. Yeoh (1993), Rubber Chem. Technol. 66,
/// 754. Shear modulus at rest 2 c1. A negative c2 is sound only while dW/dI1 > 0, that is c2^2 < 3 c1 c3.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Yeoh {
  static constexpr auto name = "yeoh";
  static constexpr auto formula = "W = c1 (I1 - 3) + c2 (I1 - 3)^2 + c3 (I1 - 3)^3";
  static constexpr auto source = "Yeoh 1993, Rubber Chem. Technol. 66:754";
  static constexpr std::array uses{Invariant::I1};
  inline static const std::array published{
      ParameterSet{"human abdominal aortic aneurysm", R"(c1 = "174 kPa", c2 = "1881 kPa")",
                   "Raghavan & Vorp 2000, J. Biomech. 33:475 (17.4 and 188.1 N/cm^2)"},
      ParameterSet{"muscle, base material without fibres", R"(c1 = "39811.1915020669 Pa", c2 = "73246.6965293830 Pa")",
                   "Flexodeal Lite 1.5.4, parameters.prm (scale 2e5 Pa times 0.19906, 0.36623)"},
      ParameterSet{"tendon and aponeurosis, base material without fibres",
                   R"(c1 = "937925.2995 Pa", c2 = "-691028.2195 Pa", c3 = "96984110.79 Pa")",
                   "Flexodeal 1.1.1, parameters.prm (scale 2e5 Pa times 4.68963, -3.45514, 484.92)"}};

  double c1 = 0, c2 = 0, c3 = 0;

  void bind(Section& s) {
    s.read("c1", c1, {.unit = "Pa", .range = positive, .required = true, .doc = "half the shear modulus at rest"});
    s.read("c2", c2, {.unit = "Pa", .doc = "factor of (I1 - 3)^2"});
    s.read("c3", c3, {.unit = "Pa", .range = non_negative, .doc = "factor of (I1 - 3)^3"});
  }
  std::vector<Advice> advice() const {
    const double at = c3 > 0 ? -c2 / (3 * c3) : 0;  // I1 - 3 where the slope is smallest
    const bool falls = c2 < 0 && (c3 == 0 || c1 + c2 * at <= 0);
    if (!falls) return {};
    return {{"c2",
             "with a negative c2 and too little c3 the material softens at larger strains and finds no stable state"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    return ((c3 * x.e1() + c2) * x.e1() + c1) * x.e1();
  }
};
TITIN_LAW(Yeoh)

}  // namespace titin
