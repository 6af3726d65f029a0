/// Collagen fibres of ligament and tendon after Weiss: Kirchhoff stress sigma = lambda dW/dlambda [Pa] with
///   0 below stretch 1,  c3 (exp(c4 (lambda - 1)) - 1) while they uncrimp,  c5 lambda + c6 from lambda_straight on,
/// c6 such that sigma is continuous; without c5 its slope is, too, which are the fibres of Blemker's tendon. Weiss,
/// Maker & Govindjee (1996), Comput. Methods Appl. Mech. Eng. 135, 107. The matrix is a term of its own (mooney_rivlin
/// or neo_hookean).
#pragma once

#include "materials/registry.hpp"
#include "math/quadrature.hpp"

namespace titin {

struct WeissFibre {
  static constexpr auto name = "weiss_fibre";
  static constexpr auto formula =
      "lambda dW/dlambda = 0 (lambda < 1), c3 (exp(c4 (lambda - 1)) - 1), c5 lambda + c6 (lambda > lambda_straight)";
  static constexpr auto source = "Weiss, Maker & Govindjee 1996, Comput. Methods Appl. Mech. Eng. 135:107";
  inline static const std::array published{
      ParameterSet{"human medial collateral ligament; beside mooney_rivlin c1 = 1.44 MPa, c2 = 0",
                   R"(c3 = "0.57 MPa", c4 = 48, c5 = "467.1 MPa", lambda_straight = 1.062)",
                   "Gardiner & Weiss 2003, J. Orthop. Res. 21:1098"},
      ParameterSet{"tendon; beside blemker_shear g1 = g2 = 50 kPa",
                   R"(c3 = "2.7 MPa", c4 = 46.4, lambda_straight = 1.03)",
                   "Blemker, Pinsky & Delp 2005, J. Biomech. 38:657"}};
  static constexpr bool uses_rate = false;
  double c3 = 0, c4 = 0, c5 = 0, lambda_straight = 0;

  void bind(Section& s) {
    s.read("c3", c3, {.unit = "Pa", .range = positive, .required = true, .doc = "stress scale while fibres uncrimp"});
    s.read("c4", c4, {.range = positive, .required = true, .doc = "how fast they uncrimp"});
    s.read("c5", c5,
           {.unit = "Pa",
            .range = non_negative,
            .doc = "modulus of straight fibres; 0: that which they have when they become straight"});
    s.read("lambda_straight", lambda_straight,
           {.range = {.min = 1, .open_min = true}, .required = true, .doc = "stretch from which fibres are straight"});
  }
  std::vector<Advice> advice() const {
    const double end = c3 * c4 * std::exp(c4 * (lambda_straight - 1));
    if (c5 == 0 || (c5 > 0.5 * end && c5 < 2 * end)) return {};
    return {
        {"c5", fmt::format("straight fibres of {:.3g} Pa begin where uncrimping ones have {:.3g} Pa: the tangent jumps "
                           "there; 0 takes the latter",
                           c5, end)}};
  }
  template <class T>
  T fibre_stress(const T& stretch, const T& /*rate*/, double /*time*/) const {
    using std::expm1;
    if (stretch <= 1.0) return 0.0;
    if (stretch < lambda_straight) return c3 * expm1(c4 * (stretch - 1.0));
    return modulus() * stretch + offset();
  }
  double energy(double stretch) const {
    if (stretch <= 1) return 0;
    const double crimped = std::min(stretch, lambda_straight);
    const auto uncrimping = [&](double strain) { return std::expm1(c4 * strain) / (1 + strain); };
    const int panels = 1 + static_cast<int>(c4 * (crimped - 1));  // one for each power of e: round-off
    const double curved = c3 * integrate(uncrimping, 0, crimped - 1, panels);
    const double straight = modulus() * (stretch - crimped) + offset() * std::log(stretch / crimped);
    return curved + straight;
  }

 private:
  double modulus() const { return c5 > 0 ? c5 : c3 * c4 * std::exp(c4 * (lambda_straight - 1)); }
  double offset() const { return c3 * std::expm1(c4 * (lambda_straight - 1)) - modulus() * lambda_straight; }
};
TITIN_LAW(WeissFibre)

}  // namespace titin
