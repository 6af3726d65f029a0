#include "scene/simplification.hpp"

#include <fmt/format.h>

namespace titin {
namespace {

using Kind = Simplification::Kind;

/// What makes a plane scene of a box that is held between z- and z+; empty where it is not.
std::vector<std::string> in_the_plane(const SceneFacts& facts) {
  const auto box = facts.numbers("mesh.box");
  if (box.size() != 3) return {};
  for (const std::string side : {"boundary.z-", "boundary.\"z+\""})
    if (facts.text(side + ".displacement.z") != "0 m" || facts.has(side + ".displacement.x") ||
        facts.has(side + ".displacement.y") || facts.text(side + ".traction") != "0, 0, 0 Pa")
      return {};
  return {"~boundary.z-", "~boundary.\"z+\"", fmt::format("mesh.box={}, {} m", box[0], box[1]),
          fmt::format("mesh.thickness={} m", box[2])};
}

}  // namespace

MeshChoice Simplification::mesh(MeshChoice with) const {
  if (kind == Kind::dimension) with.cells.resize(2);
  if (kind == Kind::mass) with.key = "", with.cells = {1};
  return with;
}

std::vector<Simplification> simplifications(const SceneFacts& facts, const std::function<bool(std::string)>& says) {
  std::vector<Simplification> list;
  const auto is = [&](const char* key, const char* value) { return facts.text(key) == value; };
  const auto and_not = [&](std::vector<std::string> overrides, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (says(key)) overrides.push_back(fmt::format("~{}", key));
    return overrides;
  };
  if (is("muscle.inertia", "dynamic"))
    list.push_back(
        {Kind::inertia, "without inertia and rates", and_not({"muscle.inertia=quasi-static"}, {"time.scheme"})});
  if (is("rod.inertia", "dynamic") && !is("rod.kind", "massless"))
    list.push_back(
        {Kind::mass, "without mass",
         and_not({"rod.kind=massless"}, {"rod.cells", "rod.masses", "rod.order", "rod.spacing", "time.scheme"})});
  if (is("muscle.element", "three_field"))
    list.push_back({Kind::pressure, "displacement alone", {"muscle.element=displacement"}});
  if (const auto plane = in_the_plane(facts); !plane.empty()) list.push_back({Kind::dimension, "in the plane", plane});
  if (is("fv.limiter", "mood")) list.push_back({Kind::limiter, "without limiter", {"fv.limiter=none"}});
  return list;
}

}  // namespace titin
