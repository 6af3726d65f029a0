/// The invariants that energies are written in, their gradients, and stress and tangent from an energy's scalar
/// derivatives.
///
/// With F the deformation gradient, J = det F, C = F^T F, a0 and b0 the fibre directions and Cbar = J^-2/3 C:
///
///     I1 = tr Cbar,   I2 = (I1^2 - tr Cbar^2) / 2,   J,
///     I4 = a0 . Cbar a0,   I5 = a0 . Cbar^2 a0,   I6 = b0 . Cbar b0,   I8 = a0 . Cbar b0   (C for Cbar: "full"),
///     r = rate of sqrt(I4), r6 = rate of sqrt(I6)
///
/// For W(I_a):  P = sum W_a G_a  and  A = dP/dF = sum W_a D_a + sum W_ab G_a (x) G_b,  G_a = dI_a/dF, D_a = dG_a/dF.
/// A rate enters as one more invariant that has a gradient and no conjugate force (W_r = 0): a fibre stress that
/// depends on it contributes W_4r, and A loses its symmetry unless r is a function of I4 alone.
/// Values are carried as what they exceed their value at rest (I1 - 3, J - 1, ...) and come from the Green strain, so
/// that small strains keep their digits. All is NaN where J <= 0.
/// Formulas: Holzapfel, Nonlinear Solid Mechanics (2000), ch. 6; derived anew in docs/theory/materials.md. SI units.
#pragma once

#include <array>
#include <initializer_list>

#include "math/lanes.hpp"
#include "math/tensor.hpp"

namespace titin {

/// How the fibre's rate of stretch is taken from a step (t_n, t_n+1).
enum class FibreRate {
  none,                ///< quasi-static: rate 0
  stretch_difference,  ///< (lambda_n+1 - lambda_n) / dt: symmetric tangent
  velocity_gradient,   ///< a . dev(sym((F - F_n) F^-1 / dt)) a / lambda, a = Fbar a0: unsymmetric tangent
  /// The same rate, but its tangent is that of the stretch difference, as in the Flexodeal codes: symmetric, and off
  /// by what does not grow as 1 / dt.
  velocity_gradient_symmetric,
};
/// Does the rate depend on more than the fibre's stretch, and the tangent know it?
constexpr bool has_own_gradient(FibreRate rate) { return rate == FibreRate::velocity_gradient; }
constexpr bool from_velocity_gradient(FibreRate rate) {
  return rate == FibreRate::velocity_gradient || rate == FibreRate::velocity_gradient_symmetric;
}

/// Which fibre invariants: of Cbar (stress is a deviator) or of C.
enum class FibreMeasure { isochoric, full };

/// Which of two families of fibres a term means.
enum class FibreFamily { first, second };

enum class Invariant { I1, I2, J, I4, I5, I6, I8, rate, rate6 };  // the rates are the last: the others have forces
inline constexpr int invariant_count = 9;
constexpr int index(Invariant a) { return static_cast<int>(a); }
inline constexpr int force_count = index(Invariant::rate);

/// The squared stretch of a family and its rate.
struct FamilyInvariants {
  Invariant square, rate;
};
inline constexpr std::array families{FamilyInvariants{Invariant::I4, Invariant::rate},
                                     FamilyInvariants{Invariant::I6, Invariant::rate6}};

template <class T>
using PerInvariant = std::array<T, invariant_count>;
template <class T>
using PerPair = std::array<PerInvariant<T>, invariant_count>;

/// A few of the invariants.
class InvariantSet {
 public:
  constexpr InvariantSet() = default;
  constexpr void insert(Invariant a) { bits_ |= 1u << index(a); }
  constexpr void insert(InvariantSet s) { bits_ |= s.bits_; }
  constexpr void erase(Invariant a) { bits_ &= ~(1u << index(a)); }
  constexpr bool has_any(std::initializer_list<Invariant> list) const {
    for (Invariant a : list)
      if (has(a)) return true;
    return false;
  }
  constexpr bool has(Invariant a) const { return bits_ >> index(a) & 1u; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool has_rate() const { return has_any({Invariant::rate, Invariant::rate6}); }

 private:
  unsigned bits_ = 0;
};

/// What the invariants of a point depend on besides F and the fibre.
struct FibreOptions {
  FibreMeasure measure = FibreMeasure::isochoric;
  FibreRate rate = FibreRate::none;
  double dt = 0;  ///< [s]; a rate needs dt > 0
};

/// A point's deformation, ready for values and gradients. T is a number, or Lanes for several points at once.
template <class T>
struct Kinematics {
  Tensor3<T> F, Ft, E;  ///< Ft = F^-T; E = Green strain
  T J_1, J;             ///< J - 1 without cancellation, J
  T y;                  ///< J^-1/3
  Vector3<T> a0, f;     ///< first fibre direction and F a0; set when used, as all that follows
  Vector3<T> b0, g;     ///< second fibre direction and F b0
  FibreOptions options;
  std::array<T, 2> rate;             ///< of the stretch, by family [1/s]
  std::array<Tensor3<T>, 2> G_rate;  ///< their gradients; set for FibreRate::velocity_gradient only
};

/// Unit fibre directions in the reference configuration.
template <class T>
struct FibrePair {
  Vector3<T> first, second;
};

/// What `used` invariants need of a deformation, into k; `F_old` and `fibres` are looked at only when they do.
template <class T>
void deform(const Tensor3<T>& F, const Tensor3<T>& F_old, const FibrePair<T>& fibres, InvariantSet used,
            const FibreOptions& options, Kinematics<T>& k);

/// The invariants u0 . C v0 that are quadratic in F, with u = F u0 and v = F v0.
template <class T>
struct Quadratic {
  const Vector3<T>&u0, &v0, &u, &v;
};
inline constexpr std::array quadratic_invariants{Invariant::I4, Invariant::I6, Invariant::I8};
template <class T>
Quadratic<T> quadratic(const Kinematics<T>& k, Invariant a) {
  if (a == Invariant::I4) return {k.a0, k.a0, k.f, k.f};
  if (a == Invariant::I6) return {k.b0, k.b0, k.g, k.g};
  return {k.a0, k.b0, k.f, k.g};
}

/// The used invariants' excess over rest, the others not set: I1 - 3, I2 - 3, J - 1, I4 - 1, I5 - 1, I6 - 1, I8 - a0 .
/// b0, rates.
template <class T>
PerInvariant<T> values(const Kinematics<T>& k, InvariantSet used);

/// G_a of the used invariants (a rate's only for FibreRate::velocity_gradient; see chain_rate).
template <class T>
PerInvariant<Tensor3<T>> gradients(const Kinematics<T>& k, InvariantSet used);

/// Derivatives of the summed energy at a point: first[a] = W_a, second[a][b] = W_ab, not symmetric where a rate is
/// used.
template <class T>
struct EnergyDerivatives {
  PerInvariant<T> first;  // not set to zero: only those of used invariants are looked at
  PerPair<T> second;
};

/// Where a rate is a function of I4 (stretch difference), or its tangent takes it for one, its derivatives become
/// derivatives by I4: W_44 += W_4r dr/dI4; so for I6.
template <class T>
void chain_rate(const Kinematics<T>& k, InvariantSet used, EnergyDerivatives<T>& W);

/// P [Pa] from first derivatives.
template <class T>
Tensor3<T> assemble_stress(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W);
/// P and A [Pa].
template <class T>
Tensor3<T> assemble_tangent(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W,
                            std::array<T, 81>& A);

}  // namespace titin
