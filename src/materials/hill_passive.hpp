/// Passive fibre of Hill-type muscle: Kirchhoff stress sigma = peak_stress f_p(stretch) [Pa];
/// materials/hill_curves.hpp. Stored energy W = peak_stress times the integral of f_p(x) / x from 1 to the stretch
/// [J/m^3]; where the curve gives nominal stress, of f_p itself.
#pragma once

#include "materials/hill_curves.hpp"
#include "materials/registry.hpp"

namespace titin {

struct HillPassive {
  static constexpr auto name = "hill_passive";
  static constexpr auto formula = "sigma = peak_stress f_p(stretch), W_4 = sigma / (2 I4)";
  static constexpr auto source = "curves of Flexodeal 1.1.1, or De Groote et al. 2016, Ann. Biomed. Eng. 44:2922";
  static constexpr bool uses_rate = false;
  inline static const std::array published{
      ParameterSet{"skeletal muscle", R"(peak_stress = "200 kPa")", "Flexodeal Lite 1.5.4, parameters.prm"}};

  double peak_stress = 0;
  HillCurve curve = HillCurve::flexodeal;
  HillStress stress = HillStress::kirchhoff;

  void bind(Section& s) {
    s.read("peak_stress", peak_stress,
           {.unit = "Pa", .range = positive, .required = true, .doc = "largest isometric stress of the active fibre"});
    s.choose("curve", curve, {{"flexodeal", HillCurve::flexodeal}, {"degroote", HillCurve::degroote}},
             {.doc = "passive force-length curve"});
    s.choose("stress", stress, {{"kirchhoff", HillStress::kirchhoff}, {"nominal", HillStress::nominal}},
             {.doc = "what the curve gives: Kirchhoff stress, or force per undeformed area (less by the stretch)"});
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double /*time*/) const {
    const T sigma = peak_stress * hill::passive_force(curve, stretch);
    return stress == HillStress::nominal ? stretch * sigma : sigma;
  }
  double energy(double stretch) const {
    return peak_stress * (stress == HillStress::nominal ? hill::passive_nominal_energy(curve, stretch)
                                                        : hill::passive_energy(curve, stretch));
  }
};
TITIN_LAW(HillPassive)

}  // namespace titin
