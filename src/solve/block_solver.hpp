/// K u = b by FGMRES (Saad 1993) on the equivalent system of displacement and pressure,
///
///   [A_g  B^T; B  -S'^-1] [u; p] = [b; 0],   preconditioned from the right by   [A_g  B^T; 0  -S]^-1,
///
/// with one V-cycle of multigrid for A_g and SchurInverse for S. Pressures are scaled so that both residuals are
/// forces; unscaled, the norm sees one equation only. Converged is what Newton's method asks of it: the residual of the
/// condensed system, b - K u = r_u + B^T S' r_p, relative to b.
/// That takes a look at r_u and r_p, which FGMRES does not keep: once its own norm is small enough, and then not
/// before it has fallen as far as the last look has shown to be needed.
#pragma once

#include <memory>
#include <string>

#include "solve/block_schur.hpp"

namespace titin {

class BlockSolver {
 public:
  /// K is what cells' tangents were assembled into; exact, also where `blocks` keeps the symmetric part in float.
  BlockSolver(const CellBlocks& blocks, Mat K);
  ~BlockSolver();
  BlockSolver(const BlockSolver&) = delete;

  /// Takes the present cells for the preconditioner. Collective.
  void update();
  /// Forgets what it has of earlier cells; update() comes before the next solve.
  void forget() { schur_.reset(), coupling_.reset(), multigrid_.reset(); }
  /// x ~ K^-1 b to a residual of `tolerance` times |b|. Returns "" or why not. Collective.
  std::string solve(Vec b, Vec x, double tolerance);
  int iterations() const { return iterations_; }  ///< of the last solve
  double residual() const { return residual_; }   ///< relative, of the last solve
  std::size_t bytes() const;                      ///< of this rank, without PETSc's and hypre's matrices
  const Multigrid& multigrid() const { return *multigrid_; }

 private:
  static PetscErrorCode multiply(Mat, Vec x, Vec y);
  static PetscErrorCode precondition(PC, Vec r, Vec z);
  static PetscErrorCode test(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason*, void* self);
  void add_coupling(const double* x, double* y);
  bool precondition(const double* r, double* z);
  double condensed_residual(Vec r);

  const CellBlocks& blocks_;
  Mat K_, system_ = nullptr;
  std::unique_ptr<Multigrid> multigrid_;  // once there are numbers
  std::unique_ptr<Coupling> coupling_;
  std::unique_ptr<SchurInverse> schur_;
  KSP ksp_ = nullptr;
  Vec in_ = nullptr, out_ = nullptr;                                                   // displacements: places only
  Vec right_ = nullptr, left_ = nullptr, work_ = nullptr, residual_vector_ = nullptr;  // of both fields
  std::vector<double> local_, forces_;                                                 // local dofs
  int displacements_ = 0, pressures_ = 0, iterations_ = 0;
  double tolerance_ = 0, residual_ = 0, size_of_b_ = 0, next_test_ = 0;
  double best_ = 0, norm_at_best_ = 0;  // least residual of forces so far, and FGMRES's norm then
};

}  // namespace titin
