/// How a free body goes on turning: the first guess of a step, in which a straight path would stretch it.
///
///   x' = c + dt v_c + Q (x - c + dt (v - v_c - v_turn)),   Q = R^(dt / dt_old)
///
/// c and v_c are mean place and velocity of the nodes, R the rotation nearest to the motion of the last step (that of
/// the polar decomposition of sum x x_old^T about the means), and v_turn what it has in the velocity.
#pragma once

#include <mfem.hpp>

#include "math/tensor.hpp"
#include "solve/integrator.hpp"

namespace titin {

class RigidTurn {
 public:
  explicit RigidTurn(mfem::ParFiniteElementSpace& space);
  /// Displacement after dt more, of the accepted motion [m]. Collective.
  mfem::Vector guess(const Integrator& motion, double dt) const;

 private:
  Vec3 at(const mfem::Vector& v, int node) const;
  Vec3 mean(const mfem::Vector& v) const;
  /// Sum over the nodes of all ranks of (x - mean x) (y - mean y)^T.
  Mat3 moment(const mfem::Vector& x, const mfem::Vector& y) const;
  Vec3 angle_of_step(const mfem::Vector& x, const Integrator& motion) const;
  Vec3 angular_velocity(const mfem::Vector& x, const mfem::Vector& v) const;

  int dimension_, nodes_;  // of this rank
  mfem::Vector X_;         // true dofs [m]
};

}  // namespace titin
