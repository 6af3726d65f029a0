/// How the whole body moves: kinetic energy, momentum, and angular momentum about the origin,
///
///   T = int rho v . v / 2 dV,   p = int rho v dV,   L = int rho (X + u) x v dV   over the undeformed body,
///
/// by the quadrature of the inertia in the weak form and with positions of its own test functions: what a scheme keeps
/// stays to the solver's tolerance whatever the mesh. Loads on rails are no part of the body. SI units.
#pragma once

#include <vector>

#include "fe/muscle_system.hpp"
#include "fe/places_of_dofs.hpp"
#include "solve/model.hpp"

namespace titin {

class Momenta {
 public:
  explicit Momenta(MuscleSystem& system) : system_(system), X_(places_of_dofs(system.space())) {}

  /// Takes in an accepted motion: true-dof vectors [m], [m/s].
  void update(const mfem::Vector& u, const mfem::Vector& v);
  double kinetic() const { return kinetic_; }  ///< this rank's part [J]
  /// Adds the columns of both momenta; none of bodies without inertia. Collective.
  void list(std::vector<Quantity>& quantities) const;

 private:
  Vec3 at_point(int cell, int q, const std::vector<double>& values) const;
  bool moving() const { return system_.config().inertia == Inertia::dynamic; }

  const MuscleSystem& system_;
  mfem::Vector X_;
  double kinetic_ = 0;         // of this rank, as the others [J]
  Vec3 linear_{}, angular_{};  // [kg m/s], [kg m^2/s]
};

}  // namespace titin
