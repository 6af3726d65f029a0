/// Means over the cells in a box, which a scene follows beside single points (mesh/markers.hpp).
#pragma once

#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/markers.hpp"

namespace titin {

/// Cells whose centre lies in this box of the reference configuration: their means are followed.
struct AverageConfig {
  std::string name;
  std::array<double, 3> lower{}, upper{};  // [m]
  std::vector<int> cells;                  // of this rank
};

/// Reads [averages] and finds their cells. Collective.
std::vector<AverageConfig> read_averages(Section& root, const NamedMesh& mesh);

}  // namespace titin
