/// A term of a material's energy, seen from the material: a block of invariants in, a block of derivatives out.
///
/// Laws (one struct, one file) know nothing of this: an adaptor makes any law a term. A law is one of these, or a sum
/// of powers of principal stretches (materials/power_term.hpp):
///   * an energy in invariants: `static constexpr std::array uses{Invariant::I1, ...}` and
///     `template <class T> T energy(const Invariants<T>& x) const` [J/m^3], x holding the invariants' excess over rest;
///   * forces W_a by invariants that no energy need have: `uses` and
///     `template <class T> std::array<T, uses.size()> forces(const Invariants<T>& x, double time) const`, one for each
///     used invariant, and `bool symmetric() const`: do they derive from an energy?
///   * a fibre: `static constexpr bool uses_rate` and
///     `template <class T> T fibre_stress(const T& stretch, const T& rate, double time) const`, the Kirchhoff stress
///     along the fibre [Pa]; and `double energy(double stretch) const` [J/m^3] if it stores energy.
#pragma once

#include <array>
#include <concepts>
#include <span>

#include "materials/invariants.hpp"
#include "materials/variation.hpp"
#include "math/dual.hpp"

namespace titin {

inline constexpr int block_size = 16;
static_assert(block_size % lane_count == 0);
using BlockValues = std::array<double, block_size>;

/// The invariants of n <= block_size points.
struct PointBlock {
  int n = 0;
  double time = 0;          ///< t_n+1 [s]
  const Mat3* F = nullptr;  ///< for terms that are not written in invariants
  int field_count = 0;
  const double* fields = nullptr;  ///< [n][field_count] parameters that vary in space
  alignas(64) PerInvariant<BlockValues> excess;
};

/// Sums of W_a and W_ab over terms.
struct DerivativeBlock {
  bool want_second = false;
  alignas(64) PerInvariant<BlockValues> first;
  alignas(64) PerPair<BlockValues> second;
};

class Term {
 public:
  virtual ~Term() = default;
  virtual InvariantSet uses() const = 0;
  virtual bool stores_energy() const = 0;
  /// Whether the tangent is symmetric where no rate is used: W_ab = W_ba.
  virtual bool symmetric() const { return true; }
  bool needs_fibre() const { return uses().has_any({Invariant::I4, Invariant::I5, Invariant::I8}); }
  bool needs_second_fibre() const { return uses().has_any({Invariant::I6, Invariant::I8}); }
  virtual bool needs_perpendicular_fibres() const { return false; }  ///< `fibre` and `second_fibre` are axes
  /// Adds weight times the derivatives of the energy.
  virtual void add_derivatives(const PointBlock& points, double weight, DerivativeBlock& sum) const = 0;
  /// What is not written in invariants adds weight times its stress and, unless null, its tangent.
  virtual void add_stress(const PointBlock& /*points*/, double /*weight*/, Mat3* /*P*/, Mat9* /*A*/) const {}
  /// Adds weight times the energy [J/m^3]; nothing for a term that stores none.
  virtual void add_energy(const PointBlock& points, double weight, double* sum) const = 0;
  /// The same for a term that does work but derives from a potential while its activation is held.
  virtual void add_potential(const PointBlock& points, double weight, double* sum) const {
    add_energy(points, weight, sum);
  }
  virtual double activation(double /*time*/) const { return 0; }
  virtual bool has_curves() const { return false; }  ///< parameters change in time
  virtual bool has_fields() const { return false; }  ///< parameters vary in space
};

/// What an energy is a function of: I1 - 3, I2 - 3, J - 1, I4 - 1, I5 - 1, I6 - 1, I8 - a0 . b0.
template <class T>
struct Invariants {
  PerInvariant<T> excess{};
  const T& e1() const { return excess[index(Invariant::I1)]; }
  const T& e2() const { return excess[index(Invariant::I2)]; }
  const T& eJ() const { return excess[index(Invariant::J)]; }
  const T& e4() const { return excess[index(Invariant::I4)]; }
  const T& e5() const { return excess[index(Invariant::I5)]; }
  const T& e6() const { return excess[index(Invariant::I6)]; }
  const T& e8() const { return excess[index(Invariant::I8)]; }
};

template <class Law>
concept InvariantLaw = requires(const Law& law, const Invariants<double>& x) {
  { law.energy(x) } -> std::convertible_to<double>;
  Law::uses;
};
template <class Law>
concept ForceLaw = requires(const Law& law, const Invariants<double>& x) {
  law.forces(x, 0.0);
  { law.symmetric() } -> std::convertible_to<bool>;
};
template <class Law>
concept FibreLaw = requires(const Law& law, double x) {
  { law.fibre_stress(x, x, x) } -> std::convertible_to<double>;
  { Law::uses_rate } -> std::convertible_to<bool>;
};
template <class Law>
concept StoringFibreLaw = FibreLaw<Law> && requires(const Law& law, double x) {
  law.energy(x);
};

/// Where a law's invariants are found: I4 of the second family is I6.
template <class Law>
constexpr auto slots_of(FibreFamily family) {
  auto slots = Law::uses;
  for (Invariant& a : slots)
    if (a == Invariant::I4 && family == FibreFamily::second) a = Invariant::I6;
  return slots;
}
inline InvariantSet set_of(std::span<const Invariant> slots) {
  InvariantSet set;
  for (Invariant a : slots) set.insert(a);
  return set;
}

template <InvariantLaw Law>
class EnergyTerm final : public Term {
 public:
  EnergyTerm(VariedLaw<Law> law, FibreFamily family) : law_(std::move(law)), slots_(slots_of<Law>(family)) {}
  bool stores_energy() const override { return true; }
  InvariantSet uses() const override { return set_of(slots_); }
  bool needs_perpendicular_fibres() const override {
    return requires { Law::needs_perpendicular_fibres; };
  }
  void add_derivatives(const PointBlock& points, double weight, DerivativeBlock& sum) const override {
    if (sum.want_second)
      add<2>(points, weight, sum);
    else
      add<1>(points, weight, sum);
  }
  void add_energy(const PointBlock& points, double weight, double* sum) const override {
    law_.visit(points, [&](const Law& law, int p, int end) {
      for (; p < end; ++p) {
        Invariants<double> x;
        for (int a = 0; a < M; ++a) x.excess[index(Law::uses[a])] = points.excess[index(slots_[a])][p];
        sum[p] += weight * law.energy(x);
      }
    });
  }
  bool has_curves() const override { return law_.has_curves(); }
  bool has_fields() const override { return law_.has_fields(); }

 private:
  static constexpr int M = static_cast<int>(Law::uses.size());

  template <int order>
  void add(const PointBlock& points, double weight, DerivativeBlock& sum) const {
    using Number = Dual<M, order>;
    law_.visit(points, [&](const Law& law, int p, int end) {
      for (; p < end; ++p) {
        Invariants<Number> x;
        for (int a = 0; a < M; ++a)
          x.excess[index(Law::uses[a])] = Number::variable(points.excess[index(slots_[a])][p], a);
        const Number W = law.energy(x);
        for (int a = 0; a < M; ++a) {
          const int row = index(slots_[a]);
          sum.first[row][p] += weight * W.gradient[a];
          if constexpr (order == 2)
            for (int b = 0; b < M; ++b) sum.second[row][index(slots_[b])][p] += weight * W.hessian[Number::pair(a, b)];
        }
      }
    });
  }

  VariedLaw<Law> law_;
  std::array<Invariant, M> slots_;
};

/// P = sum_a W_a G_a of forces that are given themselves: W_ab = dW_a/dI_b, which need not be symmetric.
template <ForceLaw Law>
class ForceTerm final : public Term {
 public:
  ForceTerm(VariedLaw<Law> law, FibreFamily family) : law_(std::move(law)), slots_(slots_of<Law>(family)) {}
  bool stores_energy() const override { return false; }
  /// Numbers that vary may lose it somewhere, sometime.
  bool symmetric() const override { return !has_curves() && !has_fields() && law_.first().symmetric(); }
  InvariantSet uses() const override { return set_of(slots_); }
  void add_derivatives(const PointBlock& points, double weight, DerivativeBlock& sum) const override {
    using Number = Dual<M, 1>;
    law_.visit(points, [&](const Law& law, int p, int end) {
      for (; p < end; ++p) {
        Invariants<Number> x;
        for (int a = 0; a < M; ++a)
          x.excess[index(Law::uses[a])] = Number::variable(points.excess[index(slots_[a])][p], a);
        const std::array<Number, M> W = law.forces(x, points.time);
        for (int a = 0; a < M; ++a) {
          const int row = index(slots_[a]);
          sum.first[row][p] += weight * W[a].value;
          if (!sum.want_second) continue;
          for (int b = 0; b < M; ++b) sum.second[row][index(slots_[b])][p] += weight * W[a].gradient[b];
        }
      }
    });
  }
  void add_energy(const PointBlock&, double, double*) const override {}
  double activation(double time) const override { return law_.activation(time); }
  bool has_curves() const override { return law_.has_curves(); }
  bool has_fields() const override { return law_.has_fields(); }

 private:
  static constexpr int M = static_cast<int>(Law::uses.size());
  VariedLaw<Law> law_;
  std::array<Invariant, M> slots_;
};

/// W_4 = sigma / (2 I4), whose derivatives are W_44 = (lambda sigma' - 2 sigma) / (4 I4^2) and W_4r = sigma_r / (2 I4).
template <FibreLaw Law>
class FibreTerm final : public Term {
 public:
  FibreTerm(VariedLaw<Law> law, FibreFamily family)
      : law_(std::move(law)), slots_(families[family == FibreFamily::second ? 1 : 0]) {}
  bool stores_energy() const override { return StoringFibreLaw<Law>; }
  InvariantSet uses() const override {
    InvariantSet set;
    set.insert(slots_.square);
    if (Law::uses_rate) set.insert(slots_.rate);
    return set;
  }
  void add_derivatives(const PointBlock& points, double weight, DerivativeBlock& sum) const override {
    constexpr int M = Law::uses_rate ? 2 : 1;
    using Number = Dual<M, 1>;
    const int i4 = index(slots_.square), ir = index(slots_.rate);
    law_.visit(points, [&](const Law& law, int p, int end) {
      for (; p < end; ++p) {
        const double I4 = 1 + points.excess[i4][p], stretch = std::sqrt(I4), half = 0.5 * weight / I4;
        Number rate = 0;
        if constexpr (Law::uses_rate) rate = Number::variable(points.excess[ir][p], 1);
        const Number stress = law.fibre_stress(Number::variable(stretch, 0), rate, points.time);
        sum.first[i4][p] += half * stress.value;
        if (!sum.want_second) continue;
        sum.second[i4][i4][p] += half * (0.5 * stretch * stress.gradient[0] - stress.value) / I4;
        if constexpr (Law::uses_rate) sum.second[i4][ir][p] += half * stress.gradient[1];
      }
    });
  }
  void add_energy(const PointBlock& points, double weight, double* sum) const override {
    if constexpr (StoringFibreLaw<Law>)
      law_.visit(points, [&](const Law& law, int p, int end) {
        for (; p < end; ++p) sum[p] += weight * law.energy(stretch(points, p));
      });
  }
  void add_potential(const PointBlock& points, double weight, double* sum) const override {
    if constexpr (requires(const Law& law) { law.potential(1.0, 0.0); })
      law_.visit(points, [&](const Law& law, int p, int end) {
        for (; p < end; ++p) sum[p] += weight * law.potential(stretch(points, p), points.time);
      });
    else
      add_energy(points, weight, sum);
  }
  double activation(double time) const override { return law_.activation(time); }
  bool has_curves() const override { return law_.has_curves(); }
  bool has_fields() const override { return law_.has_fields(); }

 private:
  double stretch(const PointBlock& points, int p) const {
    return std::sqrt(1 + points.excess[index(slots_.square)][p]);
  }

  VariedLaw<Law> law_;
  FamilyInvariants slots_;
};

}  // namespace titin
