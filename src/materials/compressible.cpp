#include "materials/compressible.hpp"

namespace titin {
namespace {

/// dP/dF of P = J U' F^-T: (J^2 U'' + J U') Ft_iJ Ft_kL - J U' Ft_iL Ft_kJ.
void add_volumetric_tangent(const Mat3& Ft, double first, double second, Mat9& A) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int k = 0; k < 3; ++k)
        for (int L = 0; L < 3; ++L)
          A[9 * (3 * i + J) + 3 * k + L] +=
              (second + first) * Ft[3 * i + J] * Ft[3 * k + L] - first * Ft[3 * i + L] * Ft[3 * k + J];
}

}  // namespace

Sym3 cauchy(const Mat3& P, const Mat3& F) {
  const double over_J = 1 / determinant(F);
  const auto row = [&](int i, int j) {
    return over_J * (P[3 * i] * F[3 * j] + P[3 * i + 1] * F[3 * j + 1] + P[3 * i + 2] * F[3 * j + 2]);
  };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(1, 2), row(0, 2)};
}

void whole_stress(const Material& material, const PointInput& in, Mat3* P, Mat9* A) {
  material.stress(in, P, A);
  for (int p = 0; p < in.n; ++p) {
    const double J = determinant(in.F[p]);
    const Material::Volumetric U = material.volumetric(J);
    const Mat3 G = cofactor(in.F[p]);  // J F^-T
    add(P[p], U.dU, G);
    if (!A) continue;
    Mat3 Ft = G;
    for (double& x : Ft) x /= J;
    add_volumetric_tangent(Ft, J * U.dU, J * J * U.d2U, A[p]);
  }
}

void Material::cauchy_stress(const PointInput& in, Sym3* T, double* W) const {
  std::vector<Mat3> P(in.n);
  stress(in, P.data(), nullptr);
  if (W) potential(in, W);
  for (int p = 0; p < in.n; ++p) {
    const Volumetric U = volumetric(determinant(in.F[p]));
    T[p] = cauchy(P[p], in.F[p]);
    for (int i = 0; i < 3; ++i) T[p][i] += U.dU;
    if (W) W[p] += U.U;
  }
}

void whole_energy(const Material& material, const PointInput& in, double* W) {
  material.potential(in, W);
  for (int p = 0; p < in.n; ++p) W[p] += material.volumetric(determinant(in.F[p])).U;
}

}  // namespace titin
