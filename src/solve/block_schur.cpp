#include "solve/block_schur.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "solve/block_amg.hpp"
#include "solve/block_small.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

constexpr double same_mass = 1e-6;  // relative change below which the Laplacian stays
constexpr int steps = 3;            // of conjugate gradients

}  // namespace

SchurInverse::SchurInverse(const CellBlocks& blocks, const Multigrid& multigrid, const Coupling& coupling)
    : blocks_(blocks), multigrid_(multigrid), coupling_(coupling) {}

SchurInverse::~SchurInverse() { destroy_laplacian(); }

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
    destroy_laplacian();
    mass_.clear();
    return;
  }
  bool same = mass_.size() == mass.size() && solver_;
  for (std::size_t i = 0; same && i < mass.size(); ++i) same = std::abs(mass[i] - mass_[i]) <= same_mass * mass[i];
  if (!any_of(!same)) return;
  mass_ = mass;
  create_laplacian(mass);
  invert_slopes(mass);
}

/// The rows of the means in B m^-1/2: [cell] x [dof].
Mat SchurInverse::scaled_divergence(const std::vector<double>& mass) const {
  const CellLayout& layout = blocks_.layout();
  const int n = layout.size();
  Mat T;
  check(MatCreate(PETSC_COMM_WORLD, &T));
  check(MatSetSizes(T, layout.cells, layout.owned_dofs, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(T, MATAIJ));
  const std::vector<PetscInt> length(layout.cells, std::min<PetscInt>(n, layout.owned_dofs)), other(layout.cells, n);
  check(MatXAIJSetPreallocation(T, 1, length.data(), other.data(), nullptr, nullptr));
  PetscInt row;
  check(MatGetOwnershipRange(T, &row, nullptr));
  std::vector<double> values(n);
  for (int cell = 0; cell < layout.cells; ++cell, ++row) {
    for (int c = 0; c < n; ++c) {
      const double inertia = mass[multigrid_.place(cell, c)];
      values[c] = inertia > 0 ? blocks_.B(cell)[c] / std::sqrt(inertia) : 0;
    }
    check(MatSetValues(T, 1, &row, n, &layout.dofs[std::size_t(cell) * n], values.data(), INSERT_VALUES));
  }
  check(MatAssemblyBegin(T, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(T, MAT_FINAL_ASSEMBLY));
  return T;
}

/// Of the means, with the part of S'^-1 that is theirs.
void SchurInverse::create_laplacian(const std::vector<double>& mass) {
  const CellLayout& layout = blocks_.layout();
  destroy_laplacian();
  Mat T = scaled_divergence(mass), transposed;
  check(MatTranspose(T, MAT_INITIAL_MATRIX, &transposed));
  check(MatMatMult(T, transposed, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &laplacian_));
  check(MatDestroy(&T));
  check(MatDestroy(&transposed));
  PetscInt row;
  check(MatGetOwnershipRange(laplacian_, &row, nullptr));
  for (int cell = 0; cell < layout.cells; ++cell, ++row)
    check(MatSetValue(laplacian_, row, row, blocks_.compliance(cell)[0], ADD_VALUES));
  check(MatAssemblyBegin(laplacian_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(laplacian_, MAT_FINAL_ASSEMBLY));
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

void SchurInverse::destroy_laplacian() {
  KSPDestroy(&solver_);
  MatDestroy(&laplacian_);
  VecDestroy(&right_);
  VecDestroy(&left_);
}

/// Of the other modes of each cell: the inverse of their own block of B m^-1 B^T + S'^-1.
void SchurInverse::invert_slopes(const std::vector<double>& mass) {
  const CellLayout& layout = blocks_.layout();
  const int n = layout.size(), m = layout.modes, slopes = m - 1;
  slopes_inverse_.resize(std::size_t(layout.cells) * slopes * slopes);
  std::vector<double> block(slopes * slopes);
  for (int cell = 0; cell < layout.cells; ++cell) {
    const double *B = blocks_.B(cell) + n, *compliance = blocks_.compliance(cell);
    for (int l = 0; l < slopes; ++l)
      for (int k = 0; k < slopes; ++k) {
        double sum = compliance[(l + 1) * m + k + 1];
        for (int c = 0; c < n; ++c) {
          const double inertia = mass[multigrid_.place(cell, c)];
          if (inertia > 0) sum += B[l * n + c] * B[k * n + c] / inertia;
        }
        block[l * slopes + k] = sum;
      }
    invert_small(slopes, block.data(), slopes_inverse_.data() + std::size_t(cell) * slopes * slopes);
  }
}

void SchurInverse::add(const double* r, double* p) {
  Timers::Scope timer("Schur complement");
  const int m = blocks_.layout().modes;
  for (int cell = 0; cell < blocks_.layout().cells; ++cell)
    add_multiply(m, blocks_.schur_inverse(cell), r + std::size_t(cell) * m, p + std::size_t(cell) * m);
  if (solver_) add_inertial(r, p);
}

/// Conjugate gradients: FGMRES does not mind that their result is no linear function of r.
void SchurInverse::add_inertial(const double* r, double* p) {
  const std::size_t size = blocks_.layout().mode_size.size();
  std::vector<double> left(r, r + size), z(size), direction(size, 0.0), product(size);
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return sum(std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
  };
  double before = 0;
  for (int k = 0; k < steps; ++k) {
    precondition(left, z);
    const double now = dot(left, z), keep = k > 0 ? now / before : 0;
    before = now;
    for (std::size_t i = 0; i < size; ++i) direction[i] = z[i] + keep * direction[i];
    multiply(direction, product);
    const double curvature = dot(direction, product);
    if (!(now > 0 && curvature > 0)) return;
    for (std::size_t i = 0; i < size; ++i) {
      p[i] += now / curvature * direction[i];
      left[i] -= now / curvature * product[i];
    }
  }
}

/// y = (B m^-1 B^T + S'^-1) p
void SchurInverse::multiply(const std::vector<double>& p, std::vector<double>& y) {
  const CellLayout& layout = blocks_.layout();
  const int m = layout.modes;
  const LocalDofs& dofs = multigrid_.dofs();
  forces_.assign(dofs.size(), 0.0);
  for (int cell = 0; cell < layout.cells; ++cell)
    coupling_.add_gradient(cell, &p[std::size_t(cell) * m], forces_.data());
  dofs.add(forces_.data());
  for (int i = 0; i < dofs.owned(); ++i) forces_[i] = mass_[i] > 0 ? forces_[i] / mass_[i] : 0;
  dofs.fetch(forces_.data());
  for (int cell = 0; cell < layout.cells; ++cell) {
    const std::size_t first = std::size_t(cell) * m;
    coupling_.divergence(cell, forces_.data(), &y[first]);
    add_multiply(m, blocks_.compliance(cell), &p[first], &y[first]);
  }
}

/// z: means by BoomerAMG, the rest by the cell's block.
void SchurInverse::precondition(const std::vector<double>& r, std::vector<double>& z) {
  const CellLayout& layout = blocks_.layout();
  const int m = layout.modes, slopes = m - 1;
  PetscScalar* means;
  check(VecGetArray(right_, &means));
  for (int cell = 0; cell < layout.cells; ++cell) means[cell] = r[std::size_t(cell) * m];
  check(VecRestoreArray(right_, &means));
  check(KSPSolve(solver_, right_, left_));
  const PetscScalar* solution;
  check(VecGetArrayRead(left_, &solution));
  std::fill(z.begin(), z.end(), 0.0);
  for (int cell = 0; cell < layout.cells; ++cell) {
    const std::size_t first = std::size_t(cell) * m;
    z[first] = solution[cell];
    add_multiply(slopes, slopes_inverse_.data() + std::size_t(cell) * slopes * slopes, r.data() + first + 1,
                 z.data() + first + 1);
  }
  check(VecRestoreArrayRead(left_, &solution));
}

}  // namespace titin
