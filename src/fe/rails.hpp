/// Rigid plates at boundaries that move along a rail: all their nodes share one component of the displacement, q,
/// driven by a force and slowed down by the load's mass. A muscle that shortens against a load.
///
///   m a + sum of the body's nodal forces on the plate = F(t)
///
/// q is no dof of its own: the true dofs of the plate all hold it, one of them (the carrier) its equation.
#pragma once

#include <mfem.hpp>
#include <vector>

#include "base/config.hpp"
#include "solve/state_walk.hpp"

namespace titin {

struct RailConfig {
  int axis = -1;    // the component that all nodes share; -1: no rail
  Table force;      // on the plate, along the axis [N]
  double mass = 0;  // that moves with it [kg]
  bool given() const { return axis >= 0; }
  void bind(Section& boundary, int dimension);
};

class Rails {
 public:
  struct Rail {
    const RailConfig* config;
    int boundary;
    mfem::Array<int> dofs;  // this rank's true dofs
    int carrier = -1;       // one of them, on one rank
  };
  /// `dofs`: this rank's true dofs of the boundary along the axis. Collective.
  void add(const RailConfig& config, int boundary, const mfem::Array<int>& dofs);
  /// After all: which local dofs are on which rail.
  void finish(const mfem::ParFiniteElementSpace& space);

  bool any() const { return !rails_.empty(); }
  const std::vector<Rail>& list() const { return rails_; }
  int of_local(int local_dof) const { return of_local_.empty() ? -1 : of_local_[local_dof]; }  ///< -1: of none

  // All collective.
  void gather(mfem::Vector& R) const;  ///< the forces on a plate, to its carrier; zero at its other dofs
  void spread(mfem::Vector& x) const;  ///< what carriers hold, to all dofs of their plates
  std::vector<double> values(const mfem::Vector& x) const;  ///< what carriers hold
  std::vector<double> totals(const mfem::Vector& R) const;  ///< of the forces on each plate

 private:
  std::vector<Rail> rails_;
  std::vector<int> of_local_;
};

/// What acts on the plates besides the body: minus the driving force, and mass times acceleration [N], of each rail.
class PlateForces {
 public:
  /// `acceleration`: true dofs. Collective.
  void update(const Rails& rails, double time, const mfem::Vector& acceleration);
  void accept() { driving_old_ = driving_; }
  void walk(StateWalk& walk) { walk.common("plates_driving", driving_old_); }
  /// Adds them to the residual at carriers, as a step with this weight of forces balances them; to `absolute` their
  /// sizes.
  void add(const Rails& rails, double force_weight, mfem::Vector& R) const;
  void add_sizes(const Rails& rails, mfem::Vector& absolute) const;
  /// Of what they add to the residual at this displacement; inertia_factor: acceleration over displacement [1/s^2].
  /// Collective.
  double potential(const Rails& rails, double force_weight, double inertia_factor, const mfem::Vector& u) const;

 private:
  std::vector<double> driving_, driving_old_, inertia_;
};

}  // namespace titin
