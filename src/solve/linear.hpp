/// Linear solvers, all through PETSc.
#pragma once

#include <mfem.hpp>
#include <string>

#include "base/config.hpp"
#include "solve/petsc.hpp"

namespace titin {

struct LinearConfig {
  /// Krylov iterations on an old factorisation that cost about as much as a new one: refactor above this many.
  int reuse_limit = 12;
  /// Relative residual of a linear solve: small enough that Newton needs no more iterations than with exact solves.
  double tolerance = 1e-4;
  void bind(Section& s);
};

/// A factorisation by MUMPS (LDL^T, or LU when the matrix is not symmetric) that is kept while it still works as a
/// preconditioner, and GMRES around it.
class LinearSolver {
 public:
  LinearSolver(const LinearConfig& config, Mat K, bool symmetric);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;

  /// K has new values. Decides whether the old factorisation is used once more; returns true if so.
  bool matrix_changed();
  /// Forgets a factorisation that was of an earlier matrix; false when it is of the present one.
  bool forget_reused();
  /// x = K^-1 b. Returns "" or why it failed.
  std::string solve(mfem::Vector& b, mfem::Vector& x);
  /// What the last solve of the KSP means in words; "" when it worked.
  std::string failure() const;
  int iterations() const;  ///< of the last solve
  KSP ksp() const { return ksp_; }

 private:
  LinearConfig config_;
  KSP ksp_ = nullptr;
  bool factorised_ = false, reused_ = false;
};

}  // namespace titin
