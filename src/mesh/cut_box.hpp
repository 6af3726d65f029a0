/// Boxes of simplices whose cuts do not all run along one diagonal, so that the mesh has no direction.
///
/// Alternating: cut by diagonals in turn, into two triangles or five tetrahedra. Crossed: into four triangles around
/// the middle, or into 24 tetrahedra around the middle of the box and those of its faces: what is alike in all its
/// directions.
#pragma once

#include <mfem.hpp>

#include "mesh/mesh.hpp"

namespace titin {

/// `cells` boxes along each edge of [0, edge[0]] x ..., two or three of them; boundaries as MFEM numbers those of its
/// own boxes: y- x+ y+ x-, or z- y- x+ y+ x- z+.
mfem::Mesh make_cut_box(const std::vector<int>& cells, const std::vector<double>& edge, BoxCuts cuts);

}  // namespace titin
