/// Orthotropic Fung law: W = c/2 (exp(Q) - 1) [J/m^3] with the Green strain E in the axes f (`fibre`), s
/// (`second_fibre`) and n = f x s,
///
///   Q = bff Eff^2 + bss Ess^2 + bnn Enn^2 + 2 (bffss Eff Ess + bssnn Ess Enn + bnnff Enn Eff)
///       + 2 (bfs Efs^2 + bsn Esn^2 + bfn Efn^2).
///
/// Fung (1993), Biomechanics: Mechanical Properties of Living Tissues, 2nd ed., sec. 7.10; Usyk, Mazhari & McCulloch
/// (2000), J. Elast. 61, 143. Q must be positive definite. With fibre_invariants = "full" E is that of C; otherwise
/// that of Cbar.
#pragma once

#include <fmt/format.h>

#include "materials/full_strain.hpp"
#include "materials/overflow.hpp"
#include "materials/registry.hpp"

namespace titin {

struct Fung {
  static constexpr auto name = "fung";
  static constexpr auto formula =
      "W = c/2 (exp(Q) - 1), Q = bff Eff^2 + bss Ess^2 + bnn Enn^2 + 2 (bffss Eff Ess + bssnn Ess Enn + bnnff Enn Eff) "
      "+ 2 (bfs Efs^2 + bsn Esn^2 + bfn Efn^2)";
  static constexpr auto source = "Fung 1993, Biomechanics, sec. 7.10; Usyk, Mazhari & McCulloch 2000, J. Elast. 61:143";
  inline static const std::array published{ParameterSet{
      "canine myocardium", R"(c = "0.88 kPa", bff = 18.5, bss = 3.58, bnn = 3.58, bfs = 2.8, bsn = 2.8, bfn = 2.8)",
      "Usyk, Mazhari & McCulloch 2000, J. Elast. 61:143; numbers as in Chaste, CompressibleExponentialLaw"}};
  static constexpr std::array uses{Invariant::I1, Invariant::I2, Invariant::J, Invariant::I4,
                                   Invariant::I5, Invariant::I6, Invariant::I8};
  static constexpr bool needs_volumetric = true;
  static constexpr bool needs_perpendicular_fibres = true;

  double c = 0, bff = 0, bss = 0, bnn = 0, bffss = 0, bssnn = 0, bnnff = 0, bfs = 0, bsn = 0, bfn = 0;
  FibreMeasure measure = FibreMeasure::isochoric;

  void bind(Section& s) {
    s.read("c", c, {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness"});
    for (const auto& [key, b] : {std::pair{"bff", &bff}, {"bss", &bss}, {"bnn", &bnn}})
      s.read(key, *b, {.range = positive, .required = true, .doc = "exponent of stretch along this axis"});
    for (const auto& [key, b] : {std::pair{"bffss", &bffss}, {"bssnn", &bssnn}, {"bnnff", &bnnff}})
      s.read(key, *b, {.doc = "exponent that couples the stretches along two axes"});
    for (const auto& [key, b] : {std::pair{"bfs", &bfs}, {"bsn", &bsn}, {"bfn", &bfn}})
      s.read(key, *b, {.range = positive, .required = true, .doc = "exponent of shear between two axes"});
    if (!s.describing()) check(s);
  }
  std::vector<Advice> advice() const {
    std::vector<Advice> list;
    for (const auto& [key, exponent] : {std::pair{"bff", bff}, {"bss", bss}, {"bnn", bnn}})
      for (const Advice& a : advice_of_exponent(key, exponent, 0.5 * strain_of_tissue)) list.push_back(a);
    return list;
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    T e1 = x.e1(), e2 = x.e2();
    if (measure == FibreMeasure::full) {
      const FullStrain<T> full = full_strain(x);
      e1 = full.e1, e2 = full.e2;
    }
    const T Eff = 0.5 * x.e4(), Ess = 0.5 * x.e6(), Enn = 0.5 * e1 - Eff - Ess;
    const T fs = 0.25 * x.e8() * x.e8();                           // Efs^2
    const T fn = 0.25 * (x.e5() - 2.0 * x.e4()) - Eff * Eff - fs;  // |E f|^2 = (e5 - 2 e4)/4
    const T all = 0.25 * (4.0 * e1 - 2.0 * e2 + e1 * e1);          // E : E
    const T sn = 0.5 * (all - Eff * Eff - Ess * Ess - Enn * Enn) - fs - fn;
    const T stretch = bff * Eff * Eff + bss * Ess * Ess + bnn * Enn * Enn;
    const T coupling = bffss * Eff * Ess + bssnn * Ess * Enn + bnnff * Enn * Eff;
    return 0.5 * c * expm1(stretch + 2.0 * (coupling + bfs * fs + bsn * sn + bfn * fn));
  }

 private:
  /// Sylvester's criterion on the matrix of stretches; shear has a diagonal one.
  void check(Section& s) const {
    const double second = bff * bss - bffss * bffss;
    const double third = bff * (bss * bnn - bssnn * bssnn) - bffss * (bffss * bnn - bssnn * bnnff) +
                         bnnff * (bffss * bssnn - bss * bnnff);
    if (bff > 0 && bss > 0 && bnn > 0 && !(second > 0 && third > 0))
      s.error("",
              "Q is not positive definite: some stretch would soften without end (the matrix of bff, bss, bnn and "
              "bffss, bssnn, bnnff has the minors " +
                  fmt::format("{:.3g}, {:.3g}, {:.3g})", bff, second, third),
              "lower the size of the coupling exponents bffss, bssnn, bnnff");
  }
};
TITIN_LAW(Fung)

}  // namespace titin
