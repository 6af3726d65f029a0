/// Inverse of the Schur complement of the pressure, approximately (Cahouet, Chabat 1988, with augmentation):
///
///   S^-1 ~ (M / ((1 + gamma) mu) + S'^-1)^-1 + (B m^-1 B^T + M / kappa)^-1,
///
/// m: lumped mass over what turns displacements into accelerations (dt^2 for backward Euler). The first term is a small
/// matrix in each cell. The second is that of short steps, in which inertia holds against pressure: a discontinuous
/// Laplacian, on which three steps of conjugate gradients are taken. Their preconditioner has one V-cycle of BoomerAMG
/// for the means of cells, and the cell's own block for what varies within it. The formulation is total Lagrangian and
/// this term is about length scales, not about values: it is kept while m stays.
#pragma once

#include "solve/block_coupling.hpp"

namespace titin {

class SchurInverse {
 public:
  SchurInverse(const CellBlocks& blocks, const Multigrid& multigrid, const Coupling& coupling);
  ~SchurInverse();
  SchurInverse(const SchurInverse&) = delete;

  void update();  ///< Collective
  /// p += S^-1 r, [cell][mode]. Collective.
  void add(const double* r, double* p);

 private:
  bool lump(std::vector<double>& mass) const;
  void add_inertial(const double* r, double* p);
  void precondition(const std::vector<double>& r, std::vector<double>& z);
  void multiply(const std::vector<double>& p, std::vector<double>& y);
  void create_laplacian(const std::vector<double>& mass);
  void destroy_laplacian();
  Mat scaled_divergence(const std::vector<double>& mass) const;
  void invert_slopes(const std::vector<double>& mass);

  const CellBlocks& blocks_;
  const Multigrid& multigrid_;
  const Coupling& coupling_;
  std::vector<double> mass_;            // of which the Laplacian is
  std::vector<double> forces_;          // local dofs
  std::vector<double> slopes_inverse_;  // [cell][mode but the first][the same]
  Mat laplacian_ = nullptr;
  KSP solver_ = nullptr;
  Vec right_ = nullptr, left_ = nullptr;
};

}  // namespace titin
