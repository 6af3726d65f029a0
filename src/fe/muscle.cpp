#include "fe/muscle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "fe/displacement_errors.hpp"

namespace titin {
namespace {

/// Of the body's size: errors are not held against displacements that are smaller.
constexpr double small_displacement = 1e-3;
/// Each leaves of a wall's error body / (body + penalty), in stiffness: with a penalty as stiff as the body 30 leave
/// 1e-9.
constexpr int most_augmentations = 30;
/// Of a step: its end is a sum, and may lie behind a kink of what is prescribed by round-off. Rates are taken before
/// it.
constexpr double round_off = 1e-9;

}  // namespace

Muscle::Muscle(NamedMesh mesh, MuscleConfig config)
    : mesh_(std::move(mesh)),
      config_(std::move(config)),
      collection_(config_.elements.collection(mesh_.mesh->Dimension())),
      space_(mesh_.mesh.get(), collection_.get(), mesh_.mesh->Dimension(), mfem::Ordering::byVDIM),
      system_(config_, mesh_, space_),
      integrator_(config_.integrator, space_.GetTrueVSize()),
      history_(system_),
      watch_(system_),
      fields_(system_),
      trial_(space_.GetTrueVSize()) {
  trial_ = 0.0;
  mfem::Vector lower, upper;
  mesh_.mesh->GetBoundingBox(lower, upper);
  upper -= lower;
  size_ = upper.Norml2();
  prescribed_ = prescribed_rate_ = trial_;
  if (config_.inertia == Inertia::dynamic && !system_.constraints().any()) turn_ = std::make_unique<RigidTurn>(space_);
  if (config_.error_estimate) recovery_ = std::make_unique<StressRecovery>(system_);
  start();
  follow(system_.step());
}

void Muscle::start() {
  mfem::Vector R(system_.size());
  const mfem::Vector v = config_.initial.at_dofs(space_);
  system_.step().known_velocity = v;
  system_.residual(trial_, R);
  system_.accept_forces();
  const bool accelerates = config_.inertia == Inertia::dynamic && uses_acceleration(config_.integrator);
  integrator_.start(trial_, v, accelerates ? initial_acceleration(system_, mesh_.thickness, R) : trial_);
}

std::vector<Quantity> Muscle::errors() {
  if (!config_.exact_motion) return {};
  return displacement_errors(space_, displacement(), integrator_.v(), *config_.exact_motion, time_);
}

Newton& Muscle::newton() {
  if (!newton_) newton_ = std::make_unique<Newton>(config_.newton, system_, system_.matrix());
  return *newton_;
}

void Muscle::follow(const StepState& step) {
  history_.update(displacement(), integrator_.v(), step);
  quantities_ = history_.quantities();
  if (recovery_) {
    recovery_->update(displacement());
    for (const Quantity& quantity : recovery_->quantities()) quantities_.push_back(quantity);
  }
  if (config_.ellipticity) {
    watch_.update(displacement(), step);
    for (const Quantity& q : watch_.quantities()) quantities_.push_back(q);
  }
  conservation_.update(quantities_);
}

void Muscle::update_fields() {
  fields_.update(displacement(), integrator_.seen_velocity());
  if (recovery_) fields_.set_stress_error(*recovery_);
  if (config_.ellipticity) fields_.set_ellipticity(watch_.smallest());
}

Step Muscle::advance(double dt) {
  if (remember_) system_.history().commit();  // not before: outputs of the accepted step ask for what led to it
  remember_ = false;
  system_.reset_multipliers();
  Step step;
  step.time = time_ + dt;
  step.dt = dt;
  system_.constraints().set_values(step.time, prescribed_);
  system_.constraints().set_rates(step.time - round_off * dt, prescribed_rate_);
  integrator_.begin(dt, {system_.constraints().dofs(), prescribed_, prescribed_rate_});
  system_.step() = StepState(integrator_, step.time);
  step.failure = predict(step);
  if (!step.ok()) return step;
  solve(step);
  if (step.ok()) estimate_error(step);
  return step;
}

/// Newton's method, and again while walls give by more than they may.
void Muscle::solve(Step& step) {
  for (int round = 0; round <= most_augmentations; ++round) {
    const NewtonResult result = newton().solve(trial_);
    step.newton += result.iterations;
    step.krylov += result.krylov;
    step.residual = result.residual;
    step.residuals = result.residuals;
    step.failure = result.failure;
    if (!step.ok() || !system_.augment(trial_)) return;
  }
  step.failure =
      fmt::format("a wall still gives by more than its gap_tolerance after {} augmentations: raise its penalty",
                  most_augmentations);
}

/// Root mean square over free dofs, over that of the largest displacement so far or, while that is small, of the body.
void Muscle::estimate_error(Step& step) {
  mfem::Vector error = integrator_.error(trial_);
  for (int dof : system_.constraints().dofs()) error(dof) = 0;
  const double dofs = static_cast<double>(unknowns());
  const double moved = std::max(largest_change_, std::sqrt(sum(trial_ * trial_) / dofs));
  step.error = std::sqrt(sum(error * error) / dofs) / std::max(moved, small_displacement * size_);
  step.order = integrator_.rule().order;
}

std::vector<double> Muscle::kinks() const {
  std::vector<double> all = config_.body_scale.kinks();
  const auto take = [&all](const std::vector<double>& some) { all.insert(all.end(), some.begin(), some.end()); };
  for (const BoundaryConfig& boundary : config_.boundaries) {
    for (const Table& component : boundary.displacement) take(component.kinks());
    take(boundary.traction_scale.kinks());
    take(boundary.pressure.kinks());
    take(boundary.support.wall.travel.kinks());
    take(boundary.rail.force.kinks());
  }
  for (const auto& [name, material] : config_.materials) take(material->kinks());
  return all;
}

/// First guess of the step: the motion goes on, as far as the prescribed values do, which are then met by one linear
/// solve. If that turns a cell inside out, the same from rest.
std::string Muscle::predict(Step& step) {
  const double part = continued_part(step);
  mfem::Vector moved = displacement();
  if (turn_)
    moved = turn_->guess(integrator_, step.dt);
  else
    moved.Add(part * step.dt, integrator_.seen_velocity());
  const std::string failure = predict_from(moved, step);
  return failure.empty() || part == 0 ? failure : predict_from(displacement(), step);
}

/// How much of the last velocity the prescribed values keep, 0 to 1; 1 when they were at rest.
double Muscle::continued_part(const Step& step) const {
  const mfem::Vector &u = displacement(), &v = integrator_.seen_velocity();
  double along = 0, square = 0;
  for (int dof : system_.constraints().dofs()) {
    along += (prescribed_(dof) - u(dof)) / step.dt * v(dof);
    square += v(dof) * v(dof);
  }
  along = sum(along);
  square = sum(square);
  return square > 0 ? std::clamp(along / square, 0.0, 1.0) : 1.0;
}

std::string Muscle::predict_from(const mfem::Vector& start, Step& step) {
  mfem::Vector R(system_.size()), change(system_.size()), lift(system_.size());
  if (!system_.residual(start, R)) return system_.domain_error();
  lift = 0.0;
  for (int dof : system_.constraints().dofs()) lift(dof) = prescribed_(dof) - start(dof);
  LinearSolver& linear = newton().linear();  // before the tangent, which it may want cell by cell
  system_.tangent_with_lift(start, lift, R);
  linear.matrix_changed();
  change = 0.0;
  const std::string failure = linear.solve(R, change);
  step.newton += 1;
  step.krylov += linear.iterations();
  if (!failure.empty()) return failure;
  trial_ = start;
  trial_ -= change;
  for (int dof : system_.constraints().dofs()) trial_(dof) = prescribed_(dof);
  return system_.residual(trial_, R) ? "" : system_.domain_error();
}

void Muscle::accept() {
  Timers::Scope timer("history");
  const StepState& step = system_.step();
  integrator_.accept(trial_);
  largest_change_ = std::max(largest_change_, std::sqrt(sum(trial_ * trial_) / static_cast<double>(unknowns())));
  system_.accept_forces();
  time_ = step.time;
  remember_ = true;
  follow(step);
}

double Muscle::largest_dt() const { return std::numeric_limits<double>::infinity(); }

}  // namespace titin
