/// Newton's method by PETSc's SNES on a nonlinear system R(u) = 0, with a line search that knows the domain of R.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "solve/linear.hpp"

namespace titin {

/// What Newton's method sees of a problem. Vectors are true dofs of this rank. All calls are collective.
class NonlinearSystem {
 public:
  virtual ~NonlinearSystem() = default;
  virtual int size() const = 0;
  /// R(u), zero at constrained dofs. Returns false (on all ranks) when u is outside the domain of R.
  virtual bool residual(const mfem::Vector& u, mfem::Vector& R) = 0;
  /// dR/du with unit rows and columns at constrained dofs.
  virtual void tangent(const mfem::Vector& u, Mat K) = 0;
  /// The cells of the tangent for solvers that work on them (solve/block_solver.hpp); from then on tangent() keeps them
  /// current. The same gamma at every call.
  virtual const CellBlocks& cell_blocks(double gamma) = 0;
  virtual bool has_cell_blocks() const = 0;  ///< Collective
  /// Unknowns that tangent() does not put into K; null: none. The same object for the whole run.
  virtual const Border* border() { return nullptr; }
  /// The force that a residual is measured against, at the last u of residual() [N].
  virtual double force_scale() const = 0;
  /// Why residual() was false, in words.
  virtual std::string domain_error() const = 0;
  /// Is R the gradient of a function of u?
  virtual bool has_potential() const { return false; }
  /// That function [J]; infinite outside the domain. Evaluates residual(u) on its way.
  virtual double potential(const mfem::Vector& /*u*/) { return 0; }
};

/// What keeps Newton's method from steps that are too long.
enum class Globalisation {
  line_search,   ///< each iteration starts with the whole step
  trust_region,  ///< with what the last iteration could trust, twice as much when it had all of it
};

struct NewtonConfig {
  double tolerance = 1e-6;
  // Asked besides, where not 0: the last increment over the change in the step, and its work over the first one's.
  double increment_tolerance = 0, energy_tolerance = 0;
  Globalisation globalisation = Globalisation::line_search;
  bool inexact = false;
  int max_iterations = 25;
  LinearConfig linear;
  void bind(Section& s);
};

struct NewtonResult {
  int iterations = 0, krylov = 0;
  double residual = 0;            ///< over its scale
  std::vector<double> residuals;  ///< of each iterate, the first included
  std::string failure;            ///< empty when it converged
};

class Newton {
 public:
  /// `K` is the one matrix of the whole run.
  Newton(const NewtonConfig& config, NonlinearSystem& system, Mat K);
  ~Newton();
  Newton(const Newton&) = delete;

  /// Solves from u, which holds the prescribed values; overwrites it.
  NewtonResult solve(mfem::Vector& u);
  LinearSolver& linear() { return *linear_; }

 private:
  static PetscErrorCode form_residual(SNES, Vec u, Vec R, void* self);
  static PetscErrorCode form_tangent(SNES, Vec u, Mat, Mat K, void* self);
  static PetscErrorCode test(SNES, PetscInt iteration, PetscReal u_norm, PetscReal increment, PetscReal norm,
                             SNESConvergedReason*, void* self);
  static PetscErrorCode search(SNESLineSearch, void* self);
  PetscErrorCode backtrack(SNESLineSearch line_search);
  bool lowers_potential(Vec u, Vec trial, double slope, double s);
  bool converged(double norm, double scale, double increment) const;
  std::string missed() const;
  bool evaluate(Vec u, Vec R);
  std::string reason_in_words(SNESConvergedReason reason) const;

  NewtonConfig config_;
  NonlinearSystem& system_;
  std::unique_ptr<LinearSolver> linear_;
  SNES snes_ = nullptr;
  Vec u_ = nullptr, R_ = nullptr;
  double linear_tolerance_ = 0;  // of solves that are not inexact
  NewtonResult result_;
  bool outside_domain_ = false;
  mfem::Vector start_;    // u at the beginning of the solve
  double potential_ = 0;  // at the last iterate, where asked for
  bool potential_known_ = false;
  double energy_ = 0, first_energy_ = 0;  // |R . increment| of the last and the first iteration
  double relative_increment_ = 0;         // of the last iteration
  double radius_ = 0;                     // of the trust region, [m]
};

}  // namespace titin
