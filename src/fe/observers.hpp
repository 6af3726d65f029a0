/// What a scene follows in space: single points, and means over the cells in a box.
#pragma once

#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

/// A point of the undeformed body whose displacement is followed.
struct MarkerConfig {
  std::string name;
  std::array<double, 3> position{};  // [m] in the reference configuration
  int cell = -1;                     // of this rank that holds it; -1: another rank has it
  mfem::IntegrationPoint place;      // in that cell
};

/// Cells whose centre lies in this box of the reference configuration: their means are followed.
struct AverageConfig {
  std::string name;
  std::array<double, 3> lower{}, upper{};  // [m]
  std::vector<int> cells;                  // of this rank
};

/// Reads [markers] and finds them. Collective.
std::vector<MarkerConfig> read_markers(Section& root, const NamedMesh& mesh);
/// Reads [averages] and finds their cells. Collective.
std::vector<AverageConfig> read_averages(Section& root, const NamedMesh& mesh);

}  // namespace titin
