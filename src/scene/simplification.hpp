/// What a scene might do without: inertia, mass, pressure, the third dimension, the limiter.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/mesh_choice.hpp"
#include "scene/scene_facts.hpp"

namespace titin {

struct Simplification {
  enum class Kind { inertia, mass, pressure, dimension, limiter };
  Kind kind;
  std::string what;                    // in words
  std::vector<std::string> overrides;  // make the scene one without it, but for its mesh
  double changes = 0, cost = 1;        // of the quantity; CPU time over that of the probe with it
  std::string problem = "";            // why it cannot be had
  bool taken = false;

  bool can_be_had() const { return problem.empty(); }
  /// The mesh of a scene without it that is as fine.
  MeshChoice mesh(MeshChoice with) const;
};

/// Those that make sense for a scene. `says`: does the scene itself have this key?
std::vector<Simplification> simplifications(const SceneFacts& facts, const std::function<bool(std::string)>& says);

}  // namespace titin
