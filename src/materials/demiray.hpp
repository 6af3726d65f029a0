/// Demiray: W = a/(2 b) (exp(b (I1 - 3)) - 1) [J/m^3], an isotropic tissue that stiffens. Demiray (1972), J. Biomech.
/// 5, 309. Shear modulus at rest a.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Demiray {
  static constexpr auto name = "demiray";
  static constexpr auto formula = "W = a/(2 b) (exp(b (I1 - 3)) - 1)";
  static constexpr auto source = "Demiray 1972, J. Biomech. 5:309";
  static constexpr std::array uses{Invariant::I1};
  inline static const std::array published{
      ParameterSet{"human brain, cortex", R"(a = "1844.7 Pa", b = 1.0529)",
                   "Peirlinck, Linka, Hurtado & Kuhl 2024, Comput. Methods Appl. Mech. Eng. 418:116534, table 1; from "
                   "its w2 (exp(w1 (I1 - 3)) - 1), a = 2 w1 w2, b = w1"}};

  double a = 0, b = 0;

  void bind(Section& s) {
    s.read("a", a, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus at rest"});
    s.read("b", b, {.range = positive, .required = true, .doc = "how fast it stiffens"});
  }
  std::vector<Advice> advice() const {
    constexpr double largest = 709;                            // ln of the largest double
    constexpr double at_half_again = 1.5 * 1.5 + 2 / 1.5 - 3;  // I1 - 3 at a stretch of 1.5
    if (b * at_half_again <= largest) return {};
    return {{"b", "its exponential overflows before a stretch of 1.5: steps that go there fail"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    return 0.5 * a / b * expm1(b * x.e1());
  }
};
TITIN_LAW(Demiray)

}  // namespace titin
