/// Constitutive artificial neural networks: twelve terms of which training keeps a few. For x = I1 - 3 and I2 - 3
///
///   W = sum_x w1 x + w2 (exp(b1 x) - 1) + w3 x^2 + w4 (exp(b2 x^2) - 1) [J/m^3]
///
/// and along a fibre W = w1 <I4 - 1>^2 + w2 (exp(b <I4 - 1>^2) - 1). Linka & Kuhl (2023), Comput. Methods Appl. Mech.
/// Eng. 403, 115731. Non-negative weights make W grow with its invariants: no stress at rest, none that softens in
/// them. Terms in I2 are not polyconvex, those in I1 and <I4 - 1> are.
#pragma once

#include "materials/registry.hpp"
#include "materials/weights.hpp"

namespace titin {

struct Cann {
  static constexpr auto name = "cann";
  static constexpr auto formula =
      "W = sum over x = I1 - 3, I2 - 3 of w1 x + w2 (exp(b1 x) - 1) + w3 x^2 + w4 (exp(b2 x^2) - 1)";
  static constexpr auto source = "Linka & Kuhl 2023, Comput. Methods Appl. Mech. Eng. 403:115731";
  static constexpr std::array uses{Invariant::I1, Invariant::I2};

  struct Weight {
    std::vector<double> moduli{0, 0, 0, 0}, exponents{0, 0};
  };
  Weight of_1, of_2;

  void bind(Section& s) {
    Weights w(s);
    const char* moduli = "weights w1, w2, w3, w4 of the terms of this invariant";
    const char* exponents = "b1, b2: weights inside of the exponentials of this invariant";
    w.read("moduli_1", of_1.moduli, {.unit = "Pa", .range = non_negative, .doc = moduli, .size = 4});
    w.read("exponents_1", of_1.exponents, {.range = non_negative, .doc = exponents, .size = 2});
    w.read("moduli_2", of_2.moduli, {.unit = "Pa", .range = non_negative, .doc = moduli, .size = 4});
    w.read("exponents_2", of_2.exponents, {.range = non_negative, .doc = exponents, .size = 2});
    if (s.describing()) return;
    const auto stiffness = [](const Weight& v) { return v.moduli[0] + v.moduli[1] * v.exponents[0]; };
    if (!(stiffness(of_1) + stiffness(of_2) > 0))
      s.error("", "no shear modulus at rest: w1 and w2 b1 are 0 in both invariants",
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
    return w[0] * x + w[1] * expm1(b[0] * x) + w[2] * x * x + w[3] * expm1(b[1] * x * x);
  }
};
TITIN_LAW(Cann)

struct CannFibre {
  static constexpr auto name = "cann_fibre";
  static constexpr auto formula = "W = w1 <I4 - 1>^2 + w2 (exp(b <I4 - 1>^2) - 1)";
  static constexpr auto source = Cann::source;
  static constexpr std::array uses{Invariant::I4};

  double w1 = 0, w2 = 0, b = 0;

  void bind(Section& s) {
    s.read("w1", w1, {.unit = "Pa", .range = non_negative, .required = true, .doc = "weight of the square"});
    s.read("w2", w2, {.unit = "Pa", .range = non_negative, .required = true, .doc = "weight of the exponential"});
    s.read("b", b, {.range = non_negative, .required = true, .doc = "weight inside of the exponential"});
  }
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
