/// A plane box of triangles whose cuts do not all run along one diagonal: boxes cut by diagonals in turn, so that the
/// mesh has no direction, or each cut into four around its middle, so that all corners of boxes have eight triangles.
#pragma once

#include <mfem.hpp>

#include "mesh/mesh.hpp"

namespace titin {

/// [0, a] x [0, b] in nx by ny boxes; boundaries by MFEM's numbers: 1 y-, 2 x+, 3 y+, 4 x-.
mfem::Mesh make_plane_triangles(int nx, int ny, double a, double b, BoxCuts cuts);

}  // namespace titin
