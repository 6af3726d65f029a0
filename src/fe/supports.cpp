#include "fe/supports.hpp"

#include <algorithm>
#include <cmath>

#include "math/tensor.hpp"

namespace titin {
namespace {

Vec3 displacement(const SupportPoint& point, const double* u) {
  Vec3 at{};
  for (int i = 0; i < point.dimension; ++i)
    for (int a = 0; a < point.nodes; ++a) at[i] += point.N[a] * u[i * point.nodes + a];
  return at;
}

double gap(const WallConfig& wall, double time, const SupportPoint& point, const Vec3& u) {
  double g = -wall.travel(time);
  for (int i = 0; i < 3; ++i) g += wall.normal[i] * (point.X[i] + u[i] - wall.point[i]);
  return g;
}

void bind_wall(Section s, WallConfig& wall) {
  wall.given = true;
  s.read("point", wall.point, {.unit = "m", .required = true, .doc = "a point of the plane"});
  s.read("normal", wall.normal, {.required = true, .doc = "of the plane, towards the body; any length but zero"});
  const double length = norm(wall.normal);
  if (s.has("normal") && !(length > 0))
    s.error("normal", "a vector of zero length has no direction", "give [0, 0, 1], say");
  for (double& n : wall.normal) n = length > 0 ? n / length : 0;
  s.read("penalty", wall.penalty,
         {.unit = "Pa/m",
          .range = positive,
          .required = true,
          .doc = "pressure over depth: take the pressure you expect over the depth that you allow"});
  s.read(
      "gap_tolerance", wall.gap_tolerance,
      {.unit = "m",
       .range = non_negative,
       .doc = "how far the body may pass the plane, met by repeating the step's solve with better pressures; 0: what "
              "the penalty leaves"});
  s.read("travel", wall.travel, {.unit = "m", .doc = "of the plane along its normal, constant or in time"});
}

}  // namespace

void SupportConfig::bind(Section& boundary) {
  boundary.read(
      "spring", spring,
      {.unit = "N/m", .range = non_negative, .doc = "springs to ground along x, y, z, of the boundary as a whole"});
  boundary.read(
      "damper", damper,
      {.unit = "N s/m", .range = non_negative, .doc = "dampers to ground along x, y, z, of the boundary as a whole"});
  if (boundary.has("wall") || boundary.describing())
    bind_wall(boundary.section("wall", "a rigid plane that the boundary may touch but not pass"), wall);
}

double wall_pressure(const WallConfig& wall, double time, const SupportPoint& point, const double* u) {
  return std::max(0.0, point.multiplier - wall.penalty * gap(wall, time, point, displacement(point, u)));
}

void add_support(const SupportConfig& support, double time, const SupportPoint& point, const SupportMotion& motion,
                 double* r, double* K) {
  const Vec3 at = displacement(point, motion.u), rate = motion.v ? displacement(point, motion.v) : Vec3{};
  Vec3 minus_force;
  Mat3 stiffness{};
  for (int i = 0; i < 3; ++i) {
    minus_force[i] = point.share * (support.spring[i] * at[i] + support.damper[i] * rate[i]);
    stiffness[4 * i] = point.share * (support.spring[i] + motion.velocity_factor * support.damper[i]);
  }
  const WallConfig& wall = support.wall;
  const double pressure = wall.given ? point.multiplier - wall.penalty * gap(wall, time, point, at) : -1;
  if (pressure >= 0) {  // what stands on the wall at the start is held by it
    for (int i = 0; i < 3; ++i) minus_force[i] -= point.area * pressure * wall.normal[i];
    add(stiffness, wall.penalty * point.area, dyad(wall.normal, wall.normal));
  }
  const int nodes = point.nodes, n = point.dimension * nodes;
  for (int i = 0; i < point.dimension; ++i)
    for (int a = 0; a < nodes; ++a) {
      r[i * nodes + a] += minus_force[i] * point.N[a];
      for (int c = 0; c < n && K; ++c)
        K[(i * nodes + a) * n + c] += stiffness[3 * i + c / nodes] * point.N[a] * point.N[c % nodes];
    }
}

void add_state(const SupportConfig& support, double time, const SupportPoint& point, const SupportMotion& motion,
               SupportState& state) {
  const Vec3 at = displacement(point, motion.u), rate = motion.v ? displacement(point, motion.v) : Vec3{};
  for (int i = 0; i < 3; ++i) {
    const double held = 0.5 * point.share * support.spring[i] * at[i] * at[i];
    state.force[i] -= point.share * (support.spring[i] * at[i] + support.damper[i] * rate[i]);
    state.energy += held;
    state.dissipation += point.share * support.damper[i] * rate[i] * rate[i];
    state.potential += held;
  }
  const WallConfig& wall = support.wall;
  if (!wall.given) return;
  const double g = gap(wall, time, point, at), depth = std::max(0.0, -g);
  const double pressure = wall_pressure(wall, time, point, motion.u);
  state.gap = std::min(state.gap, g);
  for (int i = 0; i < 3; ++i) state.force[i] += point.area * pressure * wall.normal[i];
  state.energy += 0.5 * wall.penalty * point.area * depth * depth;
  state.potential += 0.5 * point.area / wall.penalty * (pressure * pressure - point.multiplier * point.multiplier);
}

}  // namespace titin
