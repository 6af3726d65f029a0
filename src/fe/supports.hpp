/// What holds a boundary without prescribing it: springs and dampers to ground, and rigid walls that it may touch but
/// not pass.
///
/// spring, damper: force -k_i u_i - c_i v_i on the whole boundary, shared out by reference area.
/// wall: a plane n . (x - point) = travel(t), free of friction, met by an augmented penalty,
///   t = max(0, multiplier - penalty g) n,   g = n . (x - point) - travel   at a point x of the body;
/// with a gap_tolerance, multiplier <- max(0, multiplier - penalty g) until it changes by less than penalty *
/// gap_tolerance (method of multipliers; Simo, Laursen 1992, Comput. Struct. 42:97); without, the body sinks in by
/// pressure / penalty. In a step all derive from a potential, so the tangent stays symmetric.
#pragma once

#include <array>
#include <vector>

#include "base/config.hpp"

namespace titin {

struct WallConfig {
  bool given = false;
  std::array<double, 3> point{}, normal{};  // [m]; of unit length, towards the body
  double penalty = 0;                       // [Pa/m]
  double gap_tolerance = 0;                 // [m]; 0: penalty alone
  Table travel;                             // along the normal [m]
};

struct SupportConfig {
  std::array<double, 3> spring{}, damper{};  // [N/m], [N s/m] of the whole boundary, by component
  WallConfig wall;
  bool has_spring() const { return spring != std::array<double, 3>{0, 0, 0}; }
  bool has_damper() const { return damper != std::array<double, 3>{0, 0, 0}; }
  bool given() const { return has_spring() || has_damper() || wall.given; }
  void bind(Section& boundary);
};

/// A point of a boundary face where supports act.
struct SupportPoint {
  const double* N = nullptr;  ///< shapes [nodes]
  int nodes = 0, dimension = 3;
  double area = 0, share = 0;  ///< of the reference area: [m^2], and over the whole boundary's
  std::array<double, 3> X{};   ///< [m]
  double multiplier = 0;       ///< pressure that augmentation found [Pa]
};

/// Of a cell, [components][nodes].
struct SupportMotion {
  const double* u = nullptr;   ///< [m]
  const double* v = nullptr;   ///< [m/s]; null: at rest
  double velocity_factor = 0;  ///< dv / du [1/s]
};

/// What supports do to a boundary, summed over points.
struct SupportState {
  double gap = 0;                 ///< smallest [m]
  std::array<double, 3> force{};  ///< on the body [N]
  double energy = 0;              ///< [J]
  double dissipation = 0;         ///< power of dampers [W]
  double potential = 0;           ///< the same with what multipliers add: its slope is minus the force, dampers apart
};

/// Adds minus the force to r [components][nodes] and, unless null, its derivative to K.
void add_support(const SupportConfig& support, double time, const SupportPoint& point, const SupportMotion& motion,
                 double* r, double* K);
void add_state(const SupportConfig& support, double time, const SupportPoint& point, const SupportMotion& motion,
               SupportState& state);
/// Pressure of the wall on the point [Pa]: the next multiplier.
double wall_pressure(const WallConfig& wall, double time, const SupportPoint& point, const double* u);

}  // namespace titin
