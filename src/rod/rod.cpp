#include "rod/rod.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/timers.hpp"
#include "rod/rod_newton.hpp"
#include "rod/rod_stability.hpp"

namespace titin {
namespace {

constexpr double small_displacement = 1e-3;  // of the rod's length: errors are not held against less
constexpr double round_off = 1e-9;           // of a step: rates that are given are taken before its end

double root_mean_square(const mfem::Vector& x) { return x.Norml2() / std::sqrt(x.Size()); }

}  // namespace

Rod::Rod(NamedMesh mesh, RodConfig config)
    : mesh_(std::move(mesh)),
      config_(std::move(config)),
      system_(config_),
      integrator_(config_.integrator, system_.lattice().nodes()),
      history_(system_),
      fields_(system_, *mesh_.mesh),
      trial_(system_.lattice().nodes()),
      prescribed_(trial_.Size()),
      prescribed_rate_(trial_.Size()) {
  start();
  follow();
}

/// Evenly stretched, with a standing wave on top; what is given is met from the first step on.
void Rod::start() {
  const int n = trial_.Size();
  mfem::Vector v(n), R(n), rest(n);
  rest = 0.0;
  for (int i = 0; i < n; ++i) {
    const double X = std::min(system_.lattice().X()[i], config_.length);
    const double wave = std::sin(config_.start.mode * std::numbers::pi * X / config_.length);
    trial_(i) = (config_.start.stretch - 1) * X + config_.start.displacement * wave;
    v(i) = config_.start.velocity * wave;
  }
  RodStep& step = system_.step();
  step.u_old = trial_;
  const bool inside = system_.residual(trial_, R);
  system_.accept_forces();
  const bool accelerates = inside && config_.has_mass() && uses_acceleration(config_.integrator);
  integrator_.start(trial_, v, accelerates ? system_.initial_acceleration(R) : rest);
}

void Rod::follow() {
  history_.update(displacement(), integrator_.v(), integrator_.seen_velocity());
  quantities_ = history_.quantities();
  if (!config_.stability) return;
  const auto rates = growth_rates(system_, displacement(), system_.step().time);
  quantities_.push_back({"growth_rate", "1/s", rates.empty() ? 0.0 : rates.front().real()});
}

Step Rod::advance(double dt) {
  if (remember_) system_.commit_history();
  remember_ = false;
  Step step;
  step.time = time_ + dt;
  step.dt = dt;
  system_.set_given(step.time, prescribed_);
  system_.set_given_rates(step.time - round_off * dt, prescribed_rate_);
  integrator_.begin(dt, {system_.given(), prescribed_, prescribed_rate_});
  system_.step() = RodStep(integrator_, step.time);
  Timers::Scope timer("rod");
  trial_ = continued(dt);
  NewtonResult result = solve_rod(system_, prescribed_, trial_);
  if (!result.failure.empty()) {  // once more from rest
    trial_ = displacement();
    const int spent = result.iterations;
    result = solve_rod(system_, prescribed_, trial_);
    result.iterations += spent;
  }
  step.newton = result.iterations;
  step.residual = result.residual;
  step.residuals = result.residuals;
  step.failure = result.failure;
  if (step.ok()) estimate_error(step);
  return step;
}

/// Where the motion goes if it goes on; a rod without inertia stays.
mfem::Vector Rod::continued(double dt) const {
  mfem::Vector u = displacement();
  if (config_.has_mass() && config_.kind != RodKind::massless) u.Add(dt, integrator_.seen_velocity());
  return u;
}

/// Root mean square over free nodes, over that of the largest displacement so far or, while that is small, of the rod.
void Rod::estimate_error(Step& step) {
  mfem::Vector error = integrator_.error(trial_);
  for (int node : system_.given()) error(node) = 0;
  const double moved = std::max(largest_change_, root_mean_square(trial_));
  step.error = root_mean_square(error) / std::max(moved, small_displacement * config_.length);
  step.order = integrator_.rule().order;
}

void Rod::accept() {
  integrator_.accept(trial_);
  largest_change_ = std::max(largest_change_, root_mean_square(trial_));
  system_.accept_forces();
  time_ = system_.step().time;
  remember_ = true;
  follow();
}

/// Every rank holds and reads the whole rod.
void Rod::walk_state(StateWalk& walk) {
  StateRows nodes{"nodes", {}};
  for (int i = 0; i < trial_.Size(); ++i) nodes.number.push_back(i);
  integrator_.walk(walk, nodes);
  system_.walk(walk);
  history_.walk(walk);
  walk.number("time", time_);
  walk.number("remember", remember_);
  walk.number("largest_change", largest_change_);
  std::vector<double> values;
  for (const Quantity& q : quantities_) values.push_back(q.value);
  walk.common("quantities", values);
  if (!walk.reading()) return;
  for (std::size_t k = 0; k < quantities_.size(); ++k) quantities_[k].value = values[k];
  trial_ = displacement();
}

double Rod::largest_dt() const { return std::numeric_limits<double>::infinity(); }

std::vector<double> Rod::kinks() const {
  std::vector<double> all = config_.muscle->kinks();
  const auto take = [&all](const std::vector<double>& some) { all.insert(all.end(), some.begin(), some.end()); };
  if (config_.tendon_material) take(config_.tendon_material->kinks());
  for (const RodEndConfig& end : config_.ends) {
    take(end.displacement.kinks());
    take(end.force.kinks());
  }
  return all;
}

}  // namespace titin
