#include "solve/linear.hpp"

#include "base/timers.hpp"

namespace titin {

namespace {

constexpr int restart = 60;
constexpr int max_iterations = 60;  // an old factorisation that needs more is worth nothing
constexpr int mumps_extra_memory =
    60;  // [%] of its own estimate, ICNTL(14): fill grows with pivoting on indefinite matrices

/// PETSc's view of a true-dof vector; no copy.
struct View {
  View(mfem::Vector& v) {
    check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, v.Size(), PETSC_DECIDE, v.GetData(), &vec));
  }
  ~View() { VecDestroy(&vec); }
  Vec vec = nullptr;
};

}  // namespace

void LinearConfig::bind(Section& s) {
  s.read("reuse_limit", reuse_limit,
         {.range = {.min = 0, .max = 50},
          .doc = "a factorisation is used again while a solve takes at most this many iterations"});
  s.read("linear_tolerance", tolerance,
         {.range = {.min = 1e-14, .max = 1e-2}, .doc = "relative residual of a linear solve"});
}

LinearSolver::LinearSolver(const LinearConfig& config, Mat K, bool symmetric) : config_(config) {
  check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
  check(KSPSetOperators(ksp_, K, K));
  check(KSPSetType(ksp_, KSPGMRES));
  check(KSPGMRESSetRestart(ksp_, restart));
  // The tolerance is then one of forces, as Newton's is. In displacements, which the other side would measure, soft
  // modes hide what is left in stiff ones: slender or nearly incompressible bodies took seven times the Newton
  // iterations.
  check(KSPSetPCSide(ksp_, PC_RIGHT));
  check(KSPSetTolerances(ksp_, config.tolerance, PETSC_DEFAULT, PETSC_DEFAULT, max_iterations));
  PC pc;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, symmetric ? PCCHOLESKY : PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(PCFactorSetUpMatSolverType(pc));
  Mat factor;
  check(PCFactorGetMatrix(pc, &factor));
  check(MatMumpsSetIcntl(factor, 14, mumps_extra_memory));
  check(KSPSetFromOptions(ksp_));
}

LinearSolver::~LinearSolver() { KSPDestroy(&ksp_); }

bool LinearSolver::matrix_changed() {
  reused_ = factorised_ && failure().empty() && iterations() <= config_.reuse_limit;
  check(KSPSetReusePreconditioner(ksp_, reused_ ? PETSC_TRUE : PETSC_FALSE));
  factorised_ = true;
  return reused_;
}

bool LinearSolver::forget_reused() {
  factorised_ = !reused_;
  return reused_;
}

std::string LinearSolver::solve(mfem::Vector& b, mfem::Vector& x) {
  Timers::Scope timer("linear solve");
  check(KSPSolve(ksp_, View(b).vec, View(x).vec));
  return failure();
}

std::string LinearSolver::failure() const {
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(ksp_, &reason));
  if (reason >= 0) return "";
  if (reason == KSP_DIVERGED_PC_FAILED)
    return "the tangent could not be factorised (it is singular, or memory ran out)";
  if (reason == KSP_DIVERGED_NANORINF) return "the tangent holds numbers that are not finite";
  return "the linear solver did not converge";
}

int LinearSolver::iterations() const {
  PetscInt its = 0;
  check(KSPGetIterationNumber(ksp_, &its));
  return its;
}

}  // namespace titin
