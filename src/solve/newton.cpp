#include "solve/newton.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "solve/petsc_options.hpp"

namespace titin {

namespace {

constexpr int max_backtracks = 8;  // smallest trial step: 2^-8 of Newton's
constexpr double armijo = 1e-4;    // asked decrease of |R|, as usual (Nocedal, Wright 2006, section 3.1)
constexpr double still = 1e-12;    // an increment below this part of u changes its round-off only: no more can be had
constexpr double smallest_cut = 0.1, largest_cut = 0.5;  // of a step length that failed

/// MFEM's view of this rank's part of a PETSc vector; no copy.
class ReadView {
 public:
  explicit ReadView(Vec v) : vec_(v) {
    PetscInt n;
    check(VecGetLocalSize(v, &n));
    check(VecGetArrayRead(v, &data_));
    view_.SetDataAndSize(const_cast<double*>(data_), n);
  }
  ~ReadView() { VecRestoreArrayRead(vec_, &data_); }
  const mfem::Vector& operator*() const { return view_; }

 private:
  Vec vec_;
  const PetscScalar* data_ = nullptr;
  mfem::Vector view_;
};

void assign(const mfem::Vector& from, Vec to) {
  PetscScalar* data;
  check(VecGetArray(to, &data));
  std::copy(from.begin(), from.end(), data);
  check(VecRestoreArray(to, &data));
}

}  // namespace

void NewtonConfig::bind(Section& s) {
  s.read(
      "tolerance", tolerance,
      {.range = {.min = 1e-14, .max = 1e-1}, .doc = "residual force over the sum of the cells' absolute nodal forces"});
  s.read("increment_tolerance", increment_tolerance,
         {.range = {.min = 0, .max = 1},
          .doc = "asked besides: last increment over the change of the displacement in the step; 0: not asked"});
  s.read("energy_tolerance", energy_tolerance,
         {.range = {.min = 0, .max = 1},
          .doc = "asked besides: work of the residual on the last increment over that on the first; 0: not asked"});
  s.choose(
      "globalisation", globalisation,
      {{"line_search", Globalisation::line_search}, {"trust_region", Globalisation::trust_region}},
      {.doc = "what keeps steps from being too long: each tried whole and shortened, or by what the last one allowed"});
  s.read(
      "inexact", inexact,
      {.doc =
           "linear solves only as exact as Newton's method can use (Eisenstat and Walker), not to linear_tolerance"});
  s.read("max_iterations", max_iterations, {.range = {.min = 1, .max = 1000}, .doc = "of Newton's method in a step"});
  linear.bind(s);
}

Newton::Newton(const NewtonConfig& config, NonlinearSystem& system, Mat K) : config_(config), system_(system) {
  PetscBool symmetric = PETSC_FALSE, known = PETSC_FALSE;
  check(MatIsSymmetricKnown(K, &known, &symmetric));
  std::function<const CellBlocks&(double)> cells;
  if (system.has_cell_blocks())
    cells = [&system](double gamma) -> const CellBlocks& { return system.cell_blocks(gamma); };
  linear_ = std::make_unique<LinearSolver>(config.linear, K, known && symmetric, cells, system.border());
  check(VecCreateMPI(PETSC_COMM_WORLD, system.size(), PETSC_DECIDE, &u_));
  check(VecDuplicate(u_, &R_));
  check(SNESCreate(PETSC_COMM_WORLD, &snes_));
  check(SNESSetType(snes_, SNESNEWTONLS));
  check(SNESSetKSP(snes_, linear_->ksp()));
  check(SNESSetFunction(snes_, R_, form_residual, this));
  check(SNESSetJacobian(snes_, K, K, form_tangent, this));
  check(SNESSetConvergenceTest(snes_, test, this, nullptr));
  check(SNESSetTolerances(snes_, 0, 0, 0, config.max_iterations, PETSC_MAX_INT));
  SNESLineSearch line_search;
  check(SNESGetLineSearch(snes_, &line_search));
  check(SNESLineSearchSetType(line_search, SNESLINESEARCHSHELL));
  check(SNESLineSearchShellSetUserFunc(line_search, search, this));
  if (config.inexact) check(SNESKSPSetUseEW(snes_, PETSC_TRUE));
  check_options(SNESSetFromOptions(snes_));
  check(KSPGetTolerances(linear_->ksp(), &linear_tolerance_, nullptr, nullptr, nullptr));
}

Newton::~Newton() {
  SNESDestroy(&snes_);
  VecDestroy(&u_);
  VecDestroy(&R_);
}

NewtonResult Newton::solve(mfem::Vector& u) {
  Timers::Scope timer("linear solve");  // what is left when residual and tangent have their own
  result_ = {};
  outside_domain_ = false;
  start_ = u;
  potential_known_ = false;
  radius_ = PETSC_INFINITY;
  first_energy_ = energy_ = relative_increment_ = 0;
  assign(u, u_);
  linear_->take_iterations();  // not of this solve
  SNESConvergedReason reason;
  do {  // once more, with a new factorisation, if an old one was no use
    PetscInt iterations;
    check(SNESSolve(snes_, nullptr, u_));
    check(SNESGetConvergedReason(snes_, &reason));
    check(SNESGetIterationNumber(snes_, &iterations));
    result_.iterations += iterations;
    result_.krylov += linear_->take_iterations();
  } while (reason == SNES_DIVERGED_LINEAR_SOLVE && linear_->forget_reused());
  if (config_.inexact)  // it left its own
    check(KSPSetTolerances(linear_->ksp(), linear_tolerance_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  u = *ReadView(u_);
  if (reason <= 0) result_.failure = reason_in_words(reason);
  return result_;
}

bool Newton::evaluate(Vec u, Vec R) {
  mfem::Vector residual(system_.size());
  outside_domain_ = !system_.residual(*ReadView(u), residual);
  assign(residual, R);
  return !outside_domain_;
}

PetscErrorCode Newton::form_residual(SNES snes, Vec u, Vec R, void* self) {
  if (!static_cast<Newton*>(self)->evaluate(u, R)) check(SNESSetFunctionDomainError(snes));
  return 0;
}

PetscErrorCode Newton::form_tangent(SNES snes, Vec u, Mat, Mat K, void* context) {
  auto* self = static_cast<Newton*>(context);
  self->system_.tangent(*ReadView(u), K);
  // SNES decides on reuse anew after this call: a lag of -1 tells it never to refactor, 1 to do it now
  check(SNESSetLagPreconditioner(snes, self->linear_->matrix_changed() ? -1 : 1));
  return 0;
}

PetscErrorCode Newton::test(SNES, PetscInt iteration, PetscReal u_norm, PetscReal increment, PetscReal norm,
                            SNESConvergedReason* reason, void* context) {
  auto* self = static_cast<Newton*>(context);
  const double scale = self->system_.force_scale();
  self->result_.residual = scale > 0 ? norm / scale : norm;
  self->result_.residuals.push_back(self->result_.residual);
  *reason = SNES_CONVERGED_ITERATING;
  if (std::isnan(norm))
    *reason = SNES_DIVERGED_FNORM_NAN;
  else if (self->converged(norm, scale, iteration > 0 ? increment : PETSC_INFINITY))
    *reason = SNES_CONVERGED_FNORM_RELATIVE;
  else if (iteration > 0 && increment <= still * u_norm)
    *reason = SNES_CONVERGED_SNORM_RELATIVE;
  return 0;
}

/// In force; and in increment and energy where they are asked for, which takes an iteration at least.
bool Newton::converged(double norm, double scale, double increment) const {
  if (norm > config_.tolerance * scale) return false;
  if (config_.increment_tolerance > 0 &&
      !(relative_increment_ <= config_.increment_tolerance && std::isfinite(increment)))
    return norm == 0;
  if (config_.energy_tolerance > 0 &&
      !(energy_ <= config_.energy_tolerance * first_energy_ && std::isfinite(increment)))
    return norm == 0;
  return true;
}

/// The first criterion that does not hold, in words.
std::string Newton::missed() const {
  if (result_.residual > config_.tolerance)
    return fmt::format("residual {:.1e} is above the tolerance {:.1e}", result_.residual, config_.tolerance);
  if (config_.increment_tolerance > 0 && relative_increment_ > config_.increment_tolerance)
    return fmt::format("increment {:.1e} is above the tolerance {:.1e}", relative_increment_,
                       config_.increment_tolerance);
  return fmt::format("energy {:.1e} is above the tolerance {:.1e}", energy_ / first_energy_, config_.energy_tolerance);
}

PetscErrorCode Newton::search(SNESLineSearch line_search, void* self) {
  return static_cast<Newton*>(self)->backtrack(line_search);
}

/// Does u - s y have less energy, by a part of what its slope (along -y) promises?
bool Newton::lowers_potential(Vec u, Vec trial, double slope, double s) {
  if (!system_.has_potential() || slope >= 0) return false;
  if (!potential_known_) potential_ = system_.potential(*ReadView(u));
  potential_known_ = true;
  const double there = system_.potential(*ReadView(trial));
  if (there > potential_ + armijo * s * slope) return false;
  potential_ = there;
  return true;
}

/// u <- u - s y with the first s in {1, ...} inside the domain of R that lowers |R|, or the potential where there is
/// one; else the best one seen.
PetscErrorCode Newton::backtrack(SNESLineSearch line_search) {
  Vec u, R, y, trial, trial_R;
  check(SNESLineSearchGetVecs(line_search, &u, &R, &y, &trial, &trial_R));
  PetscReal start, y_norm, u_norm;
  check(VecNorm(R, NORM_2, &start));
  check(VecNorm(y, NORM_2, &y_norm));
  PetscScalar work;
  check(VecDot(R, y, &work));
  energy_ = std::abs(work);
  if (first_energy_ == 0) first_energy_ = energy_;
  const bool limited = config_.globalisation == Globalisation::trust_region && y_norm > radius_;
  double s = limited ? radius_ / y_norm : 1;
  const double longest = s;
  double best = 0, best_norm = PETSC_INFINITY;
  const auto evaluate_at = [&](double step) {
    check(VecWAXPY(trial, -step, y, u));
    PetscReal norm = PETSC_INFINITY;
    if (evaluate(trial, trial_R)) check(VecNorm(trial_R, NORM_2, &norm));
    return norm;
  };
  for (int i = 0; i <= max_backtracks; ++i) {
    const double norm = evaluate_at(s);
    if (norm < best_norm) best = s, best_norm = norm;
    if (norm <= (1 - armijo * s) * start) {
      potential_known_ = false;
      break;
    }
    if (std::isfinite(norm) && lowers_potential(u, trial, -work, s)) {
      best = s, best_norm = norm;
      break;
    }
    // minimum of the parabola through |R|^2 at 0 (with its Newton slope -2 |R|^2) and at s
    const double curved =
        std::isfinite(norm) ? start * start * s / (norm * norm / s - start * start / s + 2 * start * start) : 0;
    s *= std::clamp(std::isfinite(norm) ? curved / s : 0.0, smallest_cut, largest_cut);
  }
  if (!std::isfinite(best_norm)) return SNESLineSearchSetReason(line_search, SNES_LINESEARCH_FAILED_DOMAIN);
  if (best != s || outside_domain_) best_norm = evaluate_at(best);
  check(VecCopy(trial, u));
  check(VecCopy(trial_R, R));
  check(VecNorm(u, NORM_2, &u_norm));
  radius_ = best < longest ? best * y_norm : limited ? 2 * radius_ : std::max(radius_, best * y_norm);
  mfem::Vector change(*ReadView(u));
  change -= start_;
  const double moved = std::sqrt(sum(change * change));
  relative_increment_ = moved > 0 ? best * y_norm / moved : 0;
  check(SNESLineSearchSetNorms(line_search, u_norm, best_norm, best * y_norm));
  check(SNESLineSearchSetLambda(line_search, best));
  return SNESLineSearchSetReason(line_search, SNES_LINESEARCH_SUCCEEDED);
}

std::string Newton::reason_in_words(SNESConvergedReason reason) const {
  switch (reason) {
    case SNES_DIVERGED_FUNCTION_DOMAIN:
      return system_.domain_error();
    case SNES_DIVERGED_LINE_SEARCH:
      return "no step along Newton's direction stays admissible: " + system_.domain_error();
    case SNES_DIVERGED_LINEAR_SOLVE:
      return linear_->failure();
    case SNES_DIVERGED_FNORM_NAN:
      return "the residual is not a finite number";
    case SNES_DIVERGED_MAX_IT:
      return fmt::format("{} after {} Newton iterations", missed(), result_.iterations);
    default:
      return fmt::format("Newton's method ended with SNES reason {}", static_cast<int>(reason));
  }
}

}  // namespace titin
