/// Input-convex neural network of one layer of neurons in polyconvex invariants:
///
///   W = sum_j amplitude_j [softplus(z_j) - softplus(bias_j)] [J/m^3],   softplus(z) = ln(1 + e^z),
///   z_j = bias_j + weight_1j (I1 - 3) + weight_2j (I2^(3/2) - 3^(3/2)).
///
/// Amos, Xu & Kolter (2017), Proc. Mach. Learn. Res. 70, 146; in elasticity Klein et al. (2022), J. Mech. Phys. Solids
/// 159, 104703. Non-negative amplitudes and weights keep W convex and rising in both, hence polyconvex. It grows
/// linearly far out: where it was not trained it is soft, but stable.
#pragma once

#include <fmt/format.h>

#include "materials/registry.hpp"
#include "materials/weights.hpp"

namespace titin {

struct Icnn {
  static constexpr auto name = "icnn";
  static constexpr auto formula =
      "W = sum_j amplitude_j [softplus(bias_j + weight_1j (I1 - 3) + weight_2j (I2^(3/2) - 3^(3/2))) - "
      "softplus(bias_j)]";
  static constexpr auto source =
      "Amos, Xu & Kolter 2017, Proc. Mach. Learn. Res. 70:146; Klein et al. 2022, J. Mech. Phys. Solids 159:104703";
  static constexpr auto unpublished =
      "Weights come from a training of one's own: papers print curves, not weights, and none could be traced.";
  static constexpr std::array uses{Invariant::I1, Invariant::I2};

  std::vector<double> amplitude, weight_1, weight_2, bias;

  void bind(Section& s) {
    Weights w(s);
    w.read(
        "amplitude", amplitude,
        {.unit = "Pa", .range = non_negative, .required = true, .doc = "of each neuron; negative ones lose convexity"});
    w.read("weight_1", weight_1,
           {.range = non_negative, .required = true, .doc = "of I1 - 3 in each neuron; negative ones lose monotony"});
    w.read("weight_2", weight_2,
           {.range = non_negative, .required = true, .doc = "of I2^(3/2) - 3^(3/2) in each neuron"});
    w.read("bias", bias, {.required = true, .doc = "of each neuron"});
    const std::size_t n = amplitude.size();
    if (!s.describing() && (weight_1.size() != n || weight_2.size() != n || bias.size() != n)) {
      s.error("",
              fmt::format("{} amplitudes, {} weight_1, {} weight_2 and {} biases", n, weight_1.size(), weight_2.size(),
                          bias.size()),
              "give one of each for every neuron");
      amplitude.clear();
    }
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1, std::log1p;
    static const double at_rest = std::sqrt(27.0);
    const T x2 = at_rest * expm1(1.5 * log1p(x.e2() / 3.0));  // I2^(3/2) - 3^(3/2) with the digits of small strains
    T W = 0.0;
    for (std::size_t j = 0; j < amplitude.size(); ++j)
      W += amplitude[j] * softplus_above(bias[j], weight_1[j] * x.e1() + weight_2[j] * x2);
    return W;
  }

 private:
  /// softplus(b + d) - softplus(b) for d >= 0, without the subtraction where d is small.
  template <class T>
  static T softplus_above(double b, const T& d) {
    using std::expm1, std::log1p;
    const double slope = 1 / (1 + std::exp(-b));  // of softplus at b
    if (d < 1.0) return log1p(slope * expm1(d));
    return d + log1p((1 - slope) * expm1(-d));
  }
};
TITIN_LAW(Icnn)

}  // namespace titin
