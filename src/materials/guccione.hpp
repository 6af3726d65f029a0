/// Transversely isotropic Fung law of myocardium: W = c/2 (exp(Q) - 1) [J/m^3],
/// Q = bf Eff^2 + bt (Ess^2 + Enn^2 + 2 Esn^2) + 2 bfs (Efs^2 + Efn^2), E the Green strain, f the fibre.
/// Guccione, McCulloch & Waldman (1991), J. Biomech. Eng. 113, 42.
/// With fibre_invariants = "full" E is that of C; otherwise that of Cbar.
#pragma once

#include "materials/full_strain.hpp"
#include "materials/overflow.hpp"
#include "materials/registry.hpp"

namespace titin {

struct Guccione {
  static constexpr auto name = "guccione";
  static constexpr auto formula =
      "W = c/2 (exp(Q) - 1), Q = bf Eff^2 + bt (Ess^2 + Enn^2 + 2 Esn^2) + 2 bfs (Efs^2 + Efn^2)";
  static constexpr auto source = "Guccione, McCulloch & Waldman 1991, J. Biomech. Eng. 113:42";
  static constexpr std::array uses{Invariant::I1, Invariant::I2, Invariant::J, Invariant::I4, Invariant::I5};
  static constexpr bool needs_volumetric = true;
  inline static const std::array published{ParameterSet{"myocardium, benchmark problem 1",
                                                        R"(c = "2 kPa", bf = 8, bt = 2, bfs = 4)",
                                                        "Land et al. 2015, Proc. R. Soc. A 471:20150641"}};

  double c = 0, bf = 0, bt = 0, bfs = 0;
  FibreMeasure measure = FibreMeasure::isochoric;

  void bind(Section& s) {
    s.read("c", c, {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness"});
    s.read("bf", bf, {.range = positive, .required = true, .doc = "exponent along the fibres"});
    s.read("bt", bt, {.range = positive, .required = true, .doc = "exponent across the fibres"});
    s.read("bfs", bfs, {.range = positive, .required = true, .doc = "exponent of shear along the fibres"});
  }
  /// Sums of squares of E from invariants: E:E = (4 e1 - 2 e2 + e1^2)/4 and |E f|^2 = (e5 - 2 e4)/4.
  std::vector<Advice> advice() const { return advice_of_exponent("bf", bf, 0.5 * strain_of_tissue); }
  template <class T>
  T energy(const Invariants<T>& x) const {
    using std::expm1;
    T e1 = x.e1(), e2 = x.e2();
    if (measure == FibreMeasure::full) {
      const FullStrain<T> full = full_strain(x);
      e1 = full.e1, e2 = full.e2;
    }
    const T all = 0.25 * (4.0 * e1 - 2.0 * e2 + e1 * e1);
    const T along = 0.25 * x.e4() * x.e4();
    const T shear = 0.25 * (x.e5() - 2.0 * x.e4()) - along;
    return 0.5 * c * expm1(bf * along + bt * (all - along - 2.0 * shear) + 2 * bfs * shear);
  }
};
TITIN_LAW(Guccione)

}  // namespace titin
