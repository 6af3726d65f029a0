/// Linear solvers, all through PETSc.
#pragma once

#include <functional>
#include <memory>
#include <mfem.hpp>
#include <string>

#include "base/config.hpp"
#include "solve/block_solver.hpp"
#include "solve/bordered.hpp"
#include "solve/linear_choice.hpp"
#include "solve/petsc.hpp"

namespace titin {

struct LinearConfig {
  LinearMethod method = LinearMethod::automatic;
  /// Krylov iterations on an old factorisation that cost about as much as a new one: refactor above this many.
  int reuse_limit = 12;
  /// Relative residual of a linear solve: small enough that Newton needs no more iterations than with exact solves.
  double tolerance = 1e-4;
  void bind(Section& s);
};

/// One of three, each with a preconditioner that is kept while it still works for later matrices:
///
/// * direct: a factorisation by MUMPS (LDL^T, or LU when the matrix is not symmetric), and GMRES around it;
/// * block: displacement and pressure by GCR, multigrid for the one and a Schur complement for the other;
/// * condensed: GCR on the matrix itself, multigrid with patches that hold the volumetric stiffness.
class LinearSolver {
 public:
  /// `cells` gives the tangent's cells with an augmentation gamma; asked once if the method needs them. Empty where
  /// the elements have none: then `auto` is direct, and InputError thrown for the others. `border`: null without.
  LinearSolver(const LinearConfig& config, Mat K, bool symmetric,
               const std::function<const CellBlocks&(double gamma)>& cells, const Border* border = nullptr);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;

  /// K has new values. Decides whether the old preconditioner is used once more; returns true if so.
  bool matrix_changed();
  /// Forgets a preconditioner that was of an earlier matrix; false when it is of the present one.
  bool forget_reused();
  /// Forgets every earlier matrix, and what was learnt of it.
  void forget();
  /// x = K^-1 b. Returns "" or why it failed.
  std::string solve(mfem::Vector& b, mfem::Vector& x);
  /// What the last solve of the KSP means in words; "" when it worked.
  std::string failure() const;
  int iterations() const;  ///< of the last solve
  int take_iterations();   ///< of all solves since the last call
  KSP ksp() const { return ksp_; }
  const BlockSolver* block() const { return block_.get(); }  ///< null when the method is direct

 private:
  void create_direct(bool symmetric);
  void create_block(Mat K, const CellBlocks& cells);
  void create_bordered(Mat K, const Border& border);
  static PetscErrorCode update_block(PC);
  static PetscErrorCode apply_block(PC, Vec b, Vec x);
  static PetscErrorCode apply_bordered(PC, Vec b, Vec x);

  LinearConfig config_;
  KSP ksp_ = nullptr;     // what others see
  KSP solver_ = nullptr;  // of K: the same but with a border
  std::unique_ptr<BorderedSolver> bordered_;
  std::unique_ptr<BlockSolver> block_;
  std::string block_failure_;
  int fresh_iterations_ = 0;  // of the first solve with a new preconditioner
  int largest_ = 0;           // of the last solve: with a border it takes several
  int total_ = 0;
  bool prepared_ = false, reused_ = false;
};

}  // namespace titin
