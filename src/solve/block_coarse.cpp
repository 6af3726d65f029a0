#include "solve/block_coarse.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "solve/block_amg.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

/// Of conjugate gradients, relative: less saves no iterations around them that would be worth it. Stretched cells want
/// the coarse problem solved better.
constexpr double tolerance_compact = 0.3, tolerance_elongated = 0.1;
constexpr double elongated = 2.5;
constexpr int most_steps = 30;
constexpr double at_corner = 1 - 1e-9;  // the hat of a corner, there

}  // namespace

CoarseLevel::CoarseLevel(const CellBlocks& blocks, const LocalDofs& dofs) : blocks_(blocks), owned_(dofs.owned()) {
  number();
  set_weights();
  create_prolongation(dofs);
  create_matrix();
  create_solver();
}

CoarseLevel::~CoarseLevel() {
  KSPDestroy(&solver_);
  MatDestroy(&A_);
  MatDestroy(&P_);
  for (Vec* v : {&fine_, &right_, &left_}) VecDestroy(v);
}

/// A coarse dof is constrained where the displacement of its vertex is.
void CoarseLevel::number() {
  const CellLayout& layout = blocks_.layout();
  const int components = layout.components;
  for (int cell = 0; cell < layout.cells; ++cell)
    for (int i = 0; i < components; ++i)
      for (int v = 0; v < layout.corners; ++v) {
        int node = 0;
        while (layout.hat[node * layout.corners + v] < at_corner) ++node;
        const bool fixed = layout.dofs[(std::size_t(cell) * components + i) * layout.nodes + node] < 0;
        const PetscInt dof = components * layout.corner[std::size_t(cell) * layout.corners + v] + i;
        dofs_.push_back(fixed ? -1 : dof);
      }
}

/// What P is in every cell.
void CoarseLevel::set_weights() {
  const CellLayout& layout = blocks_.layout();
  for (int c = 0; c < layout.size(); ++c)
    for (int v = 0; v < layout.corners; ++v) {
      const auto value = static_cast<float>(layout.hat[(c % layout.nodes) * layout.corners + v]);
      if (value != 0) weights_.push_back({c, (c / layout.nodes) * layout.corners + v, value});
    }
  const std::size_t m = layout.components * layout.corners;
  half_.resize(layout.size() * m);
  coarse_.resize(m * m);
}

void CoarseLevel::create_prolongation(const LocalDofs& dofs) {
  const CellLayout& layout = blocks_.layout();
  const PetscInt coarse = layout.components * layout.owned_corners;
  check(MatCreate(PETSC_COMM_WORLD, &P_));
  check(MatSetSizes(P_, owned_, coarse, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(P_, MATAIJ));
  check(MatSetOptionsPrefix(P_, "coarse_"));
  check(MatXAIJSetPreallocation(P_, 1, std::vector<PetscInt>(owned_, std::min<PetscInt>(layout.corners, coarse)).data(),
                                std::vector<PetscInt>(owned_, layout.corners).data(), nullptr, nullptr));
  std::vector<char> done(owned_, 0);
  for (int cell = 0; cell < layout.cells; ++cell)
    for (int c = 0; c < layout.size(); ++c) {
      const PetscInt dof = layout.dofs[std::size_t(cell) * layout.size() + c];
      const int local = dofs.local(dof);
      if (local >= owned_ || done[local]) continue;
      done[local] = 1;
      const int i = c / layout.nodes, node = c % layout.nodes;
      for (int v = 0; v < layout.corners; ++v) {
        const double weight = layout.hat[node * layout.corners + v];
        const PetscInt column = dofs_[(std::size_t(cell) * layout.components + i) * layout.corners + v];
        if (weight != 0 && column >= 0) check(MatSetValue(P_, dof, column, weight, INSERT_VALUES));
      }
    }
  check(MatAssemblyBegin(P_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(P_, MAT_FINAL_ASSEMBLY));
  check(MatCreateVecs(P_, &right_, &fine_));
  check(VecDuplicate(right_, &left_));
}

/// The pattern comes from a first assembly into a matrix that only counts.
void CoarseLevel::create_matrix() {
  const CellLayout& layout = blocks_.layout();
  const PetscInt n = layout.components * layout.owned_corners;
  const auto create = [&](MatType type) {
    Mat A;
    check(MatCreate(PETSC_COMM_WORLD, &A));
    check(MatSetSizes(A, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetBlockSize(A, layout.components));
    check(MatSetType(A, type));
    return A;
  };
  Mat pattern = create(MATPREALLOCATOR);
  check(MatSetUp(pattern));
  const std::vector<double> zeros(std::size_t(layout.components * layout.corners) * layout.components * layout.corners);
  for (int cell = 0; cell < layout.cells; ++cell) add_cell(cell, zeros, pattern);
  finish(pattern);
  A_ = create(MATAIJ);
  check(MatPreallocatorPreallocate(pattern, PETSC_TRUE, A_));
  check(MatDestroy(&pattern));
  check(MatSetOption(A_, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(A_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  check(MatGetSize(A_, &size_, nullptr));
  attach_rigid_motions();
}

/// What AMG may use to interpolate: translations and small rotations, zero where a dof is constrained.
void CoarseLevel::attach_rigid_motions() {
  const CellLayout& layout = blocks_.layout();
  Vec position;
  check(MatCreateVecs(A_, &position, nullptr));
  PetscScalar* x;
  check(VecGetArray(position, &x));
  std::copy(layout.position.begin(), layout.position.end(), x);
  check(VecRestoreArray(position, &x));
  MatNullSpace motions;
  check(MatNullSpaceCreateRigidBody(position, &motions));
  check(MatSetNearNullSpace(A_, motions));
  check(MatNullSpaceDestroy(&motions));
  check(VecDestroy(&position));
}

void CoarseLevel::create_solver() {
  check(KSPCreate(PETSC_COMM_WORLD, &solver_));
  check(KSPSetOptionsPrefix(solver_, "coarse_"));
  check(KSPSetOperators(solver_, A_, A_));
  PC pc;
  check(KSPGetPC(solver_, &pc));
  if (size_ <= largest_direct) {
    check(KSPSetType(solver_, KSPPREONLY));
    check(PCSetType(pc, PCCHOLESKY));
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  } else {
    check(KSPSetType(solver_, KSPCG));
    check(KSPSetNormType(solver_, KSP_NORM_NATURAL));
    const double tolerance = max(blocks_.layout().elongation) > elongated ? tolerance_elongated : tolerance_compact;
    check(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_steps));
    set_boomeramg(pc, "coarse_");
  }
  check_options(KSPSetFromOptions(solver_));
}

void CoarseLevel::update() {
  Timers::Scope timer("coarse level");
  check(MatZeroEntries(A_));
  for (int batch = 0; batch < blocks_.batches(); ++batch) add_batch(batch, A_);
  finish(A_);
  check(KSPSetOperators(solver_, A_, A_));
  check(KSPSetUp(solver_));
}

/// Ones for the constrained, then the exchange.
void CoarseLevel::finish(Mat A) const {
  const CellLayout& layout = blocks_.layout();
  const int n = layout.components * layout.corners;
  std::vector<char> free(layout.components * layout.owned_corners, 0);
  PetscInt first;
  check(MatGetOwnershipRange(A, &first, nullptr));
  for (std::size_t c = 0; c < std::size_t(layout.cells) * n; ++c)
    if (dofs_[c] >= first && dofs_[c] < first + static_cast<PetscInt>(free.size())) free[dofs_[c] - first] = 1;
  for (std::size_t dof = 0; dof < free.size(); ++dof) {
    const PetscInt row = first + static_cast<PetscInt>(dof);
    if (!free[dof]) check(MatSetValue(A, row, row, 1, ADD_VALUES));
  }
  check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
}

/// Adds P^T A_g P of eight cells.
void CoarseLevel::add_batch(int batch, Mat A) {
  const CellLayout& layout = blocks_.layout();
  const int n = layout.size(), m = layout.components * layout.corners;
  const FloatLanes* fine = blocks_.matrices(batch);
  std::fill(half_.begin(), half_.end(), FloatLanes{});
  std::fill(coarse_.begin(), coarse_.end(), FloatLanes{});
  for (int i = 0; i < n; ++i)
    for (const Weight& w : weights_) half_[i * m + w.to] += w.value * fine[packed_index(i, w.from)];
  for (const Weight& w : weights_)
    for (int k = 0; k < m; ++k) coarse_[w.to * m + k] += w.value * half_[w.from * m + k];
  std::vector<double> values(m * m);
  for (int lane = 0; lane < float_lanes && batch * float_lanes + lane < layout.cells; ++lane) {
    for (int e = 0; e < m * m; ++e) values[e] = coarse_[e][lane];
    add_cell(batch * float_lanes + lane, values, A);
  }
}

void CoarseLevel::add_cell(int cell, const std::vector<double>& values, Mat A) const {
  const int m = blocks_.layout().components * blocks_.layout().corners;
  const PetscInt* dofs = &dofs_[std::size_t(cell) * m];
  check(MatSetValues(A, m, dofs, m, dofs, values.data(), ADD_VALUES));
}

bool CoarseLevel::correct(const float* r, float* x) {
  Timers::Scope timer("coarse level");
  PetscScalar* values;
  check(VecGetArray(fine_, &values));
  std::copy_n(r, owned_, values);
  check(VecRestoreArray(fine_, &values));
  check(MatMultTranspose(P_, fine_, right_));
  check(KSPSolve(solver_, right_, left_));
  check(MatMult(P_, left_, fine_));
  const PetscScalar* correction;
  check(VecGetArrayRead(fine_, &correction));
  for (int i = 0; i < owned_; ++i) x[i] += static_cast<float>(correction[i]);
  check(VecRestoreArrayRead(fine_, &correction));
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(solver_, &reason));
  // an indefinite coarse problem stops conjugate gradients early, with a correction that is still of use
  return reason >= 0 || reason == KSP_DIVERGED_ITS || reason == KSP_DIVERGED_INDEFINITE_MAT ||
         reason == KSP_DIVERGED_INDEFINITE_PC;
}

}  // namespace titin
