/// Constitutive artificial neural networks: twelve terms of which training keeps a few. For x = I1 - 3 and I2 - 3
///
///   W = sum_x w1 x + w2 (exp(b1 x) - 1) + w3 x^2 + w4 (exp(b2 x^2) - 1) - w5 ln(1 - b3 x) - w6 ln(1 - b4 x^2) [J/m^3]
///
/// and along a fibre W = w1 <I4 - 1>^2 + w2 (exp(b <I4 - 1>^2) - 1). Linka & Kuhl (2023), Comput. Methods Appl. Mech.
/// Eng. 403, 115731. Non-negative weights make W grow with its invariants: no stress at rest, none that softens in
/// them. Terms in I2 are not polyconvex, those in I1 and <I4 - 1> are.
#pragma once

#include "materials/overflow.hpp"
#include "materials/registry.hpp"
#include "materials/weights.hpp"

namespace titin {

struct Cann {
  static constexpr auto name = "cann";
  static constexpr auto formula =
      "W = sum over x = I1 - 3, I2 - 3 of w1 x + w2 (exp(b1 x) - 1) + w3 x^2 + w4 (exp(b2 x^2) - 1) - w5 ln(1 - b3 x) "
      "- "
      "w6 ln(1 - b4 x^2)";
  static constexpr auto source = "Linka & Kuhl 2023, Comput. Methods Appl. Mech. Eng. 403:115731";
  static constexpr std::array uses{Invariant::I1, Invariant::I2};
  inline static const std::array published{
      ParameterSet{
          "human brain, corona radiata",
          R"(moduli_2 = "221.515, 490, 0, 1685.9 Pa", exponents_2 = [0.2398, 1.8893], log_moduli_2 = "0, 1911.3 Pa", log_factors_2 = [0, 1.1789])",
          "Peirlinck, Linka, Hurtado & Kuhl 2024, Comput. Methods Appl. Mech. Eng. 418:116534, table 2 (tension, "
          "compression and shear; w1 here is the product of both weights there)"},
      ParameterSet{
          "human brain, cortex",
          R"(moduli_2 = "0, 0, 3800.66, 1888 Pa", exponents_2 = [0, 1.6495], log_moduli_2 = "633.9, 1666.3 Pa", log_factors_2 = [0.9875, 1.4026])",
          "the same, table 2"}};

  struct Weight {
    std::vector<double> moduli{0, 0, 0, 0}, exponents{0, 0}, log_moduli{0, 0}, log_factors{0, 0};
  };
  Weight of_1, of_2;

  void bind(Section& s) {
    Weights w(s);
    const char* moduli = "weights w1, w2, w3, w4 of the terms of this invariant";
    const char* exponents = "b1, b2: weights inside of the exponentials of this invariant";
    w.read("moduli_1", of_1.moduli, {.unit = "Pa", .range = non_negative, .doc = moduli, .size = 4});
    w.read("exponents_1", of_1.exponents, {.range = non_negative, .doc = exponents, .size = 2});
    read_logarithms(w, "log_moduli_1", "log_factors_1", of_1);
    w.read("moduli_2", of_2.moduli, {.unit = "Pa", .range = non_negative, .doc = moduli, .size = 4});
    w.read("exponents_2", of_2.exponents, {.range = non_negative, .doc = exponents, .size = 2});
    read_logarithms(w, "log_moduli_2", "log_factors_2", of_2);
    if (s.describing()) return;
    const auto stiffness = [](const Weight& v) {
      return v.moduli[0] + v.moduli[1] * v.exponents[0] + v.log_moduli[0] * v.log_factors[0];
    };
    if (!(stiffness(of_1) + stiffness(of_2) > 0))
      s.error("", "no shear modulus at rest: w1, w2 b1 and w5 b3 are 0 in both invariants",
              "give one of them, in moduli_1 or moduli_2");
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    return energy(of_1, x.e1()) + energy(of_2, x.e2());
  }

 private:
  template <class T>
  static T energy(const Weight& v, const T& x) {
    using std::expm1;
    const auto &w = v.moduli, &b = v.exponents;
    const T square = x * x;
    T W = w[0] * x + w[1] * expm1(b[0] * x) + w[2] * square + w[3] * expm1(b[1] * square);
    if (v.log_moduli[0] > 0) W -= v.log_moduli[0] * locking(T(v.log_factors[0] * x));
    if (v.log_moduli[1] > 0) W -= v.log_moduli[1] * locking(T(v.log_factors[1] * square));
    return W;
  }
  /// ln(1 - x); not a number from x = 1 on, where chains are straight.
  template <class T>
  static T locking(const T& x) {
    using std::log1p;
    return log1p(-x);
  }
  static void read_logarithms(Weights& w, const char* moduli, const char* factors, Weight& v) {
    w.read(
        moduli, v.log_moduli,
        {.unit = "Pa", .range = non_negative, .doc = "weights w5, w6 of the logarithms of this invariant", .size = 2});
    w.read(factors, v.log_factors,
           {.range = non_negative, .doc = "b3, b4: weights inside of the logarithms of this invariant", .size = 2});
  }
};
TITIN_LAW(Cann)

struct CannFibre {
  static constexpr auto name = "cann_fibre";
  static constexpr auto formula = "W = w1 <I4 - 1>^2 + w2 (exp(b <I4 - 1>^2) - 1)";
  static constexpr auto source = Cann::source;
  static constexpr std::array uses{Invariant::I4};
  inline static const std::array published{ParameterSet{
      "rabbit carotid artery, media; beside neo_hookean mu = 3 kPa", R"(w1 = "0 Pa", w2 = "1407.84 Pa", b = 0.8393)",
      "Holzapfel, Gasser & Ogden 2000, J. Elast. 61:1, table 2 (w2 is k1/(2 k2) there)"}};

  double w1 = 0, w2 = 0, b = 0;

  void bind(Section& s) {
    s.read("w1", w1, {.unit = "Pa", .range = non_negative, .required = true, .doc = "weight of the square"});
    s.read("w2", w2, {.unit = "Pa", .range = non_negative, .required = true, .doc = "weight of the exponential"});
    s.read("b", b, {.range = non_negative, .required = true, .doc = "weight inside of the exponential"});
  }
  std::vector<Advice> advice() const { return advice_of_exponent("b", b, strain_of_tissue); }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    if (x.e4() <= 0.0) return 0.0;
    const T square = x.e4() * x.e4();
    return w1 * square + w2 * expm1(b * square);
  }
};
TITIN_LAW(CannFibre)

}  // namespace titin
