#include "solve/block_schur.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "solve/block_amg.hpp"
#include "solve/block_small.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

constexpr double same_mass = 1e-6;  // relative change below which the Laplacian stays

}  // namespace

SchurInverse::SchurInverse(const CellBlocks& blocks, const Multigrid& multigrid)
    : blocks_(blocks), multigrid_(multigrid) {}

SchurInverse::~SchurInverse() {
  KSPDestroy(&solver_);
  MatDestroy(&laplacian_);
  VecDestroy(&right_);
  VecDestroy(&left_);
}

/// Sums the cells' masses at local dofs; false when there are none.
bool SchurInverse::lump(std::vector<double>& mass) const {
  const CellLayout& layout = blocks_.layout();
  mass.assign(multigrid_.dofs().size(), 0.0);
  for (int cell = 0; cell < layout.cells; ++cell)
    for (int c = 0; c < layout.size(); ++c) mass[multigrid_.place(cell, c)] += blocks_.inertia(cell)[c % layout.nodes];
  multigrid_.dofs().add(mass.data());
  multigrid_.dofs().fetch(mass.data());
  return any_of(std::any_of(mass.begin(), mass.end(), [](double m) { return m > 0; }));
}

void SchurInverse::update() {
  Timers::Scope timer("Schur complement");
  std::vector<double> mass;
  if (!lump(mass)) {
    KSPDestroy(&solver_);
    mass_.clear();
    return;
  }
  bool same = mass_.size() == mass.size() && solver_;
  for (std::size_t i = 0; same && i < mass.size(); ++i) same = std::abs(mass[i] - mass_[i]) <= same_mass * mass[i];
  if (!any_of(!same)) return;
  mass_ = mass;
  create_laplacian(mass);
}

/// B m^-1/2 with the modes' sizes taken out: [cell, mode] x [dof].
Mat SchurInverse::scaled_divergence(const std::vector<double>& mass) const {
  const CellLayout& layout = blocks_.layout();
  const int n = layout.size(), m = layout.modes;
  const PetscInt rows = layout.cells * m;
  Mat T;
  check(MatCreate(PETSC_COMM_WORLD, &T));
  check(MatSetSizes(T, rows, layout.owned_dofs, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(T, MATAIJ));
  const std::vector<PetscInt> length(rows, std::min<PetscInt>(n, layout.owned_dofs)), other(rows, n);
  check(MatXAIJSetPreallocation(T, 1, length.data(), other.data(), nullptr, nullptr));
  PetscInt row;
  check(MatGetOwnershipRange(T, &row, nullptr));
  std::vector<double> values(n);
  for (int cell = 0; cell < layout.cells; ++cell)
    for (int l = 0; l < m; ++l, ++row) {
      for (int c = 0; c < n; ++c) {
        const double inertia = mass[multigrid_.place(cell, c)];
        const double size = layout.mode_size[std::size_t(cell) * m + l];
        values[c] = inertia > 0 ? blocks_.B(cell)[l * n + c] / (size * std::sqrt(inertia)) : 0;
      }
      check(MatSetValues(T, 1, &row, n, &layout.dofs[std::size_t(cell) * n], values.data(), INSERT_VALUES));
    }
  check(MatAssemblyBegin(T, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(T, MAT_FINAL_ASSEMBLY));
  return T;
}

void SchurInverse::create_laplacian(const std::vector<double>& mass) {
  KSPDestroy(&solver_);
  MatDestroy(&laplacian_);
  VecDestroy(&right_);
  VecDestroy(&left_);
  Mat T = scaled_divergence(mass), transposed;
  check(MatTranspose(T, MAT_INITIAL_MATRIX, &transposed));
  check(MatMatMult(T, transposed, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &laplacian_));
  check(MatDestroy(&T));
  check(MatDestroy(&transposed));
  add_compliance();
  check(MatSetOption(laplacian_, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatCreateVecs(laplacian_, &right_, &left_));
  check(KSPCreate(PETSC_COMM_WORLD, &solver_));
  check(KSPSetOptionsPrefix(solver_, "inertia_"));
  check(KSPSetType(solver_, KSPPREONLY));
  check(KSPSetOperators(solver_, laplacian_, laplacian_));
  PC pc;
  check(KSPGetPC(solver_, &pc));
  set_boomeramg(pc, "inertia_");
  check_options(KSPSetFromOptions(solver_));
  check(KSPSetUp(solver_));
}

/// Adds S'^-1: M / kappa, and what the augmentation leaves of it.
void SchurInverse::add_compliance() {
  const CellLayout& layout = blocks_.layout();
  const int m = layout.modes;
  PetscInt row;
  check(MatGetOwnershipRange(laplacian_, &row, nullptr));
  std::vector<double> values(m * m);
  std::vector<PetscInt> rows(m);
  for (int cell = 0; cell < layout.cells; ++cell) {
    const double* size = &layout.mode_size[std::size_t(cell) * m];
    for (int l = 0; l < m; ++l) {
      rows[l] = row++;
      for (int k = 0; k < m; ++k) values[l * m + k] = blocks_.compliance(cell)[l * m + k] / (size[l] * size[k]);
    }
    check(MatSetValues(laplacian_, m, rows.data(), m, rows.data(), values.data(), ADD_VALUES));
  }
  check(MatAssemblyBegin(laplacian_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(laplacian_, MAT_FINAL_ASSEMBLY));
}

void SchurInverse::add(const double* r, double* p) {
  Timers::Scope timer("Schur complement");
  const CellLayout& layout = blocks_.layout();
  const int m = layout.modes;
  for (int cell = 0; cell < layout.cells; ++cell)
    add_multiply(m, blocks_.schur_inverse(cell), r + std::size_t(cell) * m, p + std::size_t(cell) * m);
  if (!solver_) return;
  PetscScalar* values;
  check(VecGetArray(right_, &values));
  for (std::size_t l = 0; l < layout.mode_size.size(); ++l) values[l] = r[l] / layout.mode_size[l];
  check(VecRestoreArray(right_, &values));
  check(KSPSolve(solver_, right_, left_));
  const PetscScalar* solution;
  check(VecGetArrayRead(left_, &solution));
  for (std::size_t l = 0; l < layout.mode_size.size(); ++l) p[l] += solution[l] / layout.mode_size[l];
  check(VecRestoreArrayRead(left_, &solution));
}

}  // namespace titin
