#include "solve/linear.hpp"

#include <algorithm>
#include <limits>

#include "base/log.hpp"
#include "base/timers.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

constexpr int restart = 60;
constexpr int max_iterations = 60;  // an old factorisation that needs more is worth nothing
/// [%] of MUMPS's own estimate, ICNTL(14): fill grows with pivoting on indefinite matrices.
constexpr auto mumps_extra_memory = "60";
constexpr double gamma_of_block =
    5;  // augmentation over the shear modulus; more locks the coarse level in slender bodies
/// Iterations that cost as much as a new preconditioner of the block solver.
constexpr int setup_in_iterations = 4;

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
  s.choose(
      "linear", method,
      {{"auto", LinearMethod::automatic},
       {"direct", LinearMethod::direct},
       {"block", LinearMethod::block},
       {"condensed", LinearMethod::condensed}},
      {.doc = "direct: factors of the tangent; block: displacement and pressure, multigrid; condensed: multigrid on "
              "the tangent; auto: direct for few unknowns, then block"});
  s.read("reuse_limit", reuse_limit,
         {.range = {.min = 0, .max = 50},
          .doc = "a factorisation is used again while a solve takes at most this many iterations"});
  s.read("linear_tolerance", tolerance,
         {.range = {.min = 1e-14, .max = 1e-2}, .doc = "relative residual of a linear solve"});
}

LinearSolver::LinearSolver(const LinearConfig& config, Mat K, bool symmetric,
                           const std::function<const CellBlocks&(double gamma)>& cells, const Border* border)
    : config_(config) {
  check(KSPCreate(PETSC_COMM_WORLD, &solver_));
  check(KSPSetOperators(solver_, K, K));
  switch (chosen_method(config.method, K, static_cast<bool>(cells))) {
    case LinearMethod::block:
      create_block(K, cells(gamma_of_block));
      break;
    case LinearMethod::condensed:
      create_block(K, cells(std::numeric_limits<double>::infinity()));
      break;
    default:
      create_direct(symmetric);
  }
  ksp_ = solver_;
  if (border) create_bordered(K, *border);
}

void LinearSolver::create_direct(bool symmetric) {
  check(KSPSetType(solver_, KSPGMRES));
  check(KSPGMRESSetRestart(solver_, restart));
  // The tolerance is then one of forces, as Newton's is. In displacements, which the other side would measure, soft
  // modes hide what is left in stiff ones: slender or nearly incompressible bodies took seven times the Newton
  // iterations.
  check(KSPSetPCSide(solver_, PC_RIGHT));
  check(KSPSetTolerances(solver_, config_.tolerance, PETSC_DEFAULT, PETSC_DEFAULT, max_iterations));
  PC pc;
  check(KSPGetPC(solver_, &pc));
  check(PCSetType(pc, symmetric ? PCCHOLESKY : PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  set_default_option("mat_mumps_icntl_14", mumps_extra_memory);
  check_options(KSPSetFromOptions(solver_));
}

/// SNES sees one application of a preconditioner, which is a whole solve.
void LinearSolver::create_block(Mat K, const CellBlocks& cells) {
  check(MatSetOption(K, MAT_USE_INODES, PETSC_FALSE));  // twice as fast without
  block_ = std::make_unique<BlockSolver>(cells, K);
  check(KSPSetType(solver_, KSPPREONLY));
  check(KSPSetTolerances(solver_, config_.tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PC pc;
  check(KSPGetPC(solver_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, this));
  check(PCShellSetSetUp(pc, update_block));
  check(PCShellSetApply(pc, apply_block));
}

/// SNES sees one application of a preconditioner here too.
void LinearSolver::create_bordered(Mat K, const Border& border) {
  PetscReal tolerance;
  check_options(KSPSetFromOptions(solver_));  // SNES does it for the one that it sees
  check(KSPGetTolerances(solver_, &tolerance, nullptr, nullptr, nullptr));
  bordered_ = std::make_unique<BorderedSolver>(solver_, border);
  check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
  check(KSPSetOptionsPrefix(ksp_, "bordered_"));
  check(KSPSetOperators(ksp_, K, K));
  check(KSPSetType(ksp_, KSPPREONLY));
  check(KSPSetTolerances(ksp_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PC pc;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, this));
  check(PCShellSetApply(pc, apply_bordered));
}

LinearSolver::~LinearSolver() {
  if (ksp_ != solver_) KSPDestroy(&ksp_);
  KSPDestroy(&solver_);
}

PetscErrorCode LinearSolver::update_block(PC pc) {
  LinearSolver* self;
  check(PCShellGetContext(pc, &self));
  Timers::Scope timer("preconditioner");
  self->block_->update();
  return 0;
}

PetscErrorCode LinearSolver::apply_block(PC pc, Vec b, Vec x) {
  LinearSolver* self;
  check(PCShellGetContext(pc, &self));
  PetscReal tolerance;
  check(KSPGetTolerances(self->solver_, &tolerance, nullptr, nullptr, nullptr));
  self->block_failure_ = self->block_->solve(b, x, tolerance);
  self->largest_ = std::max(self->bordered_ ? self->largest_ : 0, self->block_->iterations());
  if (!self->reused_) self->fresh_iterations_ = self->largest_;
  self->total_ += self->block_->iterations();
  check(PCSetFailedReason(pc, self->block_failure_.empty() ? PC_NOERROR : PC_SUBPC_ERROR));
  return 0;
}

PetscErrorCode LinearSolver::apply_bordered(PC pc, Vec b, Vec x) {
  LinearSolver* self;
  check(PCShellGetContext(pc, &self));
  PetscReal tolerance;
  check(KSPGetTolerances(self->ksp_, &tolerance, nullptr, nullptr, nullptr));
  self->largest_ = 0;
  const bool solved = self->bordered_->solve(b, x, tolerance);
  check(PCSetFailedReason(pc, solved ? PC_NOERROR : PC_SUBPC_ERROR));
  return 0;
}

bool LinearSolver::matrix_changed() {
  if (bordered_) bordered_->matrix_changed();
  const int limit = block_ ? fresh_iterations_ + setup_in_iterations : config_.reuse_limit;
  reused_ = prepared_ && failure().empty() && iterations() <= limit;
  check(KSPSetReusePreconditioner(solver_, reused_ ? PETSC_TRUE : PETSC_FALSE));
  prepared_ = true;
  return reused_;
}

bool LinearSolver::forget_reused() {
  prepared_ = !reused_;
  return reused_;
}

void LinearSolver::forget() {
  prepared_ = false;
  if (block_) return block_->forget();
  PC pc;
  Mat K;
  check(KSPGetPC(solver_, &pc));
  check(KSPGetOperators(solver_, &K, nullptr));
  check(PetscObjectReference(reinterpret_cast<PetscObject>(K)));
  check(PCReset(pc));  // also the analysis: pivots of an unsymmetric matrix depend on its values
  check(KSPSetOperators(solver_, K, K));
  check(MatDestroy(&K));
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
  if (bordered_ && bordered_->singular())
    return "the tangent of a plate on a rail or of a link is singular: nothing resists its motion";
  check(KSPGetConvergedReason(solver_, &reason));
  if (block_ && !block_failure_.empty()) return block_failure_;
  if (reason == KSP_DIVERGED_PC_FAILED)
    return "the tangent could not be factorised (it is singular, or memory ran out)";
  if (reason == KSP_DIVERGED_NANORINF) return "the tangent holds numbers that are not finite";
  return "the linear solver did not converge";
}

int LinearSolver::iterations() const {
  if (block_) return largest_;
  if (bordered_) return bordered_->iterations();
  PetscInt its = 0;
  check(KSPGetIterationNumber(solver_, &its));
  return its;
}

int LinearSolver::take_iterations() {
  if (!block_) {
    PetscInt its = 0;
    check(KSPGetTotalIterations(solver_, &its));
    const int taken = static_cast<int>(its) - total_;
    total_ = static_cast<int>(its);
    return taken;
  }
  const int taken = total_;
  total_ = 0;
  return taken;
}

}  // namespace titin
