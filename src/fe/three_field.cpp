#include "fe/three_field.hpp"

#include <algorithm>

namespace titin {

namespace {

typedef double Pack
    __attribute__((vector_size(64), aligned(8)));  // GCC and Clang split it where registers are narrower
constexpr int pack = 8;
constexpr int rows_at_once = 6;  // 6 rows x 4 packs of accumulators fit 32 registers for Q2

/// C[a][b] = sum_s G[s][a] H[s][b] for a < nodes, b < padded; PACKS = padded / 8.
template <int PACKS>
void outer_product_sum(int nodes, int terms, const double* G, const double* H, double* C) {
  constexpr int padded = PACKS * pack;
  for (int first = 0; first < nodes; first += rows_at_once) {
    const int rows = std::min(rows_at_once, padded - first);
    Pack sum[rows_at_once][PACKS] = {};
    for (int s = 0; s < terms; ++s) {
      const Pack* h = reinterpret_cast<const Pack*>(H + s * padded);
      const double* g = G + s * padded + first;
      for (int a = 0; a < rows_at_once; ++a) {
        const double factor = a < rows ? g[a] : 0.0;
        for (int b = 0; b < PACKS; ++b) sum[a][b] += factor * h[b];
      }
    }
    for (int a = 0; a < std::min(rows, nodes - first); ++a)
      std::copy_n(reinterpret_cast<const double*>(sum[a]), padded, C + (first + a) * padded);
  }
}

void outer_product_sum(int nodes, int padded, int terms, const double* G, const double* H, double* C) {
  switch (padded / pack) {
    case 1:
      return outer_product_sum<1>(nodes, terms, G, H, C);  // Q1
    case 4:
      return outer_product_sum<4>(nodes, terms, G, H, C);  // Q2
    case 8:
      return outer_product_sum<8>(nodes, terms, G, H, C);  // Q3
    default:
      MFEM_ABORT("no kernel for this number of nodes");
  }
}

Mat3 deformation_gradient(const double* G, int nodes, int padded, const double* u) {
  Mat3 F = identity;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) {
      double sum = 0;
      for (int a = 0; a < nodes; ++a) sum += u[i * nodes + a] * G[J * padded + a];
      F[3 * i + J] += sum;
    }
  return F;
}

}  // namespace

ThreeField::ThreeField(const CellTables& tables)
    : tables_(tables),
      G_(3 * tables.points() * tables.padded()),
      H_(G_.size()),
      F_(tables.points()),
      F_old_(tables.points()),
      cofactor_(tables.points()),
      P_(tables.points()),
      A_(tables.points()),
      fibre_(tables.points()),
      second_fibre_(tables.points()),
      J_(tables.points()),
      D_(tables.points()),
      p_(tables.points()),
      dU_(tables.points()),
      factor_(tables.points()),
      S_(tables.modes() * tables.modes()) {}

bool ThreeField::deform(int cell, const Material& material, const double* u, const double* u_old) {
  const int nodes = tables_.nodes(), padded = tables_.padded(), points = tables_.points();
  tables_.gradients(cell, G_.data());
  bad_point_ = -1;
  for (int q = 0; q < points; ++q) {
    const double* G = &G_[3 * q * padded];
    F_[q] = deformation_gradient(G, nodes, padded, u);
    F_old_[q] = deformation_gradient(G, nodes, padded, u_old);
    J_[q] = determinant(F_[q]);
    cofactor_[q] = cofactor(F_[q]);
    if (!(J_[q] > 0)) bad_point_ = q;
  }
  if (bad_point_ >= 0) return false;
  project(cell, J_, D_);
  for (int q = 0; q < points; ++q) {
    if (!(D_[q] > 0)) bad_point_ = q;
    dU_[q] = material.volumetric(D_[q]).dU;
  }
  project(cell, dU_, p_);
  std::fill(fibre_.begin(), fibre_.end(), material.fibre());
  std::fill(second_fibre_.begin(), second_fibre_.end(), material.second_fibre());
  return bad_point_ < 0;
}

/// projected = Pi values, both at points.
void ThreeField::project(int cell, const std::vector<double>& values, std::vector<double>& projected) const {
  const int modes = tables_.modes(), points = tables_.points();
  const double* mass_inverse = tables_.mode_mass_inverse(cell);
  constexpr int max_modes = 10;
  double moment[max_modes] = {}, coefficient[max_modes] = {};
  for (int q = 0; q < points; ++q)
    for (int l = 0; l < modes; ++l) moment[l] += tables_.weight(cell, q) * values[q] * tables_.mode(cell, q)[l];
  for (int l = 0; l < modes; ++l)
    for (int m = 0; m < modes; ++m) coefficient[l] += mass_inverse[l * modes + m] * moment[m];
  for (int q = 0; q < points; ++q) {
    projected[q] = 0;
    for (int l = 0; l < modes; ++l) projected[q] += coefficient[l] * tables_.mode(cell, q)[l];
  }
}

PointInput ThreeField::points(PointInput in) const {
  in.n = tables_.points();
  in.F = F_.data();
  in.F_old = F_old_.data();
  if (!in.fibre) in.fibre = fibre_.data();
  if (!in.second_fibre) in.second_fibre = second_fibre_.data();
  return in;
}

void ThreeField::add_forces(int cell, const Material& material, PointInput in, double* r) {
  const int nodes = tables_.nodes(), padded = tables_.padded();
  material.stress(points(in), P_.data(), nullptr);
  for (int q = 0; q < tables_.points(); ++q) {
    const double w = tables_.weight(cell, q);
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J) {
        const double stress = w * (P_[q][3 * i + J] + p_[q] * cofactor_[q][3 * i + J]);
        const double* G = &G_[(3 * q + J) * padded];
        for (int a = 0; a < nodes; ++a) r[i * nodes + a] += stress * G[a];
      }
  }
}

/// A_ <- w (A_iso + p d cof F / dF), where d cof_iJ / dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ) / J.
void ThreeField::set_total_moduli(int cell, const Material& material, const PointInput& in) {
  material.stress(in, P_.data(), A_.data());
  for (int q = 0; q < tables_.points(); ++q) {
    const double w = tables_.weight(cell, q), factor = p_[q] / J_[q];
    const Mat3& cof = cofactor_[q];
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        for (int k = 0; k < 3; ++k)
          for (int L = 0; L < 3; ++L) {
            double& A = A_[q][9 * (3 * i + J) + 3 * k + L];
            A = w * (A + factor * (cof[3 * i + J] * cof[3 * k + L] - cof[3 * i + L] * cof[3 * k + J]));
          }
  }
}

TangentPoints ThreeField::tangent_points(int cell, const Material& material, PointInput in, double inertia) {
  material.stress(points(in), P_.data(), A_.data());
  for (int q = 0; q < tables_.points(); ++q) factor_[q] = p_[q] / J_[q];
  set_mode_stiffness(cell, material, S_.data());
  return {A_.data(), cofactor_.data(), factor_.data(), S_.data(), inertia};
}

void ThreeField::add_block(int i, int k, double* K) {
  const int nodes = tables_.nodes(), padded = tables_.padded(), points = tables_.points();
  for (int q = 0; q < points; ++q)
    for (int J = 0; J < 3; ++J) {
      const double* A = &A_[q][9 * (3 * i + J) + 3 * k];
      const double* G = &G_[3 * q * padded];
      double* H = &H_[(3 * q + J) * padded];
      for (int b = 0; b < padded; ++b) H[b] = A[0] * G[b] + A[1] * G[padded + b] + A[2] * G[2 * padded + b];
    }
  std::vector<double> block(nodes * padded);
  outer_product_sum(nodes, padded, 3 * points, G_.data(), H_.data(), block.data());
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) K[(i * nodes + a) * 3 * nodes + k * nodes + b] += block[a * padded + b];
}

void ThreeField::add_tangent(int cell, const Material& material, PointInput in, double* K) {
  const int nodes = tables_.nodes();
  set_total_moduli(cell, material, points(in));
  const bool symmetric = material.symmetric_tangent(in.rate);
  for (int i = 0; i < 3; ++i)
    for (int k = symmetric ? i : 0; k < 3; ++k) add_block(i, k, K);
  if (symmetric)  // K comes in symmetric (zero, or with earlier symmetric parts)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < i; ++k)
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b)
            K[(i * nodes + a) * 3 * nodes + k * nodes + b] = K[(k * nodes + b) * 3 * nodes + i * nodes + a];
  add_volumetric_stiffness(cell, material, K);
}

/// K += B^T S B with S = M^-1 [int U''(D) psi psi^T] M^-1.
void ThreeField::add_volumetric_stiffness(int cell, const Material& material, double* K) {
  const int nodes = tables_.nodes(), padded = tables_.padded(), modes = tables_.modes(), n = 3 * nodes;
  mfem::DenseMatrix B(n, modes), S(modes), SB(n, modes);
  B = 0.0;
  set_mode_stiffness(cell, material, S.GetData());
  std::vector<double> row(n);
  for (int q = 0; q < tables_.points(); ++q) {
    const double w = tables_.weight(cell, q);
    const double* psi = tables_.mode(cell, q);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < nodes; ++a) {
        double sum = 0;
        for (int J = 0; J < 3; ++J) sum += cofactor_[q][3 * i + J] * G_[(3 * q + J) * padded + a];
        row[i * nodes + a] = w * sum;
      }
    for (int l = 0; l < modes; ++l) {
      double* column = B.GetColumn(l);
      for (int c = 0; c < n; ++c) column[c] += psi[l] * row[c];
    }
  }
  mfem::Mult(B, S, SB);
  for (int c = 0; c < n; ++c)
    for (int l = 0; l < modes; ++l) {
      const double factor = SB(c, l);
      const double* column = B.GetColumn(l);
      for (int d = 0; d < n; ++d) K[c * n + d] += factor * column[d];
    }
}

void ThreeField::set_mode_stiffness(int cell, const Material& material, double* S) const {
  const int modes = tables_.modes();
  mfem::DenseMatrix C(modes), MC(modes), stiffness(S, modes, modes);
  const mfem::DenseMatrix mass_inverse(const_cast<double*>(tables_.mode_mass_inverse(cell)), modes, modes);
  C = 0.0;
  for (int q = 0; q < tables_.points(); ++q) {
    const double weighted = tables_.weight(cell, q) * material.volumetric(D_[q]).d2U;
    const double* psi = tables_.mode(cell, q);
    for (int l = 0; l < modes; ++l)
      for (int m = 0; m < modes; ++m) C(l, m) += weighted * psi[l] * psi[m];
  }
  mfem::Mult(mass_inverse, C, MC);
  mfem::Mult(MC, mass_inverse, stiffness);
}

void ThreeField::add_mass(int cell, double density, double* M) const {
  const int nodes = tables_.nodes(), padded = tables_.padded(), points = tables_.points();
  std::vector<double> N(points * padded), weighted(points * padded), block(nodes * padded);
  for (int q = 0; q < points; ++q)
    for (int a = 0; a < padded; ++a) {
      N[q * padded + a] = tables_.shape(q)[a];
      weighted[q * padded + a] = density * tables_.weight(cell, q) * tables_.shape(q)[a];
    }
  outer_product_sum(nodes, padded, points, N.data(), weighted.data(), block.data());
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) M[a * nodes + b] += block[a * padded + b];
}

}  // namespace titin
