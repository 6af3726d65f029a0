/// Arruda-Boyce eight-chain rubber: W = mu sum_i a_i / N^(i-1) (I1^i - 3^i) [J/m^3], five terms of the inverse Langevin
/// function, a = 1/2, 1/20, 11/1050, 19/7000, 519/673750, N = locking_stretch^2.
/// Arruda & Boyce (1993), J. Mech. Phys. Solids 41, 389. Shear modulus at rest mu (1 + 3/(5N) + 99/(175 N^2) + ...).
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct ArrudaBoyce {
  static constexpr auto name = "arruda_boyce";
  static constexpr auto formula =
      "W = mu sum_i a_i/locking_stretch^(2 i - 2) (I1^i - 3^i), a = 1/2, 1/20, 11/1050, 19/7000, 519/673750";
  static constexpr auto source = "Arruda & Boyce 1993, J. Mech. Phys. Solids 41:389";
  inline static const std::array published{
      ParameterSet{"vulcanised rubber of Treloar", R"(mu = "0.27 MPa", locking_stretch = 5.148)",
                   "Arruda & Boyce 1993, J. Mech. Phys. Solids 41:389 (n k T = 0.27 MPa and N = 26.5 with the whole "
                   "inverse Langevin function; locking_stretch is sqrt(N))"}};
  static constexpr std::array uses{Invariant::I1};

  double mu = 0, locking_stretch = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "modulus of the chains"});
    s.read("locking_stretch", locking_stretch,
           {.range = {.min = 1, .open_min = true}, .required = true, .doc = "stretch at which chains are straight"});
  }
  /// I1^i - 3^i = e1 (I1^(i-1) + 3 I1^(i-2) + ...) keeps the digits of small strains.
  std::vector<Advice> advice() const {
    constexpr double short_chains = 1.2;
    if (locking_stretch >= short_chains) return {};
    return {{"locking_stretch",
             "five terms of the series do not lock: at such short chains the law is far from the one it abbreviates"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    constexpr double a[5] = {1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};
    const double N = locking_stretch * locking_stretch;
    const T I1 = 3.0 + x.e1();
    T quotient = 1.0, sum = a[0];
    double power = 1, scale = 1;
    for (int i = 1; i < 5; ++i) {
      power *= 3, scale /= N;
      quotient = quotient * I1 + power;
      sum += a[i] * scale * quotient;
    }
    return mu * sum * x.e1();
  }
};
TITIN_LAW(ArrudaBoyce)

}  // namespace titin
