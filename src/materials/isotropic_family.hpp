/// A family of rank-one convex isotropic solids between two invariants, of one shear modulus and a shape a in [-1,
/// 1/2]: W = mu/4 [ -2 a (I1 - 3) + (1 + a)/3 (I2^2 - 9) ] [J/m^3]; a = -1 is neo-Hookean. The
/// solids of Boscheri, Loubere and Maire's ADER-MOOD scheme; I2 = (I1^2 - tr Cbar^2) / 2, both of Cbar.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct IsotropicFamily {
  static constexpr auto name = "isotropic_family";
  static constexpr auto formula = "W = mu/4 [-2 a (I1 - 3) + (1 + a)/3 (I2^2 - 9)]";
  static constexpr auto source =
      "the family of Boscheri, Loubere & Maire in their ADER-MOOD scheme for hyperelastic solids";
  inline static const std::array published{ParameterSet{"rubber of the twisting column, E = 17 MPa, nu = 0.45",
                                                        R"(mu = "5.862069 MPa", a = -1)",
                                                        "Boscheri, Loubere & Maire 2022, J. Comput. Phys. 449:110779"}};
  static constexpr std::array uses{Invariant::I1, Invariant::I2};

  double mu = 0, a = -1;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus at rest, for every a"});
    s.read("a", a, {.range = {.min = -1, .max = 0.5}, .doc = "-1: neo-Hookean; 0: in I2 alone"});
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    return 0.25 * mu * ((1 + a) / 3 * x.e2() * (x.e2() + 6.0) - 2 * a * x.e1());
  }
};
TITIN_LAW(IsotropicFamily)

}  // namespace titin
