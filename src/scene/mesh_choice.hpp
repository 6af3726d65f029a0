/// How fine a scene is: cells along the edges of a box, refinements of a mesh from a file, elements or masses of a rod.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene_facts.hpp"

namespace titin {

struct MeshChoice {
  std::string key = "mesh.cells";  // "": one element without mass, nothing to choose
  std::vector<int> cells;          // empty: from a file
  int refine = 0;

  /// What the scene says.
  static MeshChoice of(const SceneFacts& facts);
  /// As on the command line.
  std::vector<std::string> overrides() const;
  std::string words() const;  ///< "4 x 2 x 2 cells"
  /// Half as many cells along every edge, rounded up, or one refinement less; none where that is the same.
  std::optional<MeshChoice> halved() const;
  /// At least this many times the cells along every edge.
  MeshChoice scaled(double factor) const;
  /// Cells along an edge over those of `from`, the geometric mean of all edges.
  double over(const MeshChoice& from) const;
  std::size_t dimension() const { return cells.empty() ? 3 : cells.size(); }
};

}  // namespace titin
