/// Neo-Hookean, distortional part: W = mu/2 (I1 - 3) [J/m^3], I1 = tr Cbar. Treloar (1943), Trans. Faraday Soc. 39, 36.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct NeoHookean {
  static constexpr auto name = "neo_hookean";
  static constexpr auto formula = "W = mu/2 (I1 - 3)";
  static constexpr auto source = "Treloar 1943, Trans. Faraday Soc. 39:36";
  static constexpr std::array uses{Invariant::I1};
  inline static const std::array published{
      ParameterSet{"porcine subdermal fat", R"(mu = "0.53 kPa")", "Sims et al. 2010 (MRI and inverse finite elements)"},
      ParameterSet{"intramuscular fat", R"(mu = "260 kPa")", "Flexodeal 1.1.1, default 2 c_f with c_f = 1.3e5 Pa"}};

  double mu = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus"});
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    return 0.5 * mu * x.e1();
  }
};
TITIN_LAW(NeoHookean)

}  // namespace titin
