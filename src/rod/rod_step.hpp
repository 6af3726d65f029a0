/// What a rod's equations know of an implicit step: the numbers of the scheme, and from where rates are taken.
#pragma once

#include <mfem.hpp>

#include "solve/integrator.hpp"

namespace titin {

struct RodStep {
  double time = 0, dt = 0;  ///< end of the step and its length [s]
  mfem::Vector u_old;       ///< [m] at its beginning
  StepRule rule;
  double inertia_factor = 0;   ///< [1/s^2]
  mfem::Vector known_inertia;  ///< [m/s^2]
  // The rate of stretch, where it is not that from u_old to u in dt: from rate_old in rate_dt to u, or to u_old.
  mfem::Vector rate_old;  ///< [m]
  double rate_dt = 0;     ///< [s]; 0: the step's own
  bool rate_known = false;
  bool conserving = false;  ///< forces are the discrete gradient between u_old and u, loads those of the middle

  RodStep() = default;
  /// The step that was begun last.
  RodStep(const Integrator& integrator, double time);
};

}  // namespace titin
