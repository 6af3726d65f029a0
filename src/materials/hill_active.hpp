/// Hill-type active fibre: Kirchhoff stress sigma = peak_stress activation(t) f_l(stretch) f_v(rate / max_strain_rate)
/// [Pa]. Hill (1938), Proc. R. Soc. B 126, 136; curves: materials/hill_curves.hpp. Does work, stores no energy.
#pragma once

#include "materials/activation.hpp"
#include "materials/hill_curves.hpp"
#include "materials/registry.hpp"

namespace titin {

struct HillActive {
  static constexpr auto name = "hill_active";
  static constexpr auto formula =
      "sigma = peak_stress activation(t) f_l(stretch) f_v(rate / max_strain_rate), W_4 = sigma / (2 I4)";
  static constexpr auto source =
      "Hill 1938, Proc. R. Soc. B 126:136; curves of Flexodeal 1.1.1 or De Groote et al. 2016";
  static constexpr bool uses_rate = true;
  static constexpr auto pulls_at_rest = "an active fibre pulls at any length";
  inline static const std::array published{
      ParameterSet{"skeletal muscle", R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 1)",
                   "Flexodeal Lite 1.5.4, parameters.prm"}};

  double peak_stress = 0, max_strain_rate = 0;
  Activation activation;
  HillCurve curve = HillCurve::flexodeal;
  HillStress stress = HillStress::kirchhoff;

  void bind(Section& s) {
    s.read("peak_stress", peak_stress,
           {.unit = "Pa", .range = positive, .required = true, .doc = "largest isometric stress of the active fibre"});
    s.read("max_strain_rate", max_strain_rate,
           {.unit = "1/s",
            .range = positive,
            .required = true,
            .doc = "rate of stretch at which a shortening fibre is unloaded"});
    activation.bind(s);
    s.choose("curve", curve,
             {{"flexodeal", HillCurve::flexodeal},
              {"flexodeal_smooth", HillCurve::flexodeal_smooth},
              {"degroote", HillCurve::degroote}},
             {.doc = "force-length and force-velocity curves"});
    s.choose("stress", stress, {{"kirchhoff", HillStress::kirchhoff}, {"nominal", HillStress::nominal}},
             {.doc = "what the curve gives: Kirchhoff stress, or force per undeformed area (less by the stretch)"});
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& rate, double time) const {
    const double active = peak_stress * activation(time);
    if (active == 0) return 0.0;
    const T sigma = active * hill::active_force(curve, stretch) * hill::force_velocity(curve, rate / max_strain_rate);
    return stress == HillStress::nominal ? stretch * sigma : sigma;
  }
};
TITIN_LAW(HillActive)

}  // namespace titin
