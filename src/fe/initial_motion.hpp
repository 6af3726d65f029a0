/// How a body moves when a run begins: as a rigid one and by a named motion, with its forces at once.
///
///   v_0(X) = velocity + spin x (X - centre) + motion(X),   M a_0 + f(u_0) = 0 at free dofs, a_0 = 0 where
///   displacements are given
#pragma once

#include <array>
#include <mfem.hpp>

#include "base/config.hpp"
#include "mesh/mesh.hpp"
#include "mesh/named_motion.hpp"

namespace titin {

class MuscleSystem;

struct InitialMotion {
  std::array<double, 3> velocity{}, spin{}, centre{};  // [m/s], [rad/s], [m]
  NamedMotion motion;
  void bind(Section& s, const NamedMesh& mesh);
  mfem::Vector at_dofs(mfem::ParFiniteElementSpace& space) const;  ///< true dofs [m/s]
};

/// [m/s^2] at true dofs, from the residual at the start [N]; `thickness` [m] of a plane body, 1 for solid ones.
/// Collective.
mfem::Vector initial_acceleration(MuscleSystem& system, double thickness, const mfem::Vector& residual);

}  // namespace titin
