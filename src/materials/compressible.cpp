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

void whole_energy(const Material& material, const PointInput& in, double* W) {
  material.potential(in, W);
  for (int p = 0; p < in.n; ++p) W[p] += material.volumetric(determinant(in.F[p])).U;
}

}  // namespace titin
