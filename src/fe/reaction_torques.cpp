#include "fe/reaction_torques.hpp"

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "fe/places_of_dofs.hpp"

namespace titin {

ReactionTorques::ReactionTorques(MuscleSystem& system) : system_(system) {
  if (!system.config().torques.empty()) X_ = places_of_dofs(system.space());
}

/// This rank's part. Components of a node follow each other.
Vec3 ReactionTorques::torque(const TorqueConfig& config, const mfem::Vector& x, const mfem::Vector& forces) const {
  const int dimension = system_.tables().dimension();
  Vec3 moment{};
  for (int i = 0; i < dimension; ++i)
    for (int dof : system_.constraints().boundary_dofs(config.index)[i]) {
      Vec3 arm{}, force{};
      for (int j = 0; j < dimension; ++j) arm[j] = x(dof - i + j) - config.point[j];
      force[i] = forces(dof);
      for (int j = 0; j < 3; ++j)
        moment[j] += arm[(j + 1) % 3] * force[(j + 2) % 3] - arm[(j + 2) % 3] * force[(j + 1) % 3];
    }
  return moment;
}

void ReactionTorques::list(const mfem::Vector& u, const mfem::Vector& forces, std::vector<Quantity>& quantities) const {
  if (system_.config().torques.empty()) return;
  const StepState& step = system_.step();
  mfem::Vector x(X_);
  x += u;
  if (step.conserving && step.u_old.Size() == u.Size()) {
    x.Add(-0.5, u);
    x.Add(0.5, step.u_old);
  }
  for (const TorqueConfig& config : system_.config().torques) {
    const Vec3 moment = torque(config, x, forces);
    for (int i = first_torque_axis(system_.tables().dimension()); i < 3; ++i)
      quantities.push_back({fmt::format("torque_{}_{}", config.boundary, "xyz"[i]), "N m", sum(moment[i])});
  }
}

}  // namespace titin
