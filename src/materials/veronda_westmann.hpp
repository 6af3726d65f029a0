/// Veronda-Westmann: W = c1 (exp(c2 (I1 - 3)) - 1) - c1 c2/2 (I2 - 3) [J/m^3] of Cbar.
/// Veronda & Westmann (1970), J. Biomech. 3, 111. Shear modulus at rest c1 c2. The I2 term makes it lose polyconvexity.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct VerondaWestmann {
  static constexpr auto name = "veronda_westmann";
  static constexpr auto formula = "W = c1 (exp(c2 (I1 - 3)) - 1) - c1 c2/2 (I2 - 3)";
  static constexpr auto source = "Veronda & Westmann 1970, J. Biomech. 3:111";
  static constexpr auto unpublished =
      "No set in this normalisation could be traced to a table; those in use state c1 and c2 without their source.";
  static constexpr std::array uses{Invariant::I1, Invariant::I2};

  double c1 = 0, c2 = 0;

  void bind(Section& s) {
    s.read("c1", c1,
           {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness; c1 c2 is the shear modulus"});
    s.read("c2", c2, {.range = positive, .required = true, .doc = "how fast it stiffens"});
  }
  std::vector<Advice> advice() const {
    constexpr double least = 0.15;  // W stays positive at every equibiaxial stretch; at 0.1 it does not
    if (c2 >= least) return {};
    return {{"c2", "so small, the energy turns negative in large equibiaxial tension"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    return c1 * expm1(c2 * x.e1()) - 0.5 * c1 * c2 * x.e2();
  }
};
TITIN_LAW(VerondaWestmann)

}  // namespace titin
