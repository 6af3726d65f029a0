#include "mesh/torques.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/words.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {

std::vector<TorqueConfig> read_torques(Section& root, const std::vector<std::string>& boundaries,
                                       const NamedMesh& mesh) {
  Section points = root.section("torques",
                                "boundaries whose forces are also followed by their moment, columns torque_NAME_x and "
                                "so on: NAME = \"x, y, z mm\" (of a plane body \"x, y mm\"), the point it is about");
  std::vector<TorqueConfig> torques;
  for (const std::string& name : points.names()) {
    TorqueConfig torque{name, -1, {}};
    read_vector(points, name, torque.point, {.unit = "m", .doc = "the point, fixed in space"}, mesh);
    const auto found = std::find(boundaries.begin(), boundaries.end(), name);
    if (found != boundaries.end())
      torque.index = static_cast<int>(found - boundaries.begin());
    else if (!points.describing())
      points.error(name, fmt::format("there is no table [boundary.{}]", name),
                   boundaries.empty() ? "add it" : fmt::format("name one of: {}", fmt::join(boundaries, ", ")));
    torques.push_back(torque);
  }
  return torques;
}

}  // namespace titin
