/// Cells that are inside out: the map from the reference cell has no positive volume somewhere.
#pragma once

#include "mesh/mesh.hpp"

namespace titin {

/// Cells of this rank that are so at points inside, of a quadrature: no mesh to compute on.
int inverted_cells(mfem::ParMesh& mesh);

/// Warns of cells that are so at a corner, which no quadrature meets: they run, and what they give is wrong.
/// Collective.
void warn_of_inverted_corners(const NamedMesh& mesh);

}  // namespace titin
