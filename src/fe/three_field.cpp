#include "fe/three_field.hpp"

#include <algorithm>

#include "math/lanes.hpp"

namespace titin {

namespace {

/// C[a][b] = sum_s G[s][a] H[s][b] for a < nodes, b < padded, by blocks whose sums stay in registers.
void outer_product_sum(int nodes, int padded, int terms, const double* G, const double* H, double* C) {
  constexpr int rows = 4, columns = 8, packs = columns / lane_count;  // both divide `padded`
  for (int first = 0; first < nodes; first += rows)
    for (int column = 0; column < padded; column += columns) {
      Lanes sum[rows][packs] = {};
      for (int s = 0; s < terms; ++s)
        for (int b = 0; b < packs; ++b) {
          const Lanes h(H + s * padded + column + b * lane_count, std::experimental::element_aligned);
          for (int a = 0; a < rows; ++a) sum[a][b] += G[s * padded + first + a] * h;
        }
      for (int a = 0; a < std::min(rows, nodes - first); ++a)
        for (int b = 0; b < packs; ++b)
          sum[a][b].copy_to(C + (first + a) * padded + column + b * lane_count, std::experimental::element_aligned);
    }
}

/// In plane strain F_33 = 1. Three sums side by side: one alone waits for each of its additions.
Mat3 deformation_gradient(const double* G, int dimension, int nodes, int padded, const double* u) {
  Mat3 F = identity;
  for (int i = 0; i < dimension; ++i) {
    Vec3 row{};
    for (int a = 0; a < nodes; ++a)
      for (int J = 0; J < 3; ++J) row[J] += u[i * nodes + a] * G[J * padded + a];
    for (int J = 0; J < 3; ++J) F[3 * i + J] += row[J];
  }
  return F;
}

}  // namespace

ThreeField::ThreeField(const CellTables& tables)
    : tables_(tables),
      G_(tables.most_gradients()),
      H_(G_.size()),
      F_(tables.most_points()),
      F_old_(F_.size()),
      cofactor_(F_.size()),
      P_(F_.size()),
      A_(F_.size()),
      fibre_(F_.size()),
      second_fibre_(F_.size()),
      J_(F_.size()),
      D_(F_.size()),
      p_(F_.size()),
      dU_(F_.size()),
      factor_(F_.size()),
      S_(tables.most_modes() * tables.most_modes()) {}

bool ThreeField::deform(int cell, const Material& material, const double* u, const double* u_old) {
  const int dimension = tables_.dimension(), nodes = tables_.nodes(cell), padded = tables_.padded(cell);
  points_ = tables_.points(cell);
  tables_.gradients(cell, G_.data());
  bad_point_ = -1;
  F_rate_old_.clear();
  for (int q = 0; q < points_; ++q) {
    const double* G = &G_[3 * q * padded];
    F_[q] = deformation_gradient(G, dimension, nodes, padded, u);
    F_old_[q] = deformation_gradient(G, dimension, nodes, padded, u_old);
    J_[q] = determinant(F_[q]);
    cofactor_[q] = cofactor(F_[q]);
    if (!(J_[q] > 0)) bad_point_ = q;
  }
  if (bad_point_ >= 0) return false;
  project(cell, J_, D_);
  for (int q = 0; q < points_; ++q) {
    if (!(D_[q] > 0)) bad_point_ = q;
    dU_[q] = material.volumetric(D_[q]).dU;
  }
  project(cell, dU_, p_);
  std::fill(fibre_.begin(), fibre_.end(), material.fibre());
  std::fill(second_fibre_.begin(), second_fibre_.end(), material.second_fibre());
  return bad_point_ < 0;
}

void ThreeField::deform_rate(int cell, const double* u_old, double dt, bool known) {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell);
  rate_dt_ = dt;
  rate_known_ = known;
  for (int q = 0; q < points_; ++q)
    F_rate_old_.push_back(deformation_gradient(&G_[3 * q * padded], tables_.dimension(), nodes, padded, u_old));
}

void ThreeField::project(int cell, const std::vector<double>& values, std::vector<double>& projected) const {
  const int modes = tables_.modes(cell);
  if (modes == 0) {
    projected = values;
    return;
  }
  const double* mass_inverse = tables_.mode_mass_inverse(cell);
  constexpr int max_modes = 10;
  double moment[max_modes] = {}, coefficient[max_modes] = {};
  for (int q = 0; q < points_; ++q)
    for (int l = 0; l < modes; ++l) moment[l] += tables_.weight(cell, q) * values[q] * tables_.mode(cell, q)[l];
  for (int l = 0; l < modes; ++l)
    for (int m = 0; m < modes; ++m) coefficient[l] += mass_inverse[l * modes + m] * moment[m];
  for (int q = 0; q < points_; ++q) {
    projected[q] = 0;
    for (int l = 0; l < modes; ++l) projected[q] += coefficient[l] * tables_.mode(cell, q)[l];
  }
}

PointInput ThreeField::points(PointInput in) const {
  in.n = points_;
  in.F = F_.data();
  in.F_old = F_old_.data();
  if (!in.fibre) in.fibre = fibre_.data();
  if (!in.second_fibre) in.second_fibre = second_fibre_.data();
  if (F_rate_old_.empty()) return in;
  in.F_rate_old = F_rate_old_.data();
  in.F_rate = rate_known_ ? F_old_.data() : nullptr;
  in.rate_dt = rate_dt_;
  return in;
}

void ThreeField::add_forces(int cell, const Material& material, PointInput in, double* r) {
  const int dimension = tables_.dimension(), nodes = tables_.nodes(cell), padded = tables_.padded(cell);
  material.stress(points(in), P_.data(), nullptr);
  for (int q = 0; q < points_; ++q) {
    const double w = tables_.weight(cell, q);
    for (int i = 0; i < dimension; ++i)
      for (int J = 0; J < dimension; ++J) {
        const double stress = w * (P_[q][3 * i + J] + p_[q] * cofactor_[q][3 * i + J]);
        const double* G = &G_[(3 * q + J) * padded];
        for (int a = 0; a < nodes; ++a) r[i * nodes + a] += stress * G[a];
      }
  }
}

/// A_ <- w (A_iso + p d cof F / dF), where d cof_iJ / dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ) / J; of a displacement
/// alone also U''(J) cof F (x) cof F.
void ThreeField::set_total_moduli(int cell, const Material& material, const PointInput& in) {
  material.stress(in, P_.data(), A_.data());
  const bool alone = tables_.modes(cell) == 0;
  for (int q = 0; q < points_; ++q) {
    const double w = tables_.weight(cell, q), factor = p_[q] / J_[q];
    const double whole = factor + (alone ? material.volumetric(J_[q]).d2U : 0.0);
    const Mat3& cof = cofactor_[q];
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        for (int k = 0; k < 3; ++k)
          for (int L = 0; L < 3; ++L) {
            double& A = A_[q][9 * (3 * i + J) + 3 * k + L];
            A = w * (A + whole * cof[3 * i + J] * cof[3 * k + L] - factor * cof[3 * i + L] * cof[3 * k + J]);
          }
  }
}

TangentPoints ThreeField::tangent_points(int cell, const Material& material, PointInput in, double inertia) {
  material.stress(points(in), P_.data(), A_.data());
  for (int q = 0; q < points_; ++q) factor_[q] = p_[q] / J_[q];
  set_mode_stiffness(cell, material, S_.data());
  return {A_.data(), cofactor_.data(), factor_.data(), S_.data(), inertia};
}

void ThreeField::add_block(int cell, const Mat9* moduli, int i, int k, double* K) {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell), n = tables_.values(cell);
  for (int q = 0; q < points_; ++q)
    for (int J = 0; J < 3; ++J) {
      const double* A = &moduli[q][9 * (3 * i + J) + 3 * k];
      const double* G = &G_[3 * q * padded];
      double* H = &H_[(3 * q + J) * padded];
      for (int b = 0; b < padded; ++b) H[b] = A[0] * G[b] + A[1] * G[padded + b] + A[2] * G[2 * padded + b];
    }
  std::vector<double> block(nodes * padded);
  outer_product_sum(nodes, padded, 3 * points_, G_.data(), H_.data(), block.data());
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) K[(i * nodes + a) * n + k * nodes + b] += block[a * padded + b];
}

void ThreeField::add_moduli(int cell, const Mat9* A, bool symmetric, double* K) {
  const int dimension = tables_.dimension(), nodes = tables_.nodes(cell), n = tables_.values(cell);
  for (int i = 0; i < dimension; ++i)
    for (int k = symmetric ? i : 0; k < dimension; ++k) add_block(cell, A, i, k, K);
  for (int i = 0; i < dimension && symmetric; ++i)
    for (int k = 0; k < i; ++k)
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b) K[(i * nodes + a) * n + k * nodes + b] = K[(k * nodes + b) * n + i * nodes + a];
}

void ThreeField::add_tangent(int cell, const Material& material, PointInput in, double* K) {
  set_total_moduli(cell, material, points(in));
  add_moduli(cell, A_.data(), material.symmetric_tangent(in.rate), K);
  if (tables_.modes(cell) > 0) add_volumetric_stiffness(cell, material, K);
}

/// K += B^T S B with S = M^-1 [int U''(D) psi psi^T] M^-1.
void ThreeField::add_volumetric_stiffness(int cell, const Material& material, double* K) {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell), modes = tables_.modes(cell);
  const int n = tables_.values(cell);
  mfem::DenseMatrix B(n, modes), S(modes), SB(n, modes);
  B = 0.0;
  set_mode_stiffness(cell, material, S.GetData());
  std::vector<double> row(n);
  for (int q = 0; q < points_; ++q) {
    const double w = tables_.weight(cell, q);
    const double* psi = tables_.mode(cell, q);
    for (int i = 0; i < tables_.dimension(); ++i)
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
  const int modes = tables_.modes(cell);
  mfem::DenseMatrix C(modes), MC(modes), stiffness(S, modes, modes);
  const mfem::DenseMatrix mass_inverse(const_cast<double*>(tables_.mode_mass_inverse(cell)), modes, modes);
  C = 0.0;
  for (int q = 0; q < points_; ++q) {
    const double weighted = tables_.weight(cell, q) * material.volumetric(D_[q]).d2U;
    const double* psi = tables_.mode(cell, q);
    for (int l = 0; l < modes; ++l)
      for (int m = 0; m < modes; ++m) C(l, m) += weighted * psi[l] * psi[m];
  }
  mfem::Mult(mass_inverse, C, MC);
  mfem::Mult(MC, mass_inverse, stiffness);
}

void ThreeField::add_mass(int cell, double density, double* M) const {
  const int nodes = tables_.nodes(cell), padded = tables_.padded(cell), points = tables_.points(cell);
  std::vector<double> N(points * padded), weighted(points * padded), block(nodes * padded);
  for (int q = 0; q < points; ++q)
    for (int a = 0; a < padded; ++a) {
      N[q * padded + a] = tables_.shape(cell, q)[a];
      weighted[q * padded + a] = density * tables_.weight(cell, q) * tables_.shape(cell, q)[a];
    }
  outer_product_sum(nodes, padded, points, N.data(), weighted.data(), block.data());
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) M[a * nodes + b] += block[a * padded + b];
}

}  // namespace titin
