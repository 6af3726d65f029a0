/// Passive and active fibres of muscle after Blemker: Kirchhoff stress sigma = peak_stress x f(x) [Pa], x = stretch /
/// optimal_stretch. Blemker, Pinsky & Delp (2005), J. Biomech. 38, 657. No dependence on the rate.
///
/// Passive: f = p1 (exp(p2 (x - 1)) - 1) above 1, straight on from x = lambda_straight / optimal_stretch.
/// Active: f = 9 (x - 0.4)^2 on [0.4, 0.6], 1 - 4 (1 - x)^2 on [0.6, 1.4], 9 (x - 1.6)^2 on [1.4, 1.6], else 0, times
/// the activation. At optimal_stretch 1.4 fibres rest on the ascending limb, at x = 0.714.
#pragma once

#include <algorithm>

#include "materials/registry.hpp"
#include "math/piecewise.hpp"

namespace titin {

struct BlemkerPassive {
  static constexpr auto name = "blemker_passive";
  static constexpr auto formula = "sigma = peak_stress x p1 (exp(p2 (x - 1)) - 1), x = stretch/optimal_stretch";
  static constexpr auto source = "Blemker, Pinsky & Delp 2005, J. Biomech. 38:657";
  static constexpr bool uses_rate = false;
  inline static const std::array published{
      ParameterSet{"skeletal muscle",
                   R"(peak_stress = "300 kPa", optimal_stretch = 1.4, p1 = 0.05, p2 = 6.6, lambda_straight = 1.4)",
                   "FEBio test deck mu02, after Blemker et al. 2005"}};

  double peak_stress = 0, optimal_stretch = 1, p1 = 0, p2 = 0, lambda_straight = 0;

  void bind(Section& s) {
    s.read("peak_stress", peak_stress,
           {.unit = "Pa", .range = positive, .required = true, .doc = "largest isometric stress of the active fibre"});
    s.read("optimal_stretch", optimal_stretch,
           {.range = positive, .required = true, .doc = "stretch at which the active fibre is strongest"});
    s.read("p1", p1, {.range = positive, .required = true, .doc = "scale of the passive force"});
    s.read("p2", p2, {.range = positive, .required = true, .doc = "how fast it stiffens"});
    s.read("lambda_straight", lambda_straight,
           {.range = positive, .required = true, .doc = "stretch from which fibres are straight"});
    if (!s.describing() && lambda_straight < optimal_stretch)
      s.error("lambda_straight", "lies below optimal_stretch, where fibres are slack",
              "raise it to optimal_stretch or more");
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double /*time*/) const {
    using std::expm1;
    const T x = stretch / optimal_stretch;
    const double straight = lambda_straight / optimal_stretch;
    if (x <= 1.0) return 0.0;
    if (x < straight) return peak_stress * x * (p1 * expm1(p2 * (x - 1.0)));
    return peak_stress * x * (force(straight) + slope(straight) * (x - straight));
  }
  double energy(double stretch) const {
    const double x = stretch / optimal_stretch, straight = lambda_straight / optimal_stretch;
    if (x <= 1) return 0;
    const double crimped = std::min(x, straight), beyond = x - crimped;
    const double curved = p1 * (std::expm1(p2 * (crimped - 1)) / p2 - (crimped - 1));
    return peak_stress * (curved + beyond * (force(straight) + 0.5 * slope(straight) * beyond));
  }

 private:
  double force(double x) const { return p1 * std::expm1(p2 * (x - 1)); }
  double slope(double x) const { return p1 * p2 * std::exp(p2 * (x - 1)); }
};
TITIN_LAW(BlemkerPassive)

struct BlemkerActive {
  static constexpr auto name = "blemker_active";
  static constexpr auto formula = "sigma = peak_stress activation(t) x f(x), x = stretch/optimal_stretch";
  static constexpr auto source = "Blemker, Pinsky & Delp 2005, J. Biomech. 38:657";
  static constexpr bool uses_rate = false;
  static constexpr auto pulls_at_rest = "an active fibre pulls at any length";
  inline static const std::array published{
      ParameterSet{"skeletal muscle", R"(peak_stress = "300 kPa", optimal_stretch = 1.4, activation = 1)",
                   "FEBio test deck mu02, after Blemker et al. 2005"}};
  static constexpr Piecewise<3, 2> curve{.breaks = {0.4, 0.6, 1.4, 1.6},
                                         .coefficients = {{{0, 0, 9}, {0.36, 3.2, -4}, {0.36, -3.6, 9}}}};

  double peak_stress = 0, optimal_stretch = 1;
  Table activation;

  void bind(Section& s) {
    s.read("peak_stress", peak_stress,
           {.unit = "Pa", .range = positive, .required = true, .doc = "largest isometric stress of the active fibre"});
    s.read("optimal_stretch", optimal_stretch,
           {.range = positive, .required = true, .doc = "stretch at which the active fibre is strongest"});
    s.read("activation", activation,
           {.range = fraction, .required = true, .doc = "active part of the muscle against time"});
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double time) const {
    const T x = stretch / optimal_stretch;
    return peak_stress * activation(time) * x * curve(x);
  }
  double potential(double stretch, double time) const {
    return peak_stress * activation(time) * curve.integral(curve.breaks.front(), stretch / optimal_stretch);
  }
};
TITIN_LAW(BlemkerActive)

}  // namespace titin
