/// Moments of the reactions of boundaries about points, M = sum (X + u - point) x f over the boundary's dofs.
///
/// Positions are those of the weak form's own test functions, so that in equilibrium moments balance to the solver's
/// tolerance whatever the mesh. Forces of the middle of a step (energy and momentum) act where the body is then.
#pragma once

#include <vector>

#include "fe/muscle_system.hpp"
#include "solve/model.hpp"

namespace titin {

class ReactionTorques {
 public:
  explicit ReactionTorques(MuscleSystem& system);

  /// Adds the columns; forces are those at all dofs with the body at u. Collective.
  void list(const mfem::Vector& u, const mfem::Vector& forces, std::vector<Quantity>& quantities) const;

 private:
  Vec3 torque(const TorqueConfig& config, const mfem::Vector& x, const mfem::Vector& forces) const;

  MuscleSystem& system_;
  mfem::Vector X_;  // positions of true dofs at rest [m]; empty without torques
};

}  // namespace titin
