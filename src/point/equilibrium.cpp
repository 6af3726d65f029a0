#include "point/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/compressible.hpp"
#include "math/dense.hpp"

namespace titin {
namespace {

constexpr int most_iterations = 60;
// Relative to the stiffness. Below `small` a residual that no longer falls is round-off; above it Newton is lost.
constexpr double small = 1e-9, exact = 1e-16;
constexpr double falls = 0.1;                 // what a step of Newton near the solution leaves of the residual, at most
constexpr double shortest_step = 1.0 / 4096;  // of a Newton step
constexpr double smallest_part = 1.0 / 1024;  // of the way to the control

/// d(cof F)_iJ / dF_kL times p: p J (Ft_iJ Ft_kL - Ft_iL Ft_kJ), written without division by J.
void add_multiplier_tangent(const Mat3& F, double p, Mat9& A) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, J1 = (J + 1) % 3, J2 = (J + 2) % 3;
      double* row = &A[9 * (3 * i + J)];
      row[3 * i1 + J1] += p * F[3 * i2 + J2];
      row[3 * i2 + J2] += p * F[3 * i1 + J1];
      row[3 * i1 + J2] -= p * F[3 * i2 + J1];
      row[3 * i2 + J1] -= p * F[3 * i1 + J2];
    }
}

/// The unknowns of a control, its residual at a state, and the Newton step from there.
class Residual {
 public:
  Residual(const Equilibrium& point, const MixedControl& control, const PointInput& step, bool incompressible)
      : point_(point), control_(control), step_(step), constrained_(incompressible) {
    for (int q = 0; q < 9; ++q)
      if (control.by_stress[q]) free_[count_++] = q;
  }

  /// Size of the residual over the stiffness, not a number where the state is none; fills the system when asked.
  double evaluate(PointState& state, bool want_step) {
    Mat9 A;
    point_.stress(step_, state.F, state.multiplier, state.P, want_step ? &A : nullptr);
    if (want_step) {
      stiffness_ = *std::max_element(A.begin(), A.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
      stiffness_ = std::max(std::abs(stiffness_), std::numeric_limits<double>::min());
      fill(state, A);
    }
    double sum = 0;
    for (int r = 0; r < count_; ++r) sum += square((state.P[free_[r]] - control_.value[free_[r]]) / stiffness_);
    if (constrained_) sum += square(determinant(state.F) - 1);
    return std::sqrt(sum + 0 * state.P[0]);
  }
  bool solve() { return system_.solve(); }
  PointState moved(const PointState& from, double part) const {
    PointState to = from;
    for (int r = 0; r < count_; ++r) to.F[free_[r]] -= part * system_.b[r];
    if (constrained_) to.multiplier -= part * stiffness_ * system_.b[count_];
    return to;
  }
  int unknowns() const { return count_ + constrained_; }

 private:
  static double square(double x) { return x * x; }

  /// In units of the stiffness, so that the volume's equation weighs like the others.
  void fill(const PointState& state, const Mat9& A) {
    system_.n = unknowns();
    const Mat3 cof = cofactor(state.F);
    for (int r = 0; r < count_; ++r) {
      for (int c = 0; c < count_; ++c) system_.at(r, c) = A[9 * free_[r] + free_[c]] / stiffness_;
      system_.b[r] = (state.P[free_[r]] - control_.value[free_[r]]) / stiffness_;
      if (constrained_) system_.at(r, count_) = system_.at(count_, r) = cof[free_[r]];
    }
    if (!constrained_) return;
    system_.at(count_, count_) = 0;
    system_.b[count_] = determinant(state.F) - 1;
  }

  const Equilibrium& point_;
  const MixedControl& control_;
  const PointInput& step_;
  bool constrained_;
  int count_ = 0;
  std::array<int, 9> free_{};
  double stiffness_ = 1;
  DenseSystem<10> system_;
};

/// Part of the way from what is to what is asked.
MixedControl between(const PointState& state, const MixedControl& target, double part) {
  MixedControl control = target;
  for (int q = 0; q < 9; ++q) {
    const double from = target.by_stress[q] ? state.P[q] : state.F[q];
    control.value[q] = from + part * (target.value[q] - from);
  }
  return control;
}

}  // namespace

void Equilibrium::stress(const PointInput& step, const Mat3& F, double multiplier, Mat3& P, Mat9* A) const {
  PointInput in = step;
  in.n = 1;
  in.F = &F;
  if (volume_ == Volume::compressible) return whole_stress(material_, in, &P, A);
  material_.stress(in, &P, A);
  add(P, multiplier, cofactor(F));
  if (A) add_multiplier_tangent(F, multiplier, *A);
}

Outcome Equilibrium::newton(const MixedControl& control, const PointInput& step, PointState& state) const {
  Residual residual(*this, control, step, volume_ == Volume::incompressible);
  for (int q = 0; q < 9; ++q)
    if (!control.by_stress[q]) state.F[q] = control.value[q];
  for (int k = 0; k < most_iterations; ++k) {
    const double size = residual.evaluate(state, true);
    if (!std::isfinite(size)) return {k, "the stress is not a number"};
    if (residual.unknowns() == 0 || size < exact) return {k, ""};
    if (!residual.solve()) return {k, "nothing resists a free component of F"};
    double part = 1;
    PointState next = residual.moved(state, part);
    double next_size = residual.evaluate(next, false);
    if (size < small && !(next_size < falls * size)) return {k, ""};
    while (!(next_size < size)) {
      if (part < shortest_step) return {k, "no smaller residual was found"};
      next = residual.moved(state, part /= 2);
      next_size = residual.evaluate(next, false);
    }
    state = next;
  }
  return {most_iterations, "too many iterations"};
}

Outcome Equilibrium::find(const MixedControl& control, const PointInput& step, PointState& state) const {
  PointState reached = state;
  Outcome all;
  for (double done = 0, part = 1; done < 1;) {
    PointState next = reached;
    const double share = std::min(1.0, part / (1 - done));
    const Outcome outcome = newton(share == 1 ? control : between(reached, control, share), step, next);
    all.iterations += outcome.iterations;
    if (outcome.ok()) {
      reached = next;
      done = share == 1 ? 1 : done + part;
      part *= 2;
    } else if ((part /= 2) < smallest_part) {
      all.problem = outcome.problem;
      return all;
    }
  }
  state = reached;
  return all;
}

}  // namespace titin
