/// Stress and tangent from the scalar derivatives of an energy: materials/invariants.hpp, docs/theory/materials.md.

// GCC 12 warns of the undefined lanes that its own AVX-512 square root is written with.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include "materials/invariants.hpp"

namespace titin {
namespace {

using std::sqrt;

/// A as a sum of a few shapes: dyads of tensors, and what does not factor into dyads. Dyads are kept by pointer, not
/// copied: copying would cost as much as multiplying.
template <class T>
struct Shapes {
  struct Pair {
    const Tensor3<T>*left, *right;
  };
  Tensor3<T> N{};                               ///< delta_ik N_JL
  T ft = 0;                                     ///< Ft_iL Ft_kJ
  Tensor3<T> Y{};                               ///< Ft (x) Y + Y (x) Ft
  std::array<Pair, 3 + invariant_count> dyads;  ///< left_iJ right_kL
  int dyad_count = 0;

  // Of I2 and I5, set only with them.
  bool quartic = false;
  T ff;          ///< F_iL F_kJ
  Tensor3<T> B;  ///< B_ik delta_JL
  // Of I2, set only with it.
  Tensor3<T> Z;  ///< Z (x) F
  // Of I5, set only with it.
  bool fifth = false;
  Tensor3<T> K;  ///< K_iL F_kJ + F_iL K_kJ
  Tensor3<T> b;  ///< b_ik (a0 (x) a0)_JL

  void start_quartic() {
    quartic = true;
    ff = 0;
    B.fill(T(0));
  }
  void add_dyad(const Tensor3<T>& left, const Tensor3<T>& right) { dyads[dyad_count++] = {&left, &right}; }
};

template <class T>
T force(const EnergyDerivatives<T>& W, Invariant a) {
  return W.first[index(a)];
}

/// Invariants quadratic in F: W_a D_a summed is 2 y^2 (H N - ...) with N = W_1 I + sum W_a sym(u0 (x) v0).
template <class T>
void add_quadratic(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W, Shapes<T>& A) {
  Tensor3<T> iso{}, fibres{};
  if (used.has(Invariant::I1)) iso[0] = iso[4] = iso[8] = 2.0 * k.y * k.y * force(W, Invariant::I1);
  const bool full = k.options.measure == FibreMeasure::full;
  for (Invariant a : quadratic_invariants) {
    if (!used.has(a)) continue;
    const auto [u0, v0, u, v] = quadratic(k, a);
    const T w = full ? force(W, a) : T(k.y * k.y * force(W, a));
    add(fibres, w, dyad(u0, v0));
    add(fibres, w, dyad(v0, u0));
  }
  for (int i = 0; i < 9; ++i) {
    if (!full) iso[i] += fibres[i];
    A.N[i] += full ? T(iso[i] + fibres[i]) : iso[i];
  }
  const Tensor3<T> X = multiply(k.F, iso);
  const T q = contract(k.F, X);
  add<T>(A.Y, T(-2.0 / 3), X);
  add<T>(A.Y, q / 9.0, k.Ft);
  A.ft += q / 3.0;
}

/// J^-4/3 I with I and its gradient g of fourth degree in F: what the factor J^-4/3 adds to w J^4/3 D.
template <class T>
void add_fourth_degree_split(const Kinematics<T>& k, const T& w, const T& I, const Tensor3<T>& g, Shapes<T>& A) {
  add<T>(A.Y, -4.0 / 3 * w, g);
  add<T>(A.Y, 8.0 / 9 * w * I, k.Ft);
  A.ft += 4.0 / 3 * w * I;
}

/// g = 2 (c1 F - F C), c1 = tr C.
template <class T>
void add_second(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& A) {
  const T w = force(W, Invariant::I2) * k.y * k.y * k.y * k.y;
  const Tensor3<T> C = multiply(transpose(k.F), k.F);
  const T c1 = trace(C), c2 = 0.5 * (c1 * c1 - contract(C, C));
  Tensor3<T> g = scaled<T>(2.0 * c1, k.F);
  add<T>(g, T(-2.0), multiply(k.F, C));
  for (int i = 0; i < 9; i += 4) A.N[i] += 2.0 * w * c1;
  add<T>(A.N, -2.0 * w, C);
  add<T>(A.B, -2.0 * w, multiply(k.F, transpose(k.F)));
  A.ff -= 2.0 * w;
  A.Z = scaled<T>(4.0 * w, k.F);
  add_fourth_degree_split(k, w, c2, g, A);
}

/// g = 2 (f (x) c + F c (x) a0), c = C a0.
template <class T>
void add_fifth(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& A) {
  const bool full = k.options.measure == FibreMeasure::full;
  const T w = full ? force(W, Invariant::I5) : T(force(W, Invariant::I5) * k.y * k.y * k.y * k.y);
  const T w2 = 2.0 * w;
  const Vector3<T> c = multiply(transpose(k.F), k.f);
  add(A.N, w2, dyad(c, k.a0));
  add(A.N, w2, dyad(k.a0, c));
  add(A.B, w2, dyad(k.f, k.f));
  A.fifth = true;
  A.K = scaled(w2, dyad(k.f, k.a0));
  A.b = scaled(w2, multiply(k.F, transpose(k.F)));
  if (full) return;
  Tensor3<T> g = scaled<T>(T(2.0), dyad(k.f, c));
  add<T>(g, T(2.0), dyad(multiply(k.F, c), k.a0));
  add_fourth_degree_split(k, w, dot(c, c), g, A);
}

template <class T>
void add_volume(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& A) {
  const T w = force(W, Invariant::J) * k.J;
  add<T>(A.Y, 0.5 * w, k.Ft);
  A.ft -= w;
}

template <class T>
Shapes<T> second_gradients(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W) {
  Shapes<T> A;
  if (used.has_any({Invariant::I2, Invariant::I5})) A.start_quartic();
  add_quadratic(k, used, W, A);
  if (used.has(Invariant::I2)) add_second(k, W, A);
  if (used.has(Invariant::I5)) add_fifth(k, W, A);
  if (used.has(Invariant::J)) add_volume(k, W, A);
  return A;
}

template <class T>
void add_quartic_row(const Kinematics<T>& k, const Shapes<T>& A, int i, int J, T* row) {
  const Tensor3<T>& F = k.F;
  for (int c = 0; c < 3; ++c) {
    for (int D = 0; D < 3; ++D) row[3 * c + D] += A.ff * F[3 * i + D] * F[3 * c + J];
    row[3 * c + J] += A.B[3 * i + c];
    if (!A.fifth) continue;
    for (int D = 0; D < 3; ++D) {
      const T crossed = A.K[3 * i + D] * F[3 * c + J] + F[3 * i + D] * A.K[3 * c + J];
      row[3 * c + D] += crossed + A.b[3 * i + c] * k.a0[J] * k.a0[D];
    }
  }
}

/// One row of A at a time, so that it stays in registers.
template <class T>
void write(const Kinematics<T>& k, const Shapes<T>& A, std::array<T, 81>& out) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) {
      const int p = 3 * i + J;
      Tensor3<T> sum;
#pragma GCC unroll 9
      for (int q = 0; q < 9; ++q) sum[q] = A.ft * k.Ft[3 * i + q % 3] * k.Ft[3 * (q / 3) + J];
      for (int n = 0; n < A.dyad_count; ++n) {
        const T left = (*A.dyads[n].left)[p];
#pragma GCC unroll 9
        for (int q = 0; q < 9; ++q) sum[q] += left * (*A.dyads[n].right)[q];
      }
      T* row = &out[9 * p];
#pragma GCC unroll 9
      for (int q = 0; q < 9; ++q) row[q] = sum[q];
      for (int D = 0; D < 3; ++D) row[3 * i + D] += A.N[3 * J + D];
      if (A.quartic) add_quartic_row(k, A, i, J, row);
    }
}

}  // namespace

template <class T>
void chain_rate(const Kinematics<T>& k, InvariantSet used, EnergyDerivatives<T>& W) {
  if (k.options.rate == FibreRate::none || has_own_gradient(k.options.rate)) return;
  const bool full = k.options.measure == FibreMeasure::full;
  for (const FamilyInvariants& family : families) {
    if (!used.has(family.rate)) continue;
    const int i4 = index(family.square), ir = index(family.rate);
    const auto [u0, v0, u, v] = quadratic(k, family.square);
    const T root = norm(u), stretch = full ? root : T(root * k.y);
    W.second[i4][i4] += W.second[i4][ir] * (0.5 / k.options.dt) / stretch;
  }
}

template <class T>
Tensor3<T> assemble_stress(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W) {
  const auto G = gradients(k, used);
  Tensor3<T> P{};
  for (int a = 0; a < force_count; ++a)
    if (used.has(Invariant(a))) add(P, W.first[a], G[a]);
  return P;
}

template <class T>
Tensor3<T> assemble_tangent(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W,
                            std::array<T, 81>& A) {
  const auto G = gradients(k, used);
  PerInvariant<Tensor3<T>> V;  // sum_b W_ab G_b, where not zero: many energies are linear in an invariant
  Shapes<T> shapes = second_gradients(k, used, W);
  shapes.add_dyad(k.Ft, shapes.Y);
  shapes.add_dyad(shapes.Y, k.Ft);
  if (used.has(Invariant::I2)) shapes.add_dyad(shapes.Z, k.F);
  const int columns = has_own_gradient(k.options.rate) ? invariant_count : force_count;
  Tensor3<T> P{};
  for (int a = 0; a < force_count; ++a) {
    if (!used.has(Invariant(a))) continue;
    add(P, W.first[a], G[a]);
    bool any = false;
    for (int b = 0; b < columns; ++b) {
      const T& w = W.second[a][b];
      if (!used.has(Invariant(b)) || all_zero(w)) continue;
      if (any)
        add(V[a], w, G[b]);
      else
        V[a] = scaled(w, G[b]);
      any = true;
    }
    if (any) shapes.add_dyad(G[a], V[a]);
  }
  write(k, shapes, A);
  return P;
}

#define TITIN_INSTANTIATE(T)                                                                            \
  template void chain_rate(const Kinematics<T>&, InvariantSet, EnergyDerivatives<T>&);                  \
  template Tensor3<T> assemble_stress(const Kinematics<T>&, InvariantSet, const EnergyDerivatives<T>&); \
  template Tensor3<T> assemble_tangent(const Kinematics<T>&, InvariantSet, const EnergyDerivatives<T>&, \
                                       std::array<T, 81>&);
TITIN_INSTANTIATE(double)
TITIN_INSTANTIATE(Lanes)
#undef TITIN_INSTANTIATE

}  // namespace titin
