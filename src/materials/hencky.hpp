/// Hencky, distortional: W = mu sum_a (ln l_a)^2 [J/m^3], l_a = J^-1/3 lambda_a. Hencky (1928), Z. Tech. Phys. 9, 215.
/// Its Kirchhoff stress 2 mu ln l_a is linear in the logarithmic strain, which makes relaxation by a Maxwell branch
/// exact. Rank-one convex for moderate stretches only (0.22 to 1.39 for the undivided energy): Bruhns, Xiao & Meyers
/// (2001), Proc. R. Soc. A 457, 2207.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Hencky {
  static constexpr auto name = "hencky";
  static constexpr auto formula = "W = mu ((ln l1)^2 + (ln l2)^2 + (ln l3)^2), l_a = J^-1/3 lambda_a";
  static constexpr auto source = "Hencky 1928, Z. Tech. Phys. 9:215";
  inline static const std::array published{
      ParameterSet{"rock of the Blake problem (small strains), E = 62.5 GPa, nu = 0.25", R"(mu = "25 GPa")",
                   "Kamm & Ankeny 2009, LA-UR-09-01255"}};

  double mu = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus"});
  }
  std::vector<StretchPower> powers() const { return {{mu, 0}}; }
};
TITIN_LAW(Hencky)

}  // namespace titin
