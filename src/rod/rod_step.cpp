#include "rod/rod_step.hpp"

namespace titin {

RodStep::RodStep(const Integrator& integrator, double time)
    : time(time),
      dt(integrator.dt()),
      u_old(integrator.u()),
      rule(integrator.rule()),
      inertia_factor(integrator.inertia_factor()),
      known_inertia(integrator.known_inertia()) {
  const IntegratorConfig& config = integrator.config();
  conserving = config.scheme == Scheme::energy_momentum;
  if (config.scheme == Scheme::semi_implicit) {
    rate_dt = integrator.dt_old() > 0 ? integrator.dt_old() : dt;
    rate_known = true;
    rate_old = u_old;
    rate_old.Add(-rate_dt, integrator.seen_velocity());
  } else if (config.velocity == VelocityForm::lines && !conserving) {  // v = (u - rate_old) / rate_dt
    rate_dt = 1 / integrator.velocity_factor();
    rate_old = u_old;
    rate_old.Add(-rate_dt, integrator.known_velocity());
  }
}

}  // namespace titin
