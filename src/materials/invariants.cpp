// GCC 12 warns of the undefined lanes that its own AVX-512 square root is written with.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include "materials/invariants.hpp"

namespace titin {
namespace {

using std::sqrt;

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
Tensor3<T> strain_of_change(const Tensor3<T>& H) {
  Tensor3<T> E = multiply(transpose(H), H);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) E[3 * i + j] = 0.5 * (E[3 * i + j] + H[3 * i + j] + H[3 * j + i]);
  return E;
}

/// Stretch at t_n: rate = (lambda - lambda_n) / dt.
template <class T>
void set_stretch_difference(Kinematics<T>& k, const Tensor3<T>& F_old, int family) {
  const auto [u0, v0, u, v] = quadratic(k, families[family].square);
  const bool full = k.options.measure == FibreMeasure::full;
  T old = norm(multiply(F_old, u0)), now = norm(u);
  if (!full) {
    old *= inverse_cbrt(determinant(F_old));
    now *= k.y;
  }
  k.rate[family] = (now - old) / k.options.dt;
}

/// With f_n = F_n a0, s = f . f_n, m = f . f, T = tr(F_n F^-1):
/// isochoric r = J^-1/3 [sqrt(m) T / 3 - s / sqrt(m)] / dt, full r = [sqrt(m) - s / sqrt(m)] / dt.
template <class T>
void set_velocity_gradient(Kinematics<T>& k, const Tensor3<T>& F_old, int family) {
  const auto [u0, v0, f, v] = quadratic(k, families[family].square);
  const Vector3<T> f_old = multiply(F_old, u0);
  const T m = dot(f, f), s = dot(f, f_old), root = sqrt(m), scale = 1.0 / k.options.dt;
  T& rate = k.rate[family];
  Tensor3<T>& G = k.G_rate[family];
  Vector3<T> c;  // factor of a0 in the gradient
  if (k.options.measure == FibreMeasure::full) {
    rate = (root - s / root) * scale;
    for (int i = 0; i < 3; ++i) c[i] = scale * (f[i] * (1.0 + s / m) - f_old[i]) / root;
    G = dyad(c, u0);
    return;
  }
  const T spin = contract(F_old, k.Ft);
  rate = k.y * (root * spin / 3.0 - s / root) * scale;
  for (int i = 0; i < 3; ++i) c[i] = scale * k.y * (f[i] * (s / m + spin / 3.0) - f_old[i]) / root;
  G = dyad(c, u0);
  add<T>(G, -rate / 3.0, k.Ft);
  const Tensor3<T> pulled = multiply(multiply(k.Ft, transpose(F_old)), k.Ft);  // (F^-1 F_n F^-1)^T
  add<T>(G, -scale * k.y * root / 3.0, pulled);
}

/// 2 s (F sym(u0 (x) v0) - (u . v)/3 Ft), the latter for isochoric invariants.
template <class T>
Tensor3<T> quadratic_gradient(const Kinematics<T>& k, Invariant a, const T& s, bool isochoric) {
  const auto [u0, v0, u, v] = quadratic(k, a);
  Tensor3<T> G = scaled(s, dyad(u, v0));
  add(G, s, dyad(v, u0));
  if (isochoric) add<T>(G, -2.0 / 3 * s * dot(u, v), k.Ft);
  return G;
}

}  // namespace

template <class T>
void deform(const Tensor3<T>& F, const Tensor3<T>& F_old, const FibrePair<T>& fibres, InvariantSet used,
            const FibreOptions& options, Kinematics<T>& k) {
  Tensor3<T> H = F;
  for (int i = 0; i < 9; i += 4) H[i] -= 1.0;
  k.F = F;
  k.E = strain_of_change(H);
  k.J_1 = volume_change(H);
  k.J = determinant(F);  // not 1 + J_1, which loses the digits of small volumes
  k.y = inverse_cbrt(k.J);
  k.Ft = scaled<T>(1.0 / k.J, cofactor(F));
  k.options = options;
  k.rate = {};
  if (used.has_any({Invariant::I4, Invariant::I5, Invariant::I8})) {
    k.a0 = fibres.first;
    k.f = multiply(F, k.a0);
  }
  if (used.has_any({Invariant::I6, Invariant::I8})) {
    k.b0 = fibres.second;
    k.g = multiply(F, k.b0);
  }
  for (int family = 0; family < 2; ++family) {
    if (!used.has(families[family].rate)) continue;
    if (options.rate == FibreRate::stretch_difference) set_stretch_difference(k, F_old, family);
    if (from_velocity_gradient(options.rate)) set_velocity_gradient(k, F_old, family);
  }
}

template <class T>
PerInvariant<T> values(const Kinematics<T>& k, InvariantSet used) {
  PerInvariant<T> v;
  const T y2 = k.y * k.y;
  const T y2_1 = -(y2 * k.y * k.J_1) * (k.y + 1.0) / (1.0 + k.y + y2);  // J^-2/3 - 1
  const T y4 = y2 * y2, y4_1 = y2_1 * (y2 + 1.0);
  const T e = trace(k.E);
  if (used.has(Invariant::I1)) v[index(Invariant::I1)] = 2.0 * y2 * e + 3.0 * y2_1;
  if (used.has(Invariant::I2))
    v[index(Invariant::I2)] = y4 * (4.0 * e + 2.0 * (e * e - contract(k.E, k.E))) + 3.0 * y4_1;
  if (used.has(Invariant::J)) v[index(Invariant::J)] = k.J_1;
  const bool full = k.options.measure == FibreMeasure::full;
  const T not_a_number = 0.0 * k.y;  // where J <= 0, also for unsplit invariants
  for (Invariant a : quadratic_invariants) {
    if (!used.has(a)) continue;
    const auto [u0, v0, u, w] = quadratic(k, a);
    const T above = 2.0 * dot(u0, multiply(k.E, v0)) + not_a_number;
    v[index(a)] = full ? above : T(y2 * above + y2_1 * dot(u0, v0));
  }
  if (used.has(Invariant::I5)) {
    const Vector3<T> Ea = multiply(k.E, k.a0);
    const T above = 4.0 * (dot(k.a0, Ea) + dot(Ea, Ea)) + not_a_number;
    v[index(Invariant::I5)] = full ? above : T(y4 * above + y4_1);
  }
  for (int family = 0; family < 2; ++family)
    if (used.has(families[family].rate)) v[index(families[family].rate)] = k.rate[family];
  return v;
}

template <class T>
PerInvariant<Tensor3<T>> gradients(const Kinematics<T>& k, InvariantSet used) {
  PerInvariant<Tensor3<T>> G;
  const T y2 = k.y * k.y, y4 = y2 * y2;
  if (used.has(Invariant::I1)) {
    Tensor3<T> S = k.E;
    subtract_mean(S);
    G[index(Invariant::I1)] = scaled<T>(4.0 * y2, multiply(k.Ft, S));
  }
  if (used.has(Invariant::I2)) {
    Tensor3<T> S = scaled<T>(1.0 + 2.0 * trace(k.E), k.E);
    add<T>(S, T(-2.0), multiply(k.E, k.E));
    subtract_mean(S);
    G[index(Invariant::I2)] = scaled<T>(4.0 * y4, multiply(k.Ft, S));
  }
  if (used.has(Invariant::J)) G[index(Invariant::J)] = scaled(k.J, k.Ft);
  const bool full = k.options.measure == FibreMeasure::full;
  for (Invariant a : quadratic_invariants)
    if (used.has(a)) G[index(a)] = quadratic_gradient(k, a, full ? T(1.0) : y2, !full);
  if (used.has(Invariant::I5)) {
    Tensor3<T>& G5 = G[index(Invariant::I5)];
    const Vector3<T> w = multiply(transpose(k.F), k.f);  // C a0
    G5 = scaled<T>(full ? T(2.0) : T(2.0 * y4), dyad(k.f, w));
    add<T>(G5, full ? T(2.0) : T(2.0 * y4), dyad(multiply(k.F, w), k.a0));
    if (!full) add<T>(G5, -4.0 / 3 * y4 * dot(w, w), k.Ft);
  }
  for (int family = 0; family < 2; ++family)
    if (used.has(families[family].rate) && has_own_gradient(k.options.rate))
      G[index(families[family].rate)] = k.G_rate[family];
  return G;
}

#define TITIN_INSTANTIATE(T)                                                                                         \
  template void deform(const Tensor3<T>&, const Tensor3<T>&, const FibrePair<T>&, InvariantSet, const FibreOptions&, \
                       Kinematics<T>&);                                                                              \
  template PerInvariant<T> values(const Kinematics<T>&, InvariantSet);                                               \
  template PerInvariant<Tensor3<T>> gradients(const Kinematics<T>&, InvariantSet);
TITIN_INSTANTIATE(double)
TITIN_INSTANTIATE(Lanes)
#undef TITIN_INSTANTIATE

}  // namespace titin
