/// Shear stiffnesses of muscle and tendon after Blemker: W = g1 B1^2 + g2 B2^2 [J/m^3], along and across the fibres,
/// B1^2 = I5/I4^2 - 1, B2 = acosh w, w = (I1 I4 - I5)/(2 sqrt(I4)). Blemker, Pinsky & Delp (2005), J. Biomech. 38, 657;
/// Criscione et al. (2001). The fibres themselves are terms of their own (blemker_passive, blemker_active,
/// weiss_fibre). Neither strain sees a change of volume: of unsplit fibre invariants it is taken away.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct BlemkerShear {
  static constexpr auto name = "blemker_shear";
  static constexpr auto formula = "W = g1 (I5/I4^2 - 1) + g2 acosh(w)^2, w = (I1 I4 - I5)/(2 sqrt(I4))";
  static constexpr auto source = "Blemker, Pinsky & Delp 2005, J. Biomech. 38:657";
  static constexpr std::array uses{Invariant::I1, Invariant::J, Invariant::I4, Invariant::I5};
  static constexpr bool needs_volumetric = true;
  inline static const std::array published{ParameterSet{"skeletal muscle", R"(g1 = "500 Pa", g2 = "500 Pa")",
                                                        "FEBio test decks mu02 and mu03, after Blemker et al. 2005"}};

  double g1 = 0, g2 = 0;
  FibreMeasure measure = FibreMeasure::isochoric;

  void bind(Section& s) {
    s.read("g1", g1, {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness in shear along the fibres"});
    s.read("g2", g2,
           {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness in shear across the fibres"});
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::sqrt;
    const auto [e4, e5] = isochoric(x);
    const T I4 = 1.0 + e4, root = sqrt(I4);
    const T along = (e5 - e4 * (2.0 + e4)) / (I4 * I4);
    // w - 1, where the ones are taken out by hand: it is of second order in the strain.
    const T half = 0.5 * (x.e1() * I4 + 3.0 * e4 - e5);
    const T above = (half - e4 / (1.0 + root)) / root;
    return g1 * along + g2 * acosh_squared(above);
  }

  /// I4 - 1 and I5 - 1 of Cbar: those of C times J^-2/3 and J^-4/3.
  template <class T>
  std::array<T, 2> isochoric(const Invariants<T>& x) const {
    using std::expm1, std::log1p;
    if (measure == FibreMeasure::isochoric) return {x.e4(), x.e5()};
    const T shrinks = expm1(-2.0 / 3 * log1p(x.eJ()));  // J^-2/3 - 1
    const T e4 = x.e4() + shrinks * (1.0 + x.e4());
    return {e4, x.e5() + shrinks * (2.0 + shrinks) * (1.0 + x.e5())};
  }

  /// acosh(1 + u)^2: the series 2 sum (-1)^(n+1) (2u)^n / (n^2 binomial(2n, n)) near 0, where the closed form has no
  /// derivative; twelve terms reach round-off at u = 0.1.
  template <class T>
  static T acosh_squared(const T& u) {
    using std::log, std::sqrt;
    constexpr double series_limit = 0.1;
    if (u > series_limit) {
      const T a = log(1.0 + u + sqrt(u * (u + 2.0)));
      return a * a;
    }
    std::array<double, 12> c;
    double binomial = 1;
    for (int n = 1; n <= 12; ++n) {
      binomial *= 2.0 * (2 * n - 1) / n;
      c[n - 1] = (n % 2 ? 2 : -2) * std::exp2(n) / (n * n * binomial);
    }
    T sum = c[11];
    for (int n = 10; n >= 0; --n) sum = sum * u + c[n];
    return sum * u;
  }
};
TITIN_LAW(BlemkerShear)

}  // namespace titin
