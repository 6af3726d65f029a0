#include "solve/bordered.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace titin {

namespace {

/// What is asked of the columns: their errors, times unknowns that may be large, are left to the refinement.
constexpr double column_tolerance = 1e-5;
/// Solves for what the first left; each gains about what a solve with K gains.
constexpr int most_rounds = 4;

Vec view(const mfem::Vector& v) {
  Vec vec;
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, v.Size(), PETSC_DECIDE, v.GetData(), &vec));
  return vec;
}

}  // namespace

BorderedSolver::BorderedSolver(KSP solver, const Border& border) : solver_(solver), border_(border) {
  Mat K;
  check(KSPGetOperators(solver, &K, nullptr));
  check(MatCreateVecs(K, &b_, &residual_));
  check(VecDuplicate(b_, &z_));
  for (int j = 0; j < border.size(); ++j) {
    columns_.push_back(view(border.columns[j]));
    rows_.push_back(view(border.rows[j]));
    W_.push_back(nullptr);
    check(VecDuplicate(b_, &W_.back()));
  }
}

BorderedSolver::~BorderedSolver() {
  for (auto* list : {&columns_, &rows_, &W_})
    for (Vec& v : *list) VecDestroy(&v);
  for (Vec* v : {&b_, &residual_, &z_}) VecDestroy(v);
}

bool BorderedSolver::inner(Vec b, Vec x, double tolerance) {
  check(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  check(KSPSolve(solver_, b, x));
  KSPConvergedReason reason;
  PetscInt iterations;
  check(KSPGetConvergedReason(solver_, &reason));
  check(KSPGetIterationNumber(solver_, &iterations));
  iterations_ = std::max(iterations_, static_cast<int>(iterations));
  return reason >= 0;
}

bool BorderedSolver::solve_columns(double tolerance) {
  const int n = border_.size();
  schur_ = border_.corner;
  for (int j = 0; j < n; ++j) {
    if (!inner(columns_[j], W_[j], tolerance)) return false;
    for (int i = 0; i < n; ++i) {
      PetscScalar product;
      check(VecDot(rows_[i], W_[j], &product));
      schur_(i, j) -= product;
    }
  }
  columns_known_ = true;
  return true;
}

/// c, which b then holds no longer.
std::vector<double> BorderedSolver::take_carried(Vec b) const {
  PetscScalar* values;
  std::vector<double> c(border_.size(), 0.0);
  check(VecGetArray(b, &values));
  for (int j = 0; j < border_.size(); ++j) {
    const int carrier = border_.unknowns[j].carrier;
    if (carrier < 0) continue;
    c[j] = values[carrier];
    values[carrier] = 0;
  }
  check(VecRestoreArray(b, &values));
  sum(c);
  return c;
}

/// q = (D - R W)^-1 (c - R z); false when that is not finite.
bool BorderedSolver::eliminate(const std::vector<double>& c, Vec z, mfem::Vector& q) {
  const int n = border_.size();
  mfem::Vector d(n);
  for (int i = 0; i < n; ++i) {
    PetscScalar product;
    check(VecDot(rows_[i], z, &product));
    d(i) = c[i] - product;
  }
  mfem::DenseMatrixInverse inverse(schur_);
  inverse.Mult(d, q);
  singular_ = !std::all_of(q.begin(), q.end(), [](double value) { return std::isfinite(value); });
  return !singular_;
}

void BorderedSolver::spread(const mfem::Vector& q, Vec x) const {
  PetscScalar* values;
  check(VecGetArray(x, &values));
  for (int j = 0; j < border_.size(); ++j)
    for (int dof : border_.unknowns[j].dofs) values[dof] = q(j);
  check(VecRestoreArray(x, &values));
}

bool BorderedSolver::solve(Vec right, Vec x, double tolerance) {
  const int n = border_.size();
  iterations_ = 0;
  singular_ = false;
  if (!columns_known_ && !solve_columns(std::min(tolerance, column_tolerance))) return false;
  Mat K;
  PetscReal wanted, norm = PETSC_INFINITY;
  mfem::Vector q(n), dq(n);
  q = 0.0;
  check(KSPGetOperators(solver_, &K, nullptr));
  check(VecNorm(right, NORM_2, &wanted));
  wanted *= tolerance;
  check(VecCopy(right, b_));
  std::vector<double> c = take_carried(b_);
  check(VecCopy(b_, residual_));
  check(VecSet(x, 0));
  for (int round = 0; round < most_rounds && norm > wanted; ++round) {
    if (!inner(residual_, z_, tolerance) || !eliminate(c, z_, dq)) return false;
    check(VecAXPY(x, 1, z_));
    for (int j = 0; j < n; ++j) check(VecAXPY(x, -dq(j), W_[j]));
    q += dq;
    std::fill(c.begin(), c.end(), 0.0);  // the last equations hold to round-off
    check(MatMult(K, x, residual_));
    check(VecAYPX(residual_, -1, b_));
    for (int j = 0; j < n; ++j) check(VecAXPY(residual_, -q(j), columns_[j]));
    check(VecNorm(residual_, NORM_2, &norm));
  }
  spread(q, x);
  return true;
}

}  // namespace titin
