/// Collagen fibres of tendon and aponeurosis by the Flexodeal table: Kirchhoff stress sigma = stress_scale t(stretch)
/// [Pa].
///
/// t is 0.01 stretch below 1, quadratics up to 1.15 and straight on from there. At rest t = 0.01: a tendon of 200 kPa
/// scale pulls 2 kPa where it should be slack, as published; `stress_free_rest` takes that 0.01 away and lets shortened
/// fibres go slack. Stored energy: stress_scale times the integral of t(x) / x from 1 [J/m^3].
#pragma once

#include "materials/registry.hpp"
#include "math/piecewise.hpp"

namespace titin {

struct CollagenTable {
  static constexpr auto name = "collagen_table";
  static constexpr auto formula = "sigma = stress_scale t(stretch), W_4 = sigma / (2 I4)";
  static constexpr auto source = "Flexodeal 1.1.1 (tendon and aponeurosis share the table)";
  static constexpr bool uses_rate = false;
  static constexpr auto pulls_at_rest = "the published table is 0.01 at stretch 1 (see stress_free_rest)";
  inline static const std::array published{
      ParameterSet{"tendon, aponeurosis", R"(stress_scale = "200 kPa")", "Flexodeal 1.1.1, parameters.prm"}};
  static constexpr double rest = 0.01;
  static constexpr Piecewise<4, 2> table{
      .breaks = {0, 1, 1.01, 1.02, 1.15},
      .coefficients = {{{0, rest, 0},
                        {rest, 0.01, 515.8820342030662},
                        {0.06168820342030671, 10.327640684061333, 600.5902422602494},
                        {0.22502363448694518, 22.33944552926633, -9.97532175746044}}},
      .above = Continuation::linear};

  double stress_scale = 0;
  bool stress_free_rest = false;

  void bind(Section& s) {
    s.read("stress_scale", stress_scale,
           {.unit = "Pa", .range = positive, .required = true, .doc = "stress that the table is a multiple of"});
    s.read("stress_free_rest", stress_free_rest, {.doc = "take away the table's 0.01 at rest"});
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double /*time*/) const {
    if (!stress_free_rest) return stress_scale * table(stretch);
    if (stretch < 1.0) return 0.0;
    return stress_scale * (table(stretch) - rest);
  }
  double energy(double stretch) const {
    if (!stress_free_rest) return stress_scale * table.integral_over_x(1, stretch);
    if (stretch < 1) return 0;
    return stress_scale * (table.integral_over_x(1, stretch) - rest * std::log(stretch));
  }
};
TITIN_LAW(CollagenTable)

}  // namespace titin
