/// Boundaries whose forces are also followed by their moment about a point, M = sum (x - point) x f [N m].
#pragma once

#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

struct TorqueConfig {
  std::string boundary;           // name of its table
  int index = -1;                 // of the boundary among the names
  std::array<double, 3> point{};  // fixed in space [m]
};

/// Reads [torques]; `boundaries` are the names of the tables [boundary.NAME].
std::vector<TorqueConfig> read_torques(Section& root, const std::vector<std::string>& boundaries,
                                       const NamedMesh& mesh);

/// The first axis about which a body of this dimension has a moment: a plane one turns about z only.
constexpr int first_torque_axis(int dimension) { return dimension == 2 ? 2 : 0; }

}  // namespace titin
