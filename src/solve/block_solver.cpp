#include "solve/block_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/timers.hpp"
#include "solve/block_small.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

constexpr int restart = 50, max_iterations = 100;
/// A solve that ran out of iterations still gives Newton's method a direction if it got so far.
constexpr double good_enough = 0.1;

/// Round-off holds the residual of forces where it stays while FGMRES's own norm falls: no more can be had.
constexpr double still_falls = 0.5, much_less = 0.1;

class ReadArray {
 public:
  explicit ReadArray(Vec v) : vec_(v) { check(VecGetArrayRead(v, &data_)); }
  ~ReadArray() { VecRestoreArrayRead(vec_, &data_); }
  const double* data() const { return data_; }

 private:
  Vec vec_;
  const PetscScalar* data_ = nullptr;
};

class WriteArray {
 public:
  explicit WriteArray(Vec v) : vec_(v) { check(VecGetArray(v, &data_)); }
  ~WriteArray() { VecRestoreArray(vec_, &data_); }
  double* data() const { return data_; }

 private:
  Vec vec_;
  PetscScalar* data_ = nullptr;
};

}  // namespace

BlockSolver::BlockSolver(const CellBlocks& blocks, Mat K) : blocks_(blocks), K_(K) {
  const CellLayout& layout = blocks.layout();
  displacements_ = static_cast<int>(layout.owned_dofs);
  pressures_ = blocks.has_pressure() ? layout.cells * layout.modes : 0;
  const PetscInt size = displacements_ + pressures_;
  check(MatCreateShell(PETSC_COMM_WORLD, size, size, PETSC_DETERMINE, PETSC_DETERMINE, this, &system_));
  check(MatShellSetOperation(system_, MATOP_MULT,
                             reinterpret_cast<void (*)()>(static_cast<PetscErrorCode (*)(Mat, Vec, Vec)>(multiply))));
  check(MatCreateVecs(system_, &right_, &left_));
  check(VecDuplicate(right_, &work_));
  check(VecDuplicate(right_, &residual_vector_));
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, displacements_, PETSC_DETERMINE, nullptr, &in_));
  check(VecDuplicate(in_, &out_));
  check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
  check(KSPSetOptionsPrefix(ksp_, "block_"));
  check(KSPSetOperators(ksp_, system_, system_));
  check(KSPSetType(ksp_, KSPFGMRES));
  check(KSPGMRESSetRestart(ksp_, restart));
  check(KSPSetTolerances(ksp_, 0, 0, PETSC_DEFAULT, max_iterations));
  check(KSPSetConvergenceTest(ksp_, test, this, nullptr));
  PC pc;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, this));
  check(PCShellSetApply(pc, precondition));
  check_options(KSPSetFromOptions(ksp_));
}

BlockSolver::~BlockSolver() {
  KSPDestroy(&ksp_);
  MatDestroy(&system_);
  for (Vec* v : {&in_, &out_, &right_, &left_, &work_, &residual_vector_}) VecDestroy(v);
}

void BlockSolver::update() {
  if (!multigrid_) {
    multigrid_ = std::make_unique<Multigrid>(blocks_);
    coupling_ = std::make_unique<Coupling>(blocks_, *multigrid_);
    schur_ = std::make_unique<SchurInverse>(blocks_, *multigrid_, *coupling_);
    local_.assign(multigrid_->dofs().size(), 0.0);
    forces_.assign(multigrid_->dofs().size(), 0.0);
  }
  multigrid_->update();
  if (pressures_ > 0) schur_->update();
}

/// What A_g has more than K, and the couplings: y_u += B^T (p - S' B x), y_p = scale (B x - S'^-1 p).
void BlockSolver::add_coupling(const double* x, double* y) {
  if (pressures_ == 0) return;
  const LocalDofs& dofs = multigrid_->dofs();
  const int m = blocks_.layout().modes;
  std::copy_n(x, displacements_, local_.begin());
  dofs.fetch(local_.data());
  std::fill(forces_.begin(), forces_.end(), 0.0);
  std::vector<double> t(m), p(m), load(m), compressed(m);
  for (int cell = 0; cell < blocks_.layout().cells; ++cell) {
    const double *scale = blocks_.pressure_scale(cell), *q = x + displacements_ + std::size_t(cell) * m;
    coupling_->divergence(cell, local_.data(), t.data());
    std::fill(load.begin(), load.end(), 0.0);
    std::fill(compressed.begin(), compressed.end(), 0.0);
    for (int l = 0; l < m; ++l) p[l] = scale[l] * q[l];
    add_multiply(m, blocks_.stiffness(cell), t.data(), load.data());
    add_multiply(m, blocks_.compliance(cell), p.data(), compressed.data());
    for (int l = 0; l < m; ++l) load[l] = p[l] - load[l];
    coupling_->add_gradient(cell, load.data(), forces_.data());
    for (int l = 0; l < m; ++l) y[displacements_ + std::size_t(cell) * m + l] = scale[l] * (t[l] - compressed[l]);
  }
  dofs.add(forces_.data());
  for (int i = 0; i < displacements_; ++i) y[i] += forces_[i];
}

PetscErrorCode BlockSolver::multiply(Mat A, Vec x, Vec y) {
  BlockSolver* self;
  check(MatShellGetContext(A, &self));
  const ReadArray in(x);
  const WriteArray out(y);
  {
    Timers::Scope timer("tangent times vector");
    check(VecPlaceArray(self->in_, in.data()));
    check(VecPlaceArray(self->out_, out.data()));
    check(MatMult(self->K_, self->in_, self->out_));
    check(VecResetArray(self->in_));
    check(VecResetArray(self->out_));
  }
  self->add_coupling(in.data(), out.data());
  return 0;
}

PetscErrorCode BlockSolver::precondition(PC pc, Vec r, Vec z) {
  BlockSolver* self;
  check(PCShellGetContext(pc, &self));
  const ReadArray in(r);
  const WriteArray out(z);
  if (!self->precondition(in.data(), out.data())) check(PCSetFailedReason(pc, PC_SUBPC_ERROR));
  return 0;
}

/// z_p = -S^-1 r_p, z_u = A_g^-1 (r_u - B^T z_p). False when the coarse solver failed.
bool BlockSolver::precondition(const double* r, double* z) {
  if (pressures_ == 0) return multigrid_->apply(r, z);
  const int m = blocks_.layout().modes, cells = blocks_.layout().cells;
  std::vector<double> divergence(pressures_), p(pressures_, 0.0);
  for (int l = 0; l < pressures_; ++l) divergence[l] = -r[displacements_ + l] / blocks_.pressure_scale(0)[l];
  schur_->add(divergence.data(), p.data());
  std::fill(forces_.begin(), forces_.end(), 0.0);
  for (int cell = 0; cell < cells; ++cell) coupling_->add_gradient(cell, &p[std::size_t(cell) * m], forces_.data());
  multigrid_->dofs().add(forces_.data());
  for (int i = 0; i < displacements_; ++i) forces_[i] = r[i] - forces_[i];
  for (int l = 0; l < pressures_; ++l) z[displacements_ + l] = p[l] / blocks_.pressure_scale(0)[l];
  return multigrid_->apply(forces_.data(), z);
}

/// |r_u + B^T S' r_p|
double BlockSolver::condensed_residual(Vec residual) {
  const ReadArray r(residual);
  const int m = blocks_.layout().modes;
  std::fill(forces_.begin(), forces_.end(), 0.0);
  std::vector<double> divergence(m), p(m);
  for (int cell = 0; cell < blocks_.layout().cells && pressures_ > 0; ++cell) {
    const double *scale = blocks_.pressure_scale(cell), *r_p = r.data() + displacements_ + std::size_t(cell) * m;
    for (int l = 0; l < m; ++l) divergence[l] = r_p[l] / scale[l];
    std::fill(p.begin(), p.end(), 0.0);
    add_multiply(m, blocks_.stiffness(cell), divergence.data(), p.data());
    coupling_->add_gradient(cell, p.data(), forces_.data());
  }
  multigrid_->dofs().add(forces_.data());
  for (int i = 0; i < displacements_; ++i) forces_[i] += r.data()[i];
  check(VecPlaceArray(out_, forces_.data()));
  PetscReal norm;
  check(VecNorm(out_, NORM_2, &norm));
  check(VecResetArray(out_));
  return norm;
}

PetscErrorCode BlockSolver::test(KSP ksp, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason,
                                 void* context) {
  auto* self = static_cast<BlockSolver*>(context);
  *reason = KSP_CONVERGED_ITERATING;
  if (std::isnan(norm) || std::isinf(norm)) {
    *reason = KSP_DIVERGED_NANORINF;
    return 0;
  }
  if (iteration == 0) {
    self->size_of_b_ = norm;
    self->residual_ = 1;
    self->best_ = self->norm_at_best_ = PETSC_INFINITY;
    self->next_test_ = self->tolerance_ * norm;
    if (norm == 0) *reason = KSP_CONVERGED_ATOL;
    return 0;
  }
  if (norm > self->next_test_) return 0;
  Vec residual;  // costs a product with the matrix
  check(KSPBuildResidual(ksp, self->work_, self->residual_vector_, &residual));
  const double condensed = self->condensed_residual(residual), wanted = self->tolerance_ * self->size_of_b_;
  self->residual_ = condensed / self->size_of_b_;
  self->next_test_ = norm * std::min(1.0, wanted / condensed);
  const bool at_round_off = condensed > still_falls * self->best_ && norm < much_less * self->norm_at_best_;
  if (condensed <= wanted || at_round_off) *reason = KSP_CONVERGED_RTOL;
  if (condensed > still_falls * self->best_) return 0;
  self->best_ = condensed;
  self->norm_at_best_ = norm;
  return 0;
}

std::string BlockSolver::solve(Vec b, Vec x, double tolerance) {
  tolerance_ = tolerance;
  {
    const WriteArray right(right_);
    const ReadArray given(b);
    std::fill_n(std::copy_n(given.data(), displacements_, right.data()), pressures_, 0.0);
  }
  check(KSPSolve(ksp_, right_, left_));
  const ReadArray left(left_);
  std::copy_n(left.data(), displacements_, WriteArray(x).data());
  KSPConvergedReason reason;
  PetscInt its;
  check(KSPGetConvergedReason(ksp_, &reason));
  check(KSPGetIterationNumber(ksp_, &its));
  iterations_ = static_cast<int>(its);
  if (reason >= 0 || (reason == KSP_DIVERGED_ITS && residual_ <= good_enough)) return "";
  if (reason == KSP_DIVERGED_NANORINF) return "the tangent holds numbers that are not finite";
  return fmt::format("the block solver left {:.1e} of the residual after {} iterations", residual_, iterations_);
}

std::size_t BlockSolver::bytes() const {
  const std::size_t vectors = (2 * iterations_ + 6) * std::size_t(displacements_ + pressures_) * sizeof(double);
  return blocks_.bytes() + (multigrid_ ? multigrid_->bytes() : 0) + vectors +
         (local_.capacity() + forces_.capacity()) * sizeof(double);
}

}  // namespace titin
