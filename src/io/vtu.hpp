/// VTK's XML files of unstructured grids: a .vtu for each rank, binary and compressed, and the .pvtu that names them.
#pragma once

#include <string>
#include <vector>

#include "io/drawn_mesh.hpp"

namespace titin {

enum class Digits { single, twofold };

/// This rank's piece: `points` and `cells` are what `mesh` has at this time. Throws OutputError.
void write_vtu(const std::string& path, DrawnMesh& mesh, const std::vector<double>& positions,
               const std::vector<DrawnArray>& points, const std::vector<DrawnArray>& cells, Digits precision);

/// The text of the .pvtu; `pieces` are paths beside it.
std::string pvtu_text(const std::vector<std::string>& pieces, const std::vector<DrawnArray>& points,
                      const std::vector<DrawnArray>& cells, Digits precision);

}  // namespace titin
