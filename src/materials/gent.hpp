/// Gent: W = -mu/2 Jm ln(1 - (I1 - 3)/Jm) [J/m^3], with chains of limited length: I1 stays below 3 + Jm.
/// Gent (1996), Rubber Chem. Technol. 69, 59. Beyond the limit there is no energy: stresses are NaN and a step is cut.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Gent {
  static constexpr auto name = "gent";
  static constexpr auto formula = "W = -mu/2 Jm ln(1 - (I1 - 3)/Jm)";
  static constexpr auto source = "Gent 1996, Rubber Chem. Technol. 69:59";
  inline static const std::array published{
      ParameterSet{"human brain, cortex", R"(mu = "1759.7 Pa", limit = 0.5435)",
                   "Peirlinck, Linka, Hurtado & Kuhl 2024, Comput. Methods Appl. Mech. Eng. 418:116534, table 1; from "
                   "its -w2 ln(1 - w1 (I1 - 3)), mu = 2 w1 w2, limit = 1/w1"}};
  static constexpr std::array uses{Invariant::I1};

  double mu = 0, limit = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus at rest"});
    s.read("limit", limit, {.range = positive, .required = true, .doc = "Jm, the largest I1 - 3"});
  }
  std::vector<Advice> advice() const {
    constexpr double little = 0.05;  // I1 - 3 at a stretch of 1.13
    if (limit >= little) return {};
    return {{"limit", "chains are straight before a stretch of 1.13: steps that go beyond fail"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::log1p;
    if (x.e1() >= limit) return std::numeric_limits<double>::quiet_NaN();
    return -0.5 * mu * limit * log1p(-1.0 * x.e1() / limit);
  }
};
TITIN_LAW(Gent)

}  // namespace titin
