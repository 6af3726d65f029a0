/// Equilibrium of one material point under mixed control: each component of the deformation gradient F is prescribed,
/// or found so that its component of the first Piola stress P (force per reference area) is what is asked.
///
///     P_iJ(F) = value_iJ         for the components under stress control [Pa]
///     det F = 1, P += p cof F    if incompressible; the volumetric law is left out then
///
/// Newton's method with the exact tangent of the material; its steps are shortened until the residual falls, and where
/// that is not enough the control is approached in parts.
#pragma once

#include <array>
#include <string>

#include "materials/material.hpp"

namespace titin {

enum class Volume { compressible, incompressible };

struct MixedControl {
  std::array<bool, 9> by_stress{};
  Mat3 value = identity;  ///< of F_iJ, or of P_iJ [Pa] under stress control
};

struct PointState {
  Mat3 F = identity, P{};
  double multiplier = 0;  ///< p [Pa] of an incompressible point
};

/// How a search ended: `problem` is "" when equilibrium was found.
struct Outcome {
  int iterations = 0;
  std::string problem;
  bool ok() const { return problem.empty(); }
};

class Equilibrium {
 public:
  /// Keeps a reference to the material.
  Equilibrium(const Material& material, Volume volume) : material_(material), volume_(volume) {}

  /// Moves `state` to the control; a state that cannot get there stays what it was. `step` says time, rate, fibres and
  /// history; its F is not looked at.
  Outcome find(const MixedControl& control, const PointInput& step, PointState& state) const;
  /// The stress of F, multiplier included, and its derivative unless A is null.
  void stress(const PointInput& step, const Mat3& F, double multiplier, Mat3& P, Mat9* A) const;

 private:
  Outcome newton(const MixedControl& control, const PointInput& step, PointState& state) const;

  const Material& material_;
  Volume volume_;
};

}  // namespace titin
