// GCC 12 warns of the undefined lanes that its own AVX-512 square root is written with.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include "materials/invariants.hpp"

#include <algorithm>

namespace titin {
namespace {

using std::sqrt;

template <class T>
Tensor3<T> scaled(const T& s, const Tensor3<T>& X) {
  Tensor3<T> Y;
  for (int i = 0; i < 9; ++i) Y[i] = s * X[i];
  return Y;
}

template <class T>
void subtract_mean(Tensor3<T>& A) {
  const T mean = trace(A) / 3.0;
  A[0] -= mean, A[4] -= mean, A[8] -= mean;
}

/// J - 1 = tr H + tr cof H + det H with H = F - I.
template <class T>
T volume_change(const Tensor3<T>& H) {
  return trace(H) + trace(cofactor(H)) + determinant(H);
}

template <class T>
Tensor3<T> green_strain(const Tensor3<T>& H) {
  Tensor3<T> E = multiply(transpose(H), H);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) E[3 * i + j] = 0.5 * (E[3 * i + j] + H[3 * i + j] + H[3 * j + i]);
  return E;
}

/// Stretch at t_n: rate = (lambda - lambda_n) / dt.
template <class T>
void set_stretch_difference(Kinematics<T>& k, const Tensor3<T>& F_old) {
  const Vector3<T> f_old = multiply(F_old, k.a0);
  const bool full = k.options.measure == FibreMeasure::full;
  T old = norm(f_old), now = sqrt(k.m);
  if (!full) {
    old *= inverse_cbrt(determinant(F_old));
    now *= k.y;
  }
  k.rate = (now - old) / k.options.dt;
}

/// With f_n = F_n a0, s = f . f_n, m = f . f, T = tr(F_n F^-1):
/// isochoric r = J^-1/3 [sqrt(m) T / 3 - s / sqrt(m)] / dt, full r = [sqrt(m) - s / sqrt(m)] / dt.
template <class T>
void set_velocity_gradient(Kinematics<T>& k, const Tensor3<T>& F_old) {
  const Vector3<T> f_old = multiply(F_old, k.a0);
  const T s = dot(k.f, f_old), root = sqrt(k.m), scale = 1.0 / k.options.dt;
  Vector3<T> c;  // factor of a0 in the gradient
  if (k.options.measure == FibreMeasure::full) {
    k.rate = (root - s / root) * scale;
    for (int i = 0; i < 3; ++i) c[i] = scale * (k.f[i] * (1.0 + s / k.m) - f_old[i]) / root;
    k.G_rate = dyad(c, k.a0);
    return;
  }
  const T spin = contract(F_old, k.Ft);
  k.rate = k.y * (root * spin / 3.0 - s / root) * scale;
  for (int i = 0; i < 3; ++i) c[i] = scale * k.y * (k.f[i] * (s / k.m + spin / 3.0) - f_old[i]) / root;
  k.G_rate = dyad(c, k.a0);
  add<T>(k.G_rate, -k.rate / 3.0, k.Ft);
  const Tensor3<T> pulled = multiply(multiply(k.Ft, transpose(F_old)), k.Ft);  // (F^-1 F_n F^-1)^T
  add<T>(k.G_rate, -scale * k.y * root / 3.0, pulled);
}

/// A as a sum of a few shapes: dyads of tensors, and what does not factor into dyads.
template <class T>
struct Shapes {
  Tensor3<T> N{};    ///< delta_ik N_JL
  Tensor3<T> B{};    ///< B_ik delta_JL
  T ft = 0, ff = 0;  ///< Ft_iL Ft_kJ and F_iL F_kJ
  Tensor3<T> Y{};    ///< Ft (x) Y + Y (x) Ft
  Tensor3<T> Z{};    ///< Z (x) F
  void add_dyad(const Tensor3<T>& left, const Tensor3<T>& right) { dyads[count++] = {&left, &right}; }
  struct Dyad {
    const Tensor3<T>*left, *right;  // not copies: copying would cost as much as multiplying
  };
  std::array<Dyad, 3 + invariant_count> dyads;
  int count = 0;
};

/// W_1 D_1 and, isochoric, W_4 D_4: both are 2 J^-2/3 (H N - ...) with N = W_1 I + W_4 a0 (x) a0.
template <class T>
void add_isochoric(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W, Shapes<T>& L) {
  Tensor3<T> N{};
  if (used.has(Invariant::I1)) N[0] = N[4] = N[8] = W.first[index(Invariant::I1)];
  if (used.has(Invariant::I4)) add<T>(N, W.first[index(Invariant::I4)], dyad(k.a0, k.a0));
  const T factor = 2.0 * k.y * k.y;
  N = scaled(factor, N);
  const Tensor3<T> X = multiply(k.F, N);
  const T q = contract(k.F, X);
  for (int i = 0; i < 9; ++i) L.N[i] += N[i];
  add<T>(L.Y, T(-2.0 / 3), X);
  add<T>(L.Y, q / 9.0, k.Ft);
  L.ft += q / 3.0;
}

template <class T>
void add_full_fibre(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& L) {
  add<T>(L.N, 2.0 * W.first[index(Invariant::I4)], dyad(k.a0, k.a0));
}

/// W_2 D_2 with g = 2 (I1 F - F C) of the unsplit invariants.
template <class T>
void add_second(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& L) {
  const T w = W.first[index(Invariant::I2)] * k.y * k.y * k.y * k.y;
  const Tensor3<T> C = multiply(transpose(k.F), k.F), B = multiply(k.F, transpose(k.F));
  const T I1 = trace(C), I2 = 0.5 * (I1 * I1 - contract(C, C));
  Tensor3<T> g = scaled<T>(2.0 * I1, k.F);
  add<T>(g, T(-2.0), multiply(k.F, C));
  for (int i = 0; i < 9; i += 4) L.N[i] += 2.0 * w * I1;
  add<T>(L.N, -2.0 * w, C);
  add<T>(L.B, -2.0 * w, B);
  L.ff -= 2.0 * w;
  L.Z = scaled<T>(4.0 * w, k.F);
  add<T>(L.Y, -4.0 / 3 * w, g);
  add<T>(L.Y, 8.0 / 9 * w * I2, k.Ft);
  L.ft += 4.0 / 3 * w * I2;
}

template <class T>
void add_volume(const Kinematics<T>& k, const EnergyDerivatives<T>& W, Shapes<T>& L) {
  const T w = W.first[index(Invariant::J)] * k.J;
  add<T>(L.Y, 0.5 * w, k.Ft);
  L.ft -= w;
}

template <class T>
Shapes<T> linear_part(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W) {
  Shapes<T> L;
  InvariantSet isochoric;
  if (used.has(Invariant::I1)) isochoric.insert(Invariant::I1);
  if (used.has(Invariant::I4) && k.options.measure == FibreMeasure::isochoric) isochoric.insert(Invariant::I4);
  add_isochoric(k, isochoric, W, L);
  if (used.has(Invariant::I4) && k.options.measure == FibreMeasure::full) add_full_fibre(k, W, L);
  if (used.has(Invariant::I2)) add_second(k, W, L);
  if (used.has(Invariant::J)) add_volume(k, W, L);
  return L;
}

/// One row of A at a time, so that it stays in registers.
template <class T>
void write(const Kinematics<T>& k, bool second, const Shapes<T>& L, std::array<T, 81>& A) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) {
      const int p = 3 * i + J;
      Tensor3<T> row;
#pragma GCC unroll 9
      for (int q = 0; q < 9; ++q) row[q] = L.ft * k.Ft[3 * i + q % 3] * k.Ft[3 * (q / 3) + J];
      for (int n = 0; n < L.count; ++n) {
        const T left = (*L.dyads[n].left)[p];
#pragma GCC unroll 9
        for (int q = 0; q < 9; ++q) row[q] += left * (*L.dyads[n].right)[q];
      }
      T* out = &A[9 * p];
#pragma GCC unroll 9
      for (int q = 0; q < 9; ++q) out[q] = row[q];
      for (int D = 0; D < 3; ++D) out[3 * i + D] += L.N[3 * J + D];
      if (!second) continue;
      for (int c = 0; c < 3; ++c) {
        for (int D = 0; D < 3; ++D) out[3 * c + D] += L.ff * k.F[3 * i + D] * k.F[3 * c + J];
        out[3 * c + J] += L.B[3 * i + c];
      }
    }
}

}  // namespace

template <class T>
Kinematics<T> kinematics(const Tensor3<T>& F, const Tensor3<T>& F_old, const Vector3<T>& a0, InvariantSet used,
                         const FibreOptions& options) {
  Kinematics<T> k;
  Tensor3<T> H = F;
  for (int i = 0; i < 9; i += 4) H[i] -= 1.0;
  k.F = F;
  k.E = green_strain(H);
  k.J_1 = volume_change(H);
  k.J = 1.0 + k.J_1;
  k.y = inverse_cbrt(k.J);
  k.Ft = scaled<T>(1.0 / k.J, cofactor(F));
  k.options = options;
  if (used.has(Invariant::I4)) {
    k.a0 = a0;
    k.f = multiply(F, a0);
    k.m = dot(k.f, k.f);
    k.aEa = dot(a0, multiply(k.E, a0)) + 0.0 * k.y;  // not a number for unsplit invariants either where J <= 0
  }
  if (used.has(Invariant::rate)) {
    if (options.rate == FibreRate::stretch_difference) set_stretch_difference(k, F_old);
    if (options.rate == FibreRate::velocity_gradient) set_velocity_gradient(k, F_old);
  }
  return k;
}

template <class T>
PerInvariant<T> values(const Kinematics<T>& k, InvariantSet used) {
  PerInvariant<T> v{};
  const T y2 = k.y * k.y;
  const T y2_1 = -(y2 * k.y * k.J_1) * (k.y + 1.0) / (1.0 + k.y + y2);  // J^-2/3 - 1
  const T e = trace(k.E);
  if (used.has(Invariant::I1)) v[index(Invariant::I1)] = 2.0 * y2 * e + 3.0 * y2_1;
  if (used.has(Invariant::I2)) {
    const T above = 4.0 * e + 2.0 * (e * e - contract(k.E, k.E));
    v[index(Invariant::I2)] = y2 * y2 * above + 3.0 * y2_1 * (y2 + 1.0);
  }
  if (used.has(Invariant::J)) v[index(Invariant::J)] = k.J_1;
  if (used.has(Invariant::I4)) {
    const bool full = k.options.measure == FibreMeasure::full;
    v[index(Invariant::I4)] = full ? T(2.0 * k.aEa) : T(2.0 * y2 * k.aEa + y2_1);
  }
  if (used.has(Invariant::rate)) v[index(Invariant::rate)] = k.rate;
  return v;
}

template <class T>
PerInvariant<Tensor3<T>> gradients(const Kinematics<T>& k, InvariantSet used) {
  PerInvariant<Tensor3<T>> G;
  const T y2 = k.y * k.y;
  if (used.has(Invariant::I1)) {
    Tensor3<T> S = k.E;
    subtract_mean(S);
    G[index(Invariant::I1)] = scaled<T>(4.0 * y2, multiply(k.Ft, S));
  }
  if (used.has(Invariant::I2)) {
    Tensor3<T> S = scaled<T>(1.0 + 2.0 * trace(k.E), k.E);
    add<T>(S, T(-2.0), multiply(k.E, k.E));
    subtract_mean(S);
    G[index(Invariant::I2)] = scaled<T>(4.0 * y2 * y2, multiply(k.Ft, S));
  }
  if (used.has(Invariant::J)) G[index(Invariant::J)] = scaled(k.J, k.Ft);
  if (used.has(Invariant::I4)) {
    const bool full = k.options.measure == FibreMeasure::full;
    Tensor3<T>& G4 = G[index(Invariant::I4)];
    G4 = scaled<T>(full ? T(2.0) : T(2.0 * y2), dyad(k.f, k.a0));
    if (!full) add<T>(G4, -2.0 / 3 * y2 * k.m, k.Ft);
  }
  if (used.has(Invariant::rate) && k.options.rate == FibreRate::velocity_gradient) G[index(Invariant::rate)] = k.G_rate;
  return G;
}

template <class T>
void chain_rate(const Kinematics<T>& k, EnergyDerivatives<T>& W) {
  if (k.options.rate != FibreRate::stretch_difference) return;
  constexpr int i4 = index(Invariant::I4), ir = index(Invariant::rate);
  const bool full = k.options.measure == FibreMeasure::full;
  const T root = sqrt(k.m), stretch = full ? root : T(root * k.y);
  W.second[i4][i4] += W.second[i4][ir] * (0.5 / k.options.dt) / stretch;
}

template <class T>
Tensor3<T> assemble_stress(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W) {
  const auto G = gradients(k, used);
  Tensor3<T> P{};
  for (int a = 0; a < index(Invariant::rate); ++a)
    if (used.has(Invariant(a))) add(P, W.first[a], G[a]);
  return P;
}

template <class T>
Tensor3<T> assemble_tangent(const Kinematics<T>& k, InvariantSet used, const EnergyDerivatives<T>& W,
                            std::array<T, 81>& A) {
  const auto G = gradients(k, used);
  PerInvariant<Tensor3<T>> V;  // sum_b W_ab G_b
  Shapes<T> shapes = linear_part(k, used, W);
  shapes.add_dyad(k.Ft, shapes.Y);
  shapes.add_dyad(shapes.Y, k.Ft);
  if (used.has(Invariant::I2)) shapes.add_dyad(shapes.Z, k.F);
  const bool rate = used.has(Invariant::rate) && k.options.rate == FibreRate::velocity_gradient;
  const int columns = invariant_count - (rate ? 0 : 1);
  Tensor3<T> P{};
  for (int a = 0; a < index(Invariant::rate); ++a) {
    if (!used.has(Invariant(a))) continue;
    add(P, W.first[a], G[a]);
    V[a] = scaled(W.second[a][a], G[a]);
    for (int b = 0; b < columns; ++b)
      if (b != a && used.has(Invariant(b))) add(V[a], W.second[a][b], G[b]);
    shapes.add_dyad(G[a], V[a]);
  }
  write(k, used.has(Invariant::I2), shapes, A);
  return P;
}

#define TITIN_INSTANTIATE(T)                                                                               \
  template Kinematics<T> kinematics(const Tensor3<T>&, const Tensor3<T>&, const Vector3<T>&, InvariantSet, \
                                    const FibreOptions&);                                                  \
  template PerInvariant<T> values(const Kinematics<T>&, InvariantSet);                                     \
  template PerInvariant<Tensor3<T>> gradients(const Kinematics<T>&, InvariantSet);                         \
  template void chain_rate(const Kinematics<T>&, EnergyDerivatives<T>&);                                   \
  template Tensor3<T> assemble_stress(const Kinematics<T>&, InvariantSet, const EnergyDerivatives<T>&);    \
  template Tensor3<T> assemble_tangent(const Kinematics<T>&, InvariantSet, const EnergyDerivatives<T>&,    \
                                       std::array<T, 81>&);
TITIN_INSTANTIATE(double)
TITIN_INSTANTIATE(Lanes)
#undef TITIN_INSTANTIATE

}  // namespace titin
