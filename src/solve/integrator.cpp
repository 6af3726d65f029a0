#include "solve/integrator.hpp"

#include <cmath>

#include <algorithm>

namespace titin {
namespace {

RateForm operator*(double s, const RateForm& f) { return {s * f.du, s * f.du_old, s * f.v, s * f.v_old, s * f.a}; }
RateForm operator+(const RateForm& f, const RateForm& g) {
  return {f.du + g.du, f.du_old + g.du_old, f.v + g.v, f.v_old + g.v_old, f.a + g.a};
}

/// u = u_n + dt v_n + dt^2 (position_old a_n + position_new a),   v = v_n + dt (velocity_old a_n + velocity_new a).
struct OneStep {
  double position_old, position_new, velocity_old, velocity_new;
  double inertia_weight = 1, force_weight = 1, work_weight = 0.5;
};

OneStep newmark(double beta, double gamma) { return {0.5 - beta, beta, 1 - gamma, gamma}; }

/// Second order and largest dissipation of high frequencies for given weights (Chung and Hulbert 1993, eqs. 17, 20).
OneStep alpha_method(double inertia_weight, double force_weight) {
  const double shift = inertia_weight - force_weight;  // alpha_f - alpha_m
  OneStep step = newmark(0.25 * (1 + shift) * (1 + shift), 0.5 + shift);
  step.inertia_weight = inertia_weight;
  step.force_weight = force_weight;
  return step;
}

OneStep one_step(const IntegratorConfig& c) {
  const double radius = c.spectral_radius;
  switch (c.scheme) {
    case Scheme::newmark:
      return newmark(0.25, 0.5);
    case Scheme::hht_alpha:
      return alpha_method(1, 1 - c.alpha);
    case Scheme::generalised_alpha:
      return alpha_method((2 - radius) / (1 + radius), 1 / (1 + radius));
    case Scheme::energy_momentum: {  // M (v - v_n) / dt + f = 0, (v + v_n) / 2 = (u - u_n) / dt; f is no mean of two
      OneStep midpoint = newmark(0.25, 0.5);
      midpoint.inertia_weight = 0.5;
      return midpoint;
    }
    default:
      return {0, 1, 0, 1, 1, 1, 1};  // backward Euler: v = (u - u_n) / dt, a = (v - v_n) / dt
  }
}

StepRule rule_of(const OneStep& s, double dt) {
  StepRule rule;
  const double square = 1 / (s.position_new * dt * dt);
  rule.acceleration = {square, 0, -square * dt, 0, -s.position_old / s.position_new};
  rule.velocity = dt * s.velocity_new * rule.acceleration + RateForm{0, 0, 1, 0, dt * s.velocity_old};
  rule.inertia_weight = s.inertia_weight;
  rule.force_weight = s.force_weight;
  rule.work_weight = s.work_weight;
  if (s.position_old == 0) return rule;  // backward Euler
  rule.order = 2;
  rule.error_constant =
      std::abs(s.position_new - 1.0 / 6);  // Zienkiewicz, Xie (1991), Earthq. Eng. Struct. Dyn. 20:871
  return rule;
}

/// Slopes at the end of two steps: x' = now (x - x_n) - before (x_n - x_n-1). The first step has no step before.
struct Bdf2 {
  double now, before;
  Bdf2(double dt, double dt_old) {
    const double r = dt_old > 0 ? dt / dt_old : 0.0;
    now = (1 + 2 * r) / (1 + r) / dt;
    before = r * r / (1 + r) / dt;
  }
};

/// How far accelerations may be extrapolated, in steps: those of the stiffest modes change by a factor of -radius in a
/// step, and must not grow by it.
double stable_extrapolation(const IntegratorConfig& c) {
  const double radius = c.scheme == Scheme::hht_alpha ? (1 - c.alpha) / (1 + c.alpha) : c.spectral_radius;
  return 0.5 * radius / (1 + radius);
}

}  // namespace

void IntegratorConfig::bind(Section& s) {
  s.choose("scheme", scheme,
           {{"backward_euler", Scheme::backward_euler},
            {"semi_implicit", Scheme::semi_implicit},
            {"newmark", Scheme::newmark},
            {"hht_alpha", Scheme::hht_alpha},
            {"generalised_alpha", Scheme::generalised_alpha},
            {"bdf2", Scheme::bdf2},
            {"energy_momentum", Scheme::energy_momentum}},
           {.doc = "time integration of the motion"});
  const bool second_order = scheme != Scheme::backward_euler && scheme != Scheme::semi_implicit;
  if (second_order && scheme != Scheme::energy_momentum) velocity = VelocityForm::lines;
  s.choose(
      "velocity", velocity, {{"rothe", VelocityForm::rothe}, {"lines", VelocityForm::lines}},
      {.doc = "the velocity that fibre rates and output see: of the displacements in a step (rothe: backward_euler, "
              "semi_implicit, energy_momentum unless said), or the scheme's own (lines: the others)"});
  s.read("alpha", alpha,
         {.range = {.min = 0, .max = 1.0 / 3}, .doc = "of hht_alpha: dissipation of high frequencies, 0 for none"});
  s.read("spectral_radius", spectral_radius,
         {.range = {.min = 0, .max = 1},
          .doc = "of generalised_alpha: what a step leaves of infinite frequencies, 1 for no dissipation"});
}

StepRule rule_of(const IntegratorConfig& config, double dt, double dt_old) {
  if (config.scheme != Scheme::bdf2) return rule_of(one_step(config), dt);
  const Bdf2 slope(dt, dt_old);
  StepRule rule;
  rule.velocity = {slope.now, -slope.before};
  if (dt_old > 0) {
    rule.order = 2;
    rule.error_constant = 2.0 / 9;  // of equal steps
    rule.work_weight = 0.5;
  }
  rule.acceleration = slope.now * (rule.velocity + RateForm{0, 0, -1}) + RateForm{0, 0, -slope.before, slope.before};
  return rule;
}

bool uses_acceleration(const IntegratorConfig& config) {
  const StepRule rule = rule_of(config, 1, 1);
  const double in_balance = rule.inertia_weight * rule.acceleration.a + (1 - rule.inertia_weight);
  return in_balance != 0 || rule.velocity.a != 0;
}

Integrator::Integrator(const IntegratorConfig& config, int size) : config_(config) {
  for (auto* x : {&u_, &v_, &a_, &du_old_, &v_old_, &a_old_, &mean_velocity_, &known_velocity_, &known_acceleration_,
                  &known_inertia_}) {
    x->SetSize(size);
    *x = 0.0;
  }
}

mfem::Vector Integrator::known(const RateForm& form, const mfem::Vector& a) const {
  mfem::Vector rate(u_.Size());
  for (int i = 0; i < rate.Size(); ++i)
    rate(i) = form.du_old * du_old_(i) + form.v * v_(i) + form.v_old * v_old_(i) + form.a * a(i);
  return rate;
}

void Integrator::begin(double dt, const Prescribed& prescribed) {
  dt_ = dt;
  rule_ = rule_of(config_, dt, dt_old_);
  const mfem::Vector a = acceleration_at_start();
  known_velocity_ = known(rule_.velocity, a);
  known_acceleration_ = known(rule_.acceleration, a);
  if (config_.velocity == VelocityForm::lines) take_prescribed(prescribed);
  known_inertia_ = known_acceleration_;
  known_inertia_ *= rule_.inertia_weight;
  known_inertia_.Add(1 - rule_.inertia_weight, a);
}

/// The a_n of an alpha method is the acceleration at t_n + (w - m) dt with the step that ended there: it is moved to
/// where this step, of another length, looks for it. Without that, steps that vary are of first order.
mfem::Vector Integrator::acceleration_at_start() const {
  mfem::Vector a = a_;
  if (dt_old_ > 0 && dt_ != dt_old_ && uses_acceleration(config_)) {
    const double most = stable_extrapolation(config_), apart = dt_old_ - a_delay_ + a_old_delay_;
    const double part = std::clamp((a_delay_ - delay()) / apart, -most, most);
    a.Add(part, a_);
    a.Add(-part, a_old_);
  }
  return a;
}

/// Given velocities, and accelerations from their differences: whatever the velocity jumps by, the inertia of two steps
/// together takes up, and no scheme makes it ring.
void Integrator::take_prescribed(const Prescribed& prescribed) {
  const Bdf2 slope(dt_, dt_old_ > 0 ? dt_old_ : dt_);
  for (int dof : prescribed.dofs) {
    const double du = prescribed.u(dof) - u_(dof), v = prescribed.v(dof);
    const double a = slope.now * (v - v_(dof)) - slope.before * (v_(dof) - v_old_(dof));
    known_velocity_(dof) = v - rule_.velocity.du * du;
    known_acceleration_(dof) = a - rule_.acceleration.du * du;
  }
}

/// From differences of velocities: of two for u'', of three for u'''.
mfem::Vector Integrator::error(const mfem::Vector& u) const {
  mfem::Vector e(u.Size());
  const double c = rule_.error_constant * dt_;
  for (int i = 0; i < u.Size(); ++i) {
    const double v = rule_.velocity.du * (u(i) - u_(i)) + known_velocity_(i);
    const double slope = v - v_(i), slope_before = dt_old_ > 0 ? (v_(i) - v_old_(i)) / dt_old_ : a_(i);
    e(i) = rule_.order == 1 ? c * slope : c * 2 * dt_ * (slope - dt_ * slope_before) / (dt_ + dt_old_);
  }
  return e;
}

void Integrator::accept(const mfem::Vector& u) {
  v_old_ = v_;
  a_old_ = a_;
  a_old_delay_ = a_delay_;
  a_delay_ = delay();
  for (int i = 0; i < u.Size(); ++i) {
    const double du = u(i) - u_(i);
    du_old_(i) = du;
    mean_velocity_(i) = du / dt_;
    v_(i) = rule_.velocity.du * du + known_velocity_(i);
    a_(i) = rule_.acceleration.du * du + known_acceleration_(i);
  }
  u_ = u;
  dt_old_ = dt_;
}

void Integrator::walk(StateWalk& walk, const StateRows& dofs) {
  walk.number("integrator_dt_old", dt_old_);
  walk.number("integrator_a_delay", a_delay_);
  walk.number("integrator_a_old_delay", a_old_delay_);
  walk.vector("u", dofs, u_);
  walk.vector("v", dofs, v_);
  walk.vector("a", dofs, a_);
  walk.vector("du_old", dofs, du_old_);
  walk.vector("v_old", dofs, v_old_);
  walk.vector("a_old", dofs, a_old_);
  walk.vector("mean_velocity", dofs, mean_velocity_);
}

const mfem::Vector& Integrator::seen_velocity() const {
  return config_.velocity == VelocityForm::rothe && dt_old_ > 0 ? mean_velocity_ : v_;
}

}  // namespace titin
