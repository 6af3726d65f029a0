/// Fibres of linear stiffness that go slack in compression: W = stiffness/2 <lambda - 1>^2 [J/m^3], lambda = sqrt(I4).
/// The cheapest tendon; with a neo-Hookean matrix the simplest transversely isotropic solid.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct LinearFibre {
  static constexpr auto name = "linear_fibre";
  static constexpr auto formula = "W = stiffness/2 <lambda - 1>^2, lambda = sqrt(I4)";
  static constexpr auto source = "common; e.g. Bonet & Burton 1998, Comput. Methods Appl. Mech. Eng. 162:151";
  inline static const std::array published{
      ParameterSet{"human medial collateral ligament, straight fibres", R"(stiffness = "332.2 MPa")",
                   "Quapp & Weiss 1998, J. Biomech. Eng. 120:757 (tangent modulus along the fibres)"}};
  static constexpr bool uses_rate = false;

  double stiffness = 0;

  void bind(Section& s) {
    s.read("stiffness", stiffness, {.unit = "Pa", .range = positive, .required = true, .doc = "modulus of the fibres"});
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double /*time*/) const {
    if (stretch <= 1.0) return 0.0;
    return stiffness * stretch * (stretch - 1.0);
  }
  double energy(double stretch) const {
    const double strain = std::max(0.0, stretch - 1);
    return 0.5 * stiffness * strain * strain;
  }
};
TITIN_LAW(LinearFibre)

}  // namespace titin
