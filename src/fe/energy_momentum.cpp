#include "fe/energy_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

/// Below this |dC| the quotient is left out: what is missing of the energy is of third order in it, and round-off,
/// while the quotient would divide round-off by |dC|.
constexpr double least_change = 1e-6;
/// The same for the change of the volume ratio, whose quotient has no third-order part left out.
constexpr double least_volume_change = 1e-7;

/// Upper triangular R with R^T R = C: a deformation gradient of that strain.
Mat3 upper_factor(const Mat3& C) {
  Mat3 R{};
  R[0] = std::sqrt(C[0]);
  R[1] = C[1] / R[0];
  R[2] = C[2] / R[0];
  R[4] = std::sqrt(C[4] - R[1] * R[1]);
  R[5] = (C[5] - R[1] * R[2]) / R[4];
  R[8] = std::sqrt(C[8] - R[2] * R[2] - R[5] * R[5]);
  return R;
}

Mat3 right_cauchy_green(const Mat3& F) { return multiply(transpose(F), F); }

Mat3 mean(const Mat3& A, const Mat3& B) {
  Mat3 M;
  for (int i = 0; i < 9; ++i) M[i] = 0.5 * (A[i] + B[i]);
  return M;
}

/// C : X for a tensor of fourth order.
Mat3 apply(const Mat9& C, const Mat3& X) {
  Mat3 Y{};
  for (int a = 0; a < 9; ++a)
    for (int b = 0; b < 9; ++b) Y[a] += C[9 * a + b] * X[b];
  return Y;
}

/// 2 dS/dC of S = F^-1 P from A = dP/dF: CC_IJML = F^-1_Ii (A_iJkL - delta_ik S_JL) F^-1_Mk.
Mat9 material_moduli(const Mat3& F_inverse, const Mat3& S, const Mat9& A) {
  Mat9 half{}, CC{};  // F^-1_Ii (A_iJkL - ...) as [I J][k L]
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J)
      for (int k = 0; k < 3; ++k)
        for (int L = 0; L < 3; ++L) {
          double sum = -F_inverse[3 * I + k] * S[3 * J + L];
          for (int i = 0; i < 3; ++i) sum += F_inverse[3 * I + i] * A[9 * (3 * i + J) + 3 * k + L];
          half[9 * (3 * I + J) + 3 * k + L] = sum;
        }
  for (int row = 0; row < 9; ++row)
    for (int M = 0; M < 3; ++M)
      for (int L = 0; L < 3; ++L)
        for (int k = 0; k < 3; ++k) CC[9 * row + 3 * M + L] += half[9 * row + 3 * k + L] * F_inverse[3 * M + k];
  return CC;
}

/// 2 dS/dC of S = J C^-1.
Mat9 volume_moduli(double J, const Mat3& C_inverse) {
  Mat9 CC;
  const Mat3& G = C_inverse;
  for (int I = 0; I < 3; ++I)
    for (int K = 0; K < 3; ++K)
      for (int L = 0; L < 3; ++L)
        for (int M = 0; M < 3; ++M)
          CC[9 * (3 * I + K) + 3 * L + M] =
              J * (G[3 * I + K] * G[3 * L + M] - G[3 * I + L] * G[3 * K + M] - G[3 * I + M] * G[3 * K + L]);
  return CC;
}

/// The discrete gradient S[phi] of one function of C, from its value and gradient at both ends and in the middle.
struct DiscreteGradient {
  Mat3 S, dC, Z{};
  double theta = 0;

  DiscreteGradient(double change, const Mat3& S_middle, const Mat3& dC_) : S(S_middle), dC(dC_) {
    square_ = contract(dC, dC);
    if (square_ < least_change * least_change) return;
    theta = (2 * change - contract(S_middle, dC)) / square_;
    add(S, theta, dC);
  }
  /// d S[phi] = D : dC, where S_end is 2 phi'(C) at the end and CC = 2 dS/dC in the middle.
  Mat9 tangent(const Mat3& S_middle, const Mat3& S_end, const Mat9& CC) const {
    Mat9 D;
    for (int i = 0; i < 81; ++i) D[i] = 0.25 * CC[i];
    if (square_ < least_change * least_change) return D;
    Mat3 row = S_end;
    add(row, -1.0, S_middle);
    add(row, -0.25, apply(CC, dC));
    add(row, -2 * theta, dC);
    for (int I = 0; I < 3; ++I)
      for (int J = 0; J < 3; ++J) {
        const int a = 3 * I + J;
        for (int b = 0; b < 9; ++b) D[9 * a + b] += dC[a] * row[b] / square_;
        D[9 * a + a] += 0.5 * theta;
        D[9 * a + 3 * J + I] += 0.5 * theta;
      }
    return D;
  }

 private:
  double square_ = 0;
};

/// What dS = D : dC makes of A = d(F_m S)/dF, S included: dC_AB = 2 sym(dF^T F).
void add_moduli(const Mat3& F_m, const Mat3& F, const Mat3& S, const Mat9& D, double factor, Mat9& A) {
  Mat9 half{};  // 2 D_IJLB F_kB as [I J][k L]
  for (int row = 0; row < 9; ++row)
    for (int k = 0; k < 3; ++k)
      for (int L = 0; L < 3; ++L)
        for (int B = 0; B < 3; ++B) half[9 * row + 3 * k + L] += 2 * D[9 * row + 3 * L + B] * F[3 * k + B];
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) {
      double* row = &A[9 * (3 * i + J)];
      for (int column = 0; column < 9; ++column)
        for (int I = 0; I < 3; ++I) row[column] += factor * F_m[3 * i + I] * half[9 * (3 * I + J) + column];
      for (int L = 0; L < 3; ++L) row[3 * i + L] += factor * 0.5 * S[3 * L + J];
    }
}

/// A cell's batch of points at another deformation.
PointInput at(PointInput in, const std::vector<Mat3>& F, PointInput::Part part) {
  in.F = F.data();
  in.part = part;
  in.new_history = nullptr;
  return in;
}

}  // namespace

bool EnergyMomentum::deform(int cell, const Material& material, const ThreeField& kernel, const PointInput& in,
                            bool with_tangent) {
  points_.assign(in.n, {});
  bad_point_ = -1;
  set_elastic(material, kernel, in, with_tangent);
  set_pressure(cell, material, kernel);
  add_pressure(kernel, with_tangent, tables_.modes(cell) == 0);
  return add_rest(material, kernel, in, with_tangent);
}

/// F_m S[W] of the terms that store energy.
void EnergyMomentum::set_elastic(const Material& material, const ThreeField& kernel, const PointInput& in,
                                 bool with_tangent) {
  std::vector<Mat3> R(in.n), P(in.n), P_end(in.n);
  std::vector<Mat9> A(with_tangent ? in.n : 0);
  std::vector<double> W(in.n), W_old(in.n);
  for (int q = 0; q < in.n; ++q)
    R[q] = upper_factor(mean(right_cauchy_green(kernel.F()[q]), right_cauchy_green(kernel.F_old()[q])));
  using Part = PointInput::Part;
  material.stress(at(in, R, Part::stored), P.data(), with_tangent ? A.data() : nullptr);
  material.potential(at(in, kernel.F(), Part::stored), W.data());
  material.potential(at(in, kernel.F_old(), Part::stored), W_old.data());
  if (with_tangent) material.stress(at(in, kernel.F(), Part::stored), P_end.data(), nullptr);
  for (int q = 0; q < in.n; ++q) {
    const Mat3 &F = kernel.F()[q], &F_old = kernel.F_old()[q], F_m = mean(F, F_old), R_inverse = inverse(R[q]);
    Mat3 dC = right_cauchy_green(F);
    add(dC, -1.0, right_cauchy_green(F_old));
    const Mat3 S = multiply(R_inverse, P[q]);
    const DiscreteGradient gradient(W[q] - W_old[q], S, dC);
    points_[q].P = multiply(F_m, gradient.S);
    points_[q].A.fill(0);
    if (!with_tangent) continue;
    const Mat3 S_end = multiply(inverse(F), P_end[q]);
    const Mat9 D = gradient.tangent(S, S_end, material_moduli(R_inverse, S, A[q]));
    add_moduli(F_m, F, gradient.S, D, 1, points_[q].A);
  }
}

/// p = Pi u', and its derivative by D.
void EnergyMomentum::set_pressure(int cell, const Material& material, const ThreeField& kernel) {
  const std::size_t n = points_.size();
  std::vector<double> J_old(n), D_old(n), quotient(n);
  for (std::size_t q = 0; q < n; ++q) J_old[q] = determinant(kernel.F_old()[q]);
  kernel.project(cell, J_old, D_old);
  for (std::size_t q = 0; q < n; ++q) {
    const double D = kernel.dilatation()[q], change = D - D_old[q];
    const auto end = material.volumetric(D), middle = material.volumetric(0.5 * (D + D_old[q]));
    const bool still = std::abs(change) < least_volume_change;
    quotient[q] = still ? middle.dU : (end.U - material.volumetric(D_old[q]).U) / change;
    points_[q].dp = still ? 0.5 * middle.d2U : (end.dU - quotient[q]) / change;
  }
  p_.resize(n);
  kernel.project(cell, quotient, p_);
}

/// F_m p S[J].
void EnergyMomentum::add_pressure(const ThreeField& kernel, bool with_tangent, bool alone) {
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const Mat3 &F = kernel.F()[q], &F_old = kernel.F_old()[q], F_m = mean(F, F_old);
    const Mat3 C = right_cauchy_green(F), C_old = right_cauchy_green(F_old), C_m = mean(C, C_old);
    Mat3 dC = C;
    add(dC, -1.0, C_old);
    const double J_m = std::sqrt(determinant(C_m));
    const Mat3 G = inverse(C_m), S = scaled(J_m, G);
    const DiscreteGradient gradient(determinant(F) - determinant(F_old), S, dC);
    Point& point = points_[q];
    point.Q = multiply(F_m, gradient.S);
    add(point.P, p_[q], point.Q);
    if (!with_tangent) continue;
    const Mat3 S_end = scaled(determinant(F), inverse(C)), cof = cofactor(F);
    for (int a = 0; a < 9 && alone; ++a)  // p is a function of J at the point
      for (int b = 0; b < 9; ++b) point.A[9 * a + b] += point.dp * point.Q[a] * cof[b];
    add_moduli(F_m, F, gradient.S, gradient.tangent(S, S_end, volume_moduli(J_m, G)), p_[q], point.A);
  }
}

/// What does not store energy, or remembers: in the middle of the step, where half of it has passed.
bool EnergyMomentum::add_rest(const Material& material, const ThreeField& kernel, const PointInput& in,
                              bool with_tangent) {
  std::vector<Mat3> F_m(in.n), P(in.n);
  std::vector<Mat9> A(with_tangent ? in.n : 0);
  for (int q = 0; q < in.n; ++q) {
    F_m[q] = mean(kernel.F()[q], kernel.F_old()[q]);
    if (!(determinant(F_m[q]) > 0)) bad_point_ = q;
  }
  if (bad_point_ >= 0) return false;
  PointInput middle = at(in, F_m, PointInput::Part::rest);
  middle.time -= 0.5 * in.dt;
  middle.dt *= 0.5;
  middle.F_rate_old = nullptr;
  material.stress(middle, P.data(), with_tangent ? A.data() : nullptr);
  for (int q = 0; q < in.n; ++q) {
    add(points_[q].P, 1.0, P[q]);
    if (!with_tangent) continue;
    for (int i = 0; i < 81; ++i) points_[q].A[i] += 0.5 * A[q][i];
  }
  return true;
}

void EnergyMomentum::add_forces(int cell, const ThreeField& kernel, double* r) const {
  const int dimension = tables_.dimension(), nodes = tables_.nodes(cell), padded = tables_.padded(cell);
  for (std::size_t q = 0; q < points_.size(); ++q)
    for (int i = 0; i < dimension; ++i)
      for (int J = 0; J < 3; ++J) {
        const double stress = tables_.weight(cell, q) * points_[q].P[3 * i + J];
        const double* G = kernel.gradients() + (3 * q + J) * padded;
        for (int a = 0; a < nodes; ++a) r[i * nodes + a] += stress * G[a];
      }
}

void EnergyMomentum::add_tangent(int cell, ThreeField& kernel, double* K) const {
  std::vector<Mat9> weighted;
  for (std::size_t q = 0; q < points_.size(); ++q) {
    weighted.push_back(points_[q].A);
    for (double& A : weighted.back()) A *= tables_.weight(cell, q);
  }
  kernel.add_moduli(cell, weighted.data(), false, K);
  if (tables_.modes(cell) > 0) add_volumetric_stiffness(cell, kernel, K);
}

/// K += L^T M^-1 [int du'/dD psi psi^T] M^-1 B,  L_l = int psi_l F_m S[J] : Grad N,  B_l = int psi_l cof F : Grad N.
void EnergyMomentum::add_volumetric_stiffness(int cell, const ThreeField& kernel, double* K) const {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell), modes = tables_.modes(cell);
  const int dimension = tables_.dimension(), n = dimension * nodes;
  mfem::DenseMatrix L(n, modes), B(n, modes), C(modes), S(modes), MC(modes), mass_inverse(modes), LS(n, modes);
  std::copy_n(tables_.mode_mass_inverse(cell), modes * modes, mass_inverse.GetData());
  L = 0.0;
  B = 0.0;
  C = 0.0;
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const double w = tables_.weight(cell, q);
    const double *psi = tables_.mode(cell, q), *G = kernel.gradients() + 3 * q * padded;
    const Mat3 &Q = points_[q].Q, cof = cofactor(kernel.F()[q]);
    for (int i = 0; i < dimension; ++i)
      for (int a = 0; a < nodes; ++a) {
        double left = 0, right = 0;
        for (int J = 0; J < 3; ++J)
          left += Q[3 * i + J] * G[J * padded + a], right += cof[3 * i + J] * G[J * padded + a];
        for (int l = 0; l < modes; ++l) {
          L(i * nodes + a, l) += w * psi[l] * left;
          B(i * nodes + a, l) += w * psi[l] * right;
        }
      }
    for (int l = 0; l < modes; ++l)
      for (int m = 0; m < modes; ++m) C(l, m) += w * points_[q].dp * psi[l] * psi[m];
  }
  mfem::Mult(mass_inverse, C, MC);
  mfem::Mult(MC, mass_inverse, S);
  mfem::Mult(L, S, LS);
  for (int c = 0; c < n; ++c)
    for (int l = 0; l < modes; ++l)
      for (int d = 0; d < n; ++d) K[c * n + d] += LS(c, l) * B(d, l);
}

}  // namespace titin
