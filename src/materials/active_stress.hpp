/// Prescribed active stress t = peak_stress activation(t) [Pa] along and across the fibre, in a stated measure. With
/// a = F a0, l = |a|, n = a/l, b = F F^T and the shares `along` and `across`,
///
///   cauchy:    sigma = t [along n (x) n + across (I - n (x) n)]
///   kirchhoff: J sigma = the same
///   pk1:       P = t along n (x) a0
///   pk2:       S = t [along a0 (x) a0 + across (I - a0 (x) a0)]
///
/// Nash & Panfilov (2004), Prog. Biophys. Mol. Biol. 85, 501; Land et al. (2015), Proc. R. Soc. A 471, 20150641,
/// problem 3 (pk2). The measures agree without deformation only: at a stretch of 1.2 they are 20 to 44 % apart, so
/// papers' peak stresses need the measure that they were fitted in.
///
/// All are tau = s n (x) n + q (I or b), which W_4 = s/(2 I4) of the fibre, W_1 and W_J carry. `projection =
/// "deviator"` leaves out the mean stress (in nearly incompressible elements the pressure takes it up). `cauchy` has no
/// potential and its tangent no symmetry, nor have pk1 and pk2 without their mean stress.
#pragma once

#include "materials/activation.hpp"
#include "materials/registry.hpp"

namespace titin {

struct ActiveStress {
  static constexpr auto name = "active_stress";
  static constexpr auto formula =
      "sigma = t [along n (x) n + across (I - n (x) n)], t = peak_stress activation(t), or so in another measure";
  static constexpr auto source =
      "Nash & Panfilov 2004, Prog. Biophys. Mol. Biol. 85:501; Land et al. 2015, Proc. R. Soc. A 471:20150641";
  static constexpr std::array uses{Invariant::I1, Invariant::J, Invariant::I4};
  static constexpr bool needs_volumetric = true;
  static constexpr auto pulls_at_rest = "an active fibre pulls at any length";
  inline static const std::array published{ParameterSet{"myocardium, benchmark problem 3",
                                                        R"(peak_stress = "60 kPa", activation = 1, measure = "pk2")",
                                                        "Land et al. 2015, Proc. R. Soc. A 471:20150641"}};
  enum class Stress { cauchy, pk1, pk2, kirchhoff };
  enum class Projection { none, deviator };

  double peak_stress = 0, along = 1, across = 0;
  Activation activation;
  Stress stress = Stress::cauchy;
  Projection projection = Projection::none;
  FibreMeasure measure = FibreMeasure::isochoric;

  void bind(Section& s) {
    s.read("peak_stress", peak_stress,
           {.unit = "Pa", .range = positive, .required = true, .doc = "stress of the fully active fibre"});
    activation.bind(s);
    s.choose("measure", stress,
             {{"cauchy", Stress::cauchy}, {"pk1", Stress::pk1}, {"pk2", Stress::pk2}, {"kirchhoff", Stress::kirchhoff}},
             {.required = true, .doc = "which stress is prescribed"});
    s.read("along", along, {.range = fraction, .doc = "share along the fibre"});
    s.read("across", across, {.range = fraction, .doc = "share in every direction across the fibre (dispersion)"});
    s.choose("projection", projection, {{"none", Projection::none}, {"deviator", Projection::deviator}},
             {.doc = "the whole stress, or without its mean"});
    if (stress == Stress::pk1 && across > 0)
      s.error("across", "pk1 pulls along n (x) a0 alone", "take another measure for a share across the fibre");
  }
  std::vector<Advice> advice() const {
    if (across <= along) return {};
    return {{"across", "pulls more across the fibres than along them"}};
  }
  bool symmetric() const {
    if (stress == Stress::kirchhoff) return true;
    if (projection == Projection::deviator) return false;
    return stress != Stress::cauchy || along == across;
  }
  template <class T>
  std::array<T, 3> forces(const Invariants<T>& x, double time) const {
    using std::pow, std::sqrt;
    const double t = peak_stress * activation(time);
    const bool full = measure == FibreMeasure::full;
    const T J = 1.0 + x.eJ(), I4 = 1.0 + x.e4(),
            J23 = pow(J, 2.0 / 3);  // I1 is that of Cbar, I4 as fibres are measured
    const T square = full ? I4 : I4 * J23;
    T s = t * (along - across), around = t * across, W1 = 0.0;  // tau = s n (x) n + around I; 2 W1 dev(bbar) for pk2
    if (stress == Stress::cauchy) s *= J, around *= J;
    if (stress == Stress::pk1) s *= sqrt(square);
    if (stress == Stress::pk2) {
      W1 = 0.5 * around * J23;
      s *= square, around *= J23 * (1.0 + x.e1() / 3.0);
    }
    T mean = 0.0;
    if (projection == Projection::none) mean = s / 3.0 + around;
    if (full) mean -= s / 3.0;  // which W_4 of the unsplit invariant carries
    return {W1, mean / J, 0.5 * s / I4};
  }
};
TITIN_LAW(ActiveStress)

}  // namespace titin
