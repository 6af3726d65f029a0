/// Watches over a run whether its material resists every small band of shear (materials/ellipticity.hpp): the smallest
/// Legendre-Hadamard value of each cell [Pa], of the tangent that the step was solved with. Where it is negative, bands
/// of no width are at hand, and what follows depends on the mesh: a warning says so when that happens first.
#pragma once

#include <vector>

#include "fe/muscle_system.hpp"
#include "solve/model.hpp"

namespace titin {

class EllipticityWatch {
 public:
  explicit EllipticityWatch(MuscleSystem& system) : system_(system) {}

  /// Takes in an accepted state. Collective.
  void update(const mfem::Vector& u, const StepState& step);
  void walk(StateWalk& walk) { walk.number("warned_of_ellipticity", warned_); }
  const std::vector<double>& smallest() const { return smallest_; }  ///< of each cell of this rank [Pa]
  /// The smallest value of all, and in how many cells it is negative. Collective.
  std::vector<Quantity> quantities() const;

 private:
  void warn(double time);

  MuscleSystem& system_;
  std::vector<double> smallest_;
  bool warned_ = false;
};

}  // namespace titin
