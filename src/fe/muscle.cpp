#include "fe/muscle.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {

Muscle::Muscle(NamedMesh mesh, MuscleConfig config)
    : mesh_(std::move(mesh)),
      config_(std::move(config)),
      collection_(config_.order, 3),
      space_(mesh_.mesh.get(), &collection_, 3, mfem::Ordering::byVDIM),
      system_(config_, mesh_, space_),
      history_(system_),
      watch_(system_),
      fields_(system_),
      u_(space_.GetTrueVSize()),
      v_(space_.GetTrueVSize()),
      trial_(space_.GetTrueVSize()) {
  u_ = v_ = trial_ = 0.0;
  mfem::Vector R(system_.size());
  system_.residual(u_, R);
  follow(system_.step());
}

Newton& Muscle::newton() {
  if (!newton_) newton_ = std::make_unique<Newton>(config_.newton, system_, system_.matrix());
  return *newton_;
}

void Muscle::follow(const StepState& step) {
  history_.update(u_, v_, step);
  quantities_ = history_.quantities();
  if (config_.ellipticity) {
    watch_.update(u_, step);
    for (const Quantity& q : watch_.quantities()) quantities_.push_back(q);
  }
  conservation_.update(quantities_);
}

Step Muscle::advance(double dt) {
  if (remember_) system_.history().commit();  // not before: outputs of the accepted step ask for what led to it
  remember_ = false;
  Step step;
  step.time = time_ + dt;
  step.dt = dt;
  system_.step() = {step.time, dt, u_, v_};
  step.failure = predict(step);
  if (!step.ok()) return step;
  const NewtonResult result = newton().solve(trial_);
  step.newton += result.iterations;
  step.krylov += result.krylov;
  step.residual = result.residual;
  step.residuals = result.residuals;
  step.failure = result.failure;
  return step;
}

/// First guess of the step: the motion goes on, as far as the prescribed values do, which are then met by one linear
/// solve. If that turns a cell inside out, the same from rest.
std::string Muscle::predict(Step& step) {
  const double part = continued_part(step);
  mfem::Vector moved = u_;
  moved.Add(part * step.dt, v_);
  const std::string failure = predict_from(moved, step);
  return failure.empty() || part == 0 ? failure : predict_from(u_, step);
}

/// How much of the last velocity the prescribed values keep, 0 to 1; 1 when they were at rest.
double Muscle::continued_part(const Step& step) const {
  mfem::Vector prescribed = u_;
  system_.constraints().set_values(step.time, prescribed);
  double along = 0, square = 0;
  for (int dof : system_.constraints().dofs()) {
    along += (prescribed(dof) - u_(dof)) / step.dt * v_(dof);
    square += v_(dof) * v_(dof);
  }
  along = sum(along);
  square = sum(square);
  return square > 0 ? std::clamp(along / square, 0.0, 1.0) : 1.0;
}

std::string Muscle::predict_from(const mfem::Vector& start, Step& step) {
  mfem::Vector R(system_.size()), change(system_.size()), lift(system_.size()), prescribed(system_.size());
  if (!system_.residual(start, R)) return system_.domain_error();
  lift = 0.0;
  prescribed = start;
  system_.constraints().set_values(step.time, prescribed);
  for (int dof : system_.constraints().dofs()) lift(dof) = prescribed(dof) - start(dof);
  system_.tangent_with_lift(start, lift, R);
  LinearSolver& linear = newton().linear();
  linear.matrix_changed();
  change = 0.0;
  const std::string failure = linear.solve(R, change);
  step.newton += 1;
  step.krylov += linear.iterations();
  if (!failure.empty()) return failure;
  trial_ = start;
  trial_ -= change;
  for (int dof : system_.constraints().dofs()) trial_(dof) = prescribed(dof);
  return system_.residual(trial_, R) ? "" : system_.domain_error();
}

void Muscle::accept() {
  Timers::Scope timer("history");
  const StepState& step = system_.step();
  for (int i = 0; i < u_.Size(); ++i) v_(i) = (trial_(i) - u_(i)) / step.dt;
  u_ = trial_;
  time_ = step.time;
  remember_ = true;
  follow(step);
}

double Muscle::largest_dt() const { return std::numeric_limits<double>::infinity(); }

}  // namespace titin
