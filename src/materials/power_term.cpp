#include "materials/power_term.hpp"

#include "math/spectral.hpp"

namespace titin {
namespace {

/// F = sum lambda_a n_a (x) N_a, with f_a = F N_a.
struct Principal {
  Vec3 log_x;        ///< ln lambda_a^2
  Vec3 log_stretch;  ///< ln (J^-1/3 lambda_a); they add up to 0
  double log_J;
  std::array<Vec3, 3> N, f;
};

/// From the strain, so that small strains keep their digits.
Principal principal(const Mat3& F) {
  Mat3 H = F;
  for (int i = 0; i < 9; i += 4) H[i] -= 1;
  Mat3 E = multiply(transpose(H), H);  // 2 E = H^T H + H + H^T
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) E[3 * i + j] += H[3 * i + j] + H[3 * j + i];
  const Eigenpairs e = eigenpairs(E);
  Principal p;
  p.log_J = std::log1p(trace(H) + trace(cofactor(H)) + determinant(H));
  p.N = e.vectors;
  for (int a = 0; a < 3; ++a) {
    p.log_x[a] = std::log1p(e.values[a]);
    p.log_stretch[a] = 0.5 * p.log_x[a] - p.log_J / 3;
    p.f[a] = multiply(F, p.N[a]);
  }
  return p;
}

/// The scalars of the spectral forms: S = sum S_a N_a (x) N_a, and those of its derivative by C.
struct Scalars {
  Vec3 stress{};  ///< S_a
  Mat3 normal{};  ///< of N_a N_a N_b N_b
  Vec3 shear{};   ///< (S_b - S_a)/(x_b - x_a) of the pair without axis c
};

/// With L_a = l_a^alpha and mu = c alpha: beta_a = mu (L_a - sum L/3) are the principal Kirchhoff stresses.
void add_power(const StretchPower& power, const Principal& p, Scalars& s) {
  const double alpha = power.exponent, mu = power.coefficient * alpha;
  Vec3 L_1, x;
  for (int a = 0; a < 3; ++a) {
    L_1[a] = std::expm1(alpha * p.log_stretch[a]);
    x[a] = std::exp(p.log_x[a]);
  }
  const double mean_1 = (L_1[0] + L_1[1] + L_1[2]) / 3, mean = 1 + mean_1;
  for (int a = 0; a < 3; ++a) {
    const double beta = mu * (L_1[a] - mean_1);
    s.stress[a] += beta / x[a];
    for (int b = 0; b < 3; ++b) {
      const double L = a == b ? 1 + L_1[a] : -(2 + L_1[a] + L_1[b]);
      s.normal[3 * a + b] += (mu * alpha * (L + mean) / 3 - (a == b ? 2 * beta : 0)) / (x[a] * x[b]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double of_power = divided_difference_of_power(0.5 * alpha - 1, p.log_x[a], p.log_x[b]);
    s.shear[c] += mu * (std::exp(-alpha / 3 * p.log_J) * of_power + mean / (x[a] * x[b]));
  }
}

/// c sum (ln l_a)^2: the Kirchhoff stresses are beta_a = 2 c ln l_a.
void add_logarithm(double c, const Principal& p, Scalars& s) {
  Vec3 x;
  for (int a = 0; a < 3; ++a) x[a] = std::exp(p.log_x[a]);
  for (int a = 0; a < 3; ++a) {
    const double beta = 2 * c * p.log_stretch[a];
    s.stress[a] += beta / x[a];
    for (int b = 0; b < 3; ++b) s.normal[3 * a + b] += (a == b ? 4.0 / 3 * c - 2 * beta : -2.0 / 3 * c) / (x[a] * x[b]);
  }
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const double of_log = divided_difference_of_log(p.log_x[a], p.log_x[b]);
    s.shear[i] += c * (of_log - 2 * p.log_stretch[a] / x[a]) / x[b];
  }
}

Mat3 second_piola(const Principal& p, const Scalars& s) {
  Mat3 S{};
  for (int a = 0; a < 3; ++a) add(S, s.stress[a], dyad(p.N[a], p.N[a]));
  return S;
}

void add_dyad(double w, const Mat3& left, const Mat3& right, Mat9& A) {
  for (int p = 0; p < 9; ++p)
    for (int q = 0; q < 9; ++q) A[9 * p + q] += w * left[p] * right[q];
}

/// A = delta_ik S_JL + F_iA F_kB CC_AJBL, where F turns N_a N_b into f_a (x) N_b.
void add_tangent(const Principal& p, const Scalars& s, double weight, Mat9& A) {
  const Mat3 S = second_piola(p, s);
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int L = 0; L < 3; ++L) A[9 * (3 * i + J) + 3 * i + L] += weight * S[3 * J + L];
  for (int a = 0; a < 3; ++a) {
    Mat3 right{};
    for (int b = 0; b < 3; ++b) add(right, s.normal[3 * a + b], dyad(p.f[b], p.N[b]));
    add_dyad(weight, dyad(p.f[a], p.N[a]), right, A);
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    Mat3 both = dyad(p.f[b], p.N[c]);
    add(both, 1.0, dyad(p.f[c], p.N[b]));
    add_dyad(weight * s.shear[a], both, both, A);
  }
}

}  // namespace

void PowerTerm::add_energy(const PointBlock& points, double weight, double* sum) const {
  for (int n = 0; n < points.n; ++n) {
    const Principal p = principal(points.F[n]);
    for (const StretchPower& power : powers_)
      for (double l : p.log_stretch)
        sum[n] += weight * power.coefficient * (power.exponent == 0 ? l * l : std::expm1(power.exponent * l));
  }
}

void PowerTerm::add_stress(const PointBlock& points, double weight, Mat3* P, Mat9* A) const {
  for (int n = 0; n < points.n; ++n) {
    const Principal p = principal(points.F[n]);
    Scalars s;
    for (const StretchPower& power : powers_)
      if (power.exponent == 0)
        add_logarithm(power.coefficient, p, s);
      else
        add_power(power, p, s);
    for (int a = 0; a < 3; ++a) add(P[n], weight * s.stress[a], dyad(p.f[a], p.N[a]));
    if (A) add_tangent(p, s, weight, A[n]);
  }
}

}  // namespace titin
