/// Implicit time integration of M a + f(u, v, t) = 0: what each scheme makes of a step, as numbers.
///
/// Every scheme here gives velocity and acceleration at the end of a step as linear forms of the step's change of the
/// displacement and of the past, takes the inertia at one place in the step and the forces at another,
///
///   v = velocity(u - u_n, ...),   a = acceleration(u - u_n, ...),
///   M (m a + (1 - m) a_n) + w f(u, v, t) + (1 - w) f_n = 0,   m = inertia_weight, w = force_weight,
///
/// and differs from the others in these numbers only. Sources: Newmark (1959), J. Eng. Mech. Div. 85(3):67; Hilber,
/// Hughes, Taylor (1977), Earthq. Eng. Struct. Dyn. 5:283; Chung, Hulbert (1993), J. Appl. Mech. 60:371; BDF2 of
/// variable step: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.5; energy and momentum: Simo,
/// Tarnow (1992), ZAMP 43:757 and Gonzalez (2000), Comput. Methods Appl. Mech. Eng. 190:1763. docs/theory/muscle.md. SI
/// units.
#pragma once

#include <mfem.hpp>

#include "base/config.hpp"
#include "solve/state_walk.hpp"

namespace titin {

enum class Scheme {
  backward_euler,
  semi_implicit,  ///< backward Euler, fibre rates from the velocity of the step before
  newmark,        ///< average acceleration: the trapezoidal rule
  hht_alpha,
  generalised_alpha,
  bdf2,
  energy_momentum,  ///< forces are the discrete gradient of the energy between both ends of the step
};

/// What "the velocity" of a step is, to fibre rates, prescribed motion and output.
enum class VelocityForm {
  rothe,  ///< time first: what the displacement did in the step, (u - u_n) / dt
  lines,  ///< space first: the unknown of the semi-discrete system, advanced by the scheme, given where u is given
};

struct IntegratorConfig {
  Scheme scheme = Scheme::backward_euler;
  VelocityForm velocity = VelocityForm::rothe;
  double alpha = 0.1;            // of HHT: 0 to 1/3
  double spectral_radius = 0.8;  // of generalised-alpha, at infinite frequency
  void bind(Section& s);
};

/// A rate as a linear form of what the displacement does in this step and did in the last, and of last rates.
struct RateForm {
  double du = 0, du_old = 0;       // [1/s] or [1/s^2]
  double v = 0, v_old = 0, a = 0;  // of velocities and acceleration at t_n, t_n-1
};

/// The numbers of one step; its own error is about error_constant dt^(order+1) times that derivative of u.
struct StepRule {
  RateForm velocity, acceleration;  ///< at the end of the step
  double inertia_weight = 1, force_weight = 1;
  int order = 1;
  double error_constant = 0.5;
  double work_weight = 1;  ///< of the forces at the end in the work of the step; those at its beginning have the rest
};

/// The rule of a step of length dt after one of length dt_old (0: none, this is the first).
StepRule rule_of(const IntegratorConfig& config, double dt, double dt_old);

/// Whether the next step asks for the acceleration of the last.
bool uses_acceleration(const IntegratorConfig& config);

/// Displacement and its rates of the accepted state, and of the step that is being tried. True-dof vectors.
class Integrator {
 public:
  /// Displacements and velocities at the end of the step at dofs where they are given.
  struct Prescribed {
    const mfem::Array<int>& dofs;
    const mfem::Vector &u, &v;  // full vectors, read at dofs only
  };
  Integrator(const IntegratorConfig& config, int size);

  void start(const mfem::Vector& u, const mfem::Vector& v, const mfem::Vector& a) {
    u_ = u, v_ = v_old_ = v, a_ = a_old_ = a;
  }
  /// A step of length dt is tried from the accepted state.
  void begin(double dt, const Prescribed& prescribed);
  /// Estimate of the error that this step alone adds to u [m]; zero at prescribed dofs is the caller's affair.
  mfem::Vector error(const mfem::Vector& u) const;
  /// The step is accepted with displacement u.
  void accept(const mfem::Vector& u);

  /// The accepted state.
  void walk(StateWalk& walk, const StateRows& dofs);

  const IntegratorConfig& config() const { return config_; }
  double dt() const { return dt_; }          ///< of the step begun last
  double dt_old() const { return dt_old_; }  ///< of the last accepted step; 0 at the start
  const StepRule& rule() const { return rule_; }
  const mfem::Vector& u() const { return u_; }
  const mfem::Vector& v() const { return v_; }
  const mfem::Vector& a() const { return a_; }
  /// The velocity of the last accepted step in the sense of its form; the scheme's own at the start.
  const mfem::Vector& seen_velocity() const;
  const mfem::Vector& last_change() const { return du_old_; }  ///< of u, in the last accepted step

  // v and the acceleration of the balance at displacement u are factor (u - u_n) + known.
  double velocity_factor() const { return rule_.velocity.du; }
  double inertia_factor() const { return rule_.inertia_weight * rule_.acceleration.du; }
  const mfem::Vector& known_velocity() const { return known_velocity_; }
  const mfem::Vector& known_inertia() const { return known_inertia_; }

 private:
  mfem::Vector known(const RateForm& form, const mfem::Vector& a) const;
  double delay() const { return (rule_.inertia_weight - rule_.force_weight) * dt_; }
  mfem::Vector acceleration_at_start() const;
  void take_prescribed(const Prescribed& prescribed);

  IntegratorConfig config_;
  StepRule rule_;
  double dt_ = 0, dt_old_ = 0;
  double a_delay_ = 0, a_old_delay_ = 0;  // [s] by which a_ and a_old_ are of an earlier time than their step's end
  mfem::Vector u_, v_, a_, du_old_, v_old_, a_old_;
  mfem::Vector mean_velocity_;  // of the last accepted step
  mfem::Vector known_velocity_, known_acceleration_, known_inertia_;
};

}  // namespace titin
