/// What holds a boundary without prescribing it: springs to ground, and rigid walls that it may touch but not pass.
///
/// spring: force -k_i u_i on the whole boundary, shared out by reference area:  t_i = -(k_i / A) u_i.
/// wall: a plane n . (x - point) = travel(t), free of friction, met by a penalty:  t = -penalty min(g, 0) n with the
/// gap g = n . (x - point) - travel of a point x of the body. The body sinks in by pressure / penalty, which `gap`
/// tells. Both have a potential, so the tangent stays symmetric.
#pragma once

#include <array>
#include <vector>

#include "base/config.hpp"

namespace titin {

struct WallConfig {
  bool given = false;
  std::array<double, 3> point{}, normal{};  // [m]; of unit length, towards the body
  double penalty = 0;                       // [Pa/m]
  Table travel;                             // along the normal [m]
};

struct SupportConfig {
  std::array<double, 3> spring{};  // [N/m] of the whole boundary, by component
  WallConfig wall;
  bool has_spring() const { return spring != std::array<double, 3>{0, 0, 0}; }
  bool given() const { return has_spring() || wall.given; }
  void bind(Section& boundary);
};

/// A point of a boundary face where supports act.
struct SupportPoint {
  const double* N = nullptr;  ///< shapes [nodes]
  int nodes = 0, dimension = 3;
  double area = 0, share = 0;  ///< of the reference area: [m^2], and over the whole boundary's
  std::array<double, 3> X{};   ///< [m]
};

/// What supports do to a boundary, summed over points.
struct SupportState {
  double gap = 0;                 ///< smallest [m]
  std::array<double, 3> force{};  ///< on the body [N]
  double energy = 0;              ///< [J]
};

/// Adds minus the force to r [components][nodes] and, unless null, its derivative to K.
void add_support(const SupportConfig& support, double time, const SupportPoint& point, const double* u, double* r,
                 double* K);
void add_state(const SupportConfig& support, double time, const SupportPoint& point, const double* u,
               SupportState& state);

}  // namespace titin
