/// Vectors in a scene: three components in space, two in a plane body.
#pragma once

#include <array>
#include <string_view>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

/// Reads a place, a force or a velocity; of a plane body x and y, and z becomes zero. Anything else is reported.
void read_vector(Section& s, std::string_view name, std::array<double, 3>& value, Key key, const NamedMesh& mesh);

}  // namespace titin
