/// Mooney-Rivlin: W = c1 (I1 - 3) + c2 (I2 - 3) [J/m^3] of Cbar. Mooney (1940), J. Appl. Phys. 11, 582; Rivlin (1948).
/// Shear modulus at rest 2 (c1 + c2). The term in I2 of Cbar alone is not polyconvex.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct MooneyRivlin {
  static constexpr auto name = "mooney_rivlin";
  static constexpr auto formula = "W = c1 (I1 - 3) + c2 (I2 - 3)";
  static constexpr auto source = "Mooney 1940, J. Appl. Phys. 11:582; Rivlin 1948, Phil. Trans. A 241:379";
  inline static const std::array published{
      ParameterSet{"human brain, cortex", R"(c1 = "1.07 Pa", c2 = "940.9 Pa")",
                   "Peirlinck, Linka, Hurtado & Kuhl 2024, Comput. Methods Appl. Mech. Eng. 418:116534, table 1 "
                   "(tension, compression and shear; products of its weights)"},
      ParameterSet{"human medial collateral ligament, ground substance", R"(c1 = "1.44 MPa", c2 = "0 Pa")",
                   "Gardiner & Weiss 2003, J. Orthop. Res. 21:1098"}};
  static constexpr std::array uses{Invariant::I1, Invariant::I2};

  double c1 = 0, c2 = 0;

  void bind(Section& s) {
    s.read("c1", c1, {.unit = "Pa", .required = true, .doc = "factor of I1 - 3"});
    s.read("c2", c2, {.unit = "Pa", .required = true, .doc = "factor of I2 - 3"});
    if (!s.describing() && !(c1 + c2 > 0))
      s.error("c1", "the shear modulus 2 (c1 + c2) is not positive", "raise c1 or c2");
  }
  std::vector<Advice> advice() const {
    if (c1 >= 0 && c2 >= 0) return {};
    return {{c1 < 0 ? "c1" : "c2",
             "a negative coefficient stores less energy the larger the strain: no stable state there"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    return c1 * x.e1() + c2 * x.e2();
  }
};
TITIN_LAW(MooneyRivlin)

}  // namespace titin
