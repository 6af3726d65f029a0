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
  s.read("travel", wall.travel, {.unit = "m", .doc = "of the plane along its normal, constant or in time"});
}

}  // namespace

void SupportConfig::bind(Section& boundary) {
  boundary.read(
      "spring", spring,
      {.unit = "N/m", .range = non_negative, .doc = "springs to ground along x, y, z, of the boundary as a whole"});
  if (boundary.has("wall") || boundary.describing())
    bind_wall(boundary.section("wall", "a rigid plane that the boundary may touch but not pass"), wall);
}

void add_support(const SupportConfig& support, double time, const SupportPoint& point, const double* u, double* r,
                 double* K) {
  const Vec3 at = displacement(point, u);
  Vec3 minus_force;
  Mat3 stiffness{};
  for (int i = 0; i < 3; ++i) {
    stiffness[4 * i] = support.spring[i] * point.share;
    minus_force[i] = stiffness[4 * i] * at[i];
  }
  const double g = support.wall.given ? gap(support.wall, time, point, at) : 1;
  if (g <= 0) {  // what stands on the wall at the start is held by it
    const double push = support.wall.penalty * point.area;
    for (int i = 0; i < 3; ++i) minus_force[i] += push * g * support.wall.normal[i];
    add(stiffness, push, dyad(support.wall.normal, support.wall.normal));
  }
  const int nodes = point.nodes, n = point.dimension * nodes;
  for (int i = 0; i < point.dimension; ++i)
    for (int a = 0; a < nodes; ++a) {
      r[i * nodes + a] += minus_force[i] * point.N[a];
      for (int c = 0; c < n && K; ++c)
        K[(i * nodes + a) * n + c] += stiffness[3 * i + c / nodes] * point.N[a] * point.N[c % nodes];
    }
}

void add_state(const SupportConfig& support, double time, const SupportPoint& point, const double* u,
               SupportState& state) {
  const Vec3 at = displacement(point, u);
  for (int i = 0; i < 3; ++i) {
    const double stiffness = support.spring[i] * point.share;
    state.force[i] -= stiffness * at[i];
    state.energy += 0.5 * stiffness * at[i] * at[i];
  }
  if (!support.wall.given) return;
  const double g = gap(support.wall, time, point, at), push = support.wall.penalty * point.area;
  state.gap = std::min(state.gap, g);
  if (g >= 0) return;
  for (int i = 0; i < 3; ++i) state.force[i] -= push * g * support.wall.normal[i];
  state.energy += 0.5 * push * g * g;
}

}  // namespace titin
