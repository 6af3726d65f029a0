/// A rank's part of a mesh of triangles or tetrahedra as flat arrays, numbered for locality.
///
/// Cells are sorted by region, then along a Hilbert curve; nodes by the first cell that meets them. A corner is
/// (D + 1) * cell + its place in the cell; `corners` lists those of a node.
#pragma once

#include <mfem.hpp>
#include <vector>

#include "mesh/simplex_geometry.hpp"

namespace titin {

template <int D>
struct SimplexMesh {
  static constexpr int corners_per_cell = D + 1;
  struct Face {
    std::array<int, D> nodes;  // in the order that makes the area vector point outward
    int attribute;             // MFEM's
  };

  /// All cells must be simplices of dimension D.
  explicit SimplexMesh(mfem::ParMesh& mesh);

  int cells() const { return static_cast<int>(nodes_of.size()); }
  int nodes() const { return static_cast<int>(vertex_of.size()); }
  Corners<D> corners_of(int cell, const std::vector<Vector<D>>& x) const {
    Corners<D> corner;
    for (int p = 0; p <= D; ++p) corner[p] = x[nodes_of[cell][p]];
    return corner;
  }
  std::array<Vector<D>, D> corners_of(const Face& face, const std::vector<Vector<D>>& x) const {
    std::array<Vector<D>, D> corner;
    for (int p = 0; p < D; ++p) corner[p] = x[face.nodes[p]];
    return corner;
  }

  std::vector<std::array<int, D + 1>> nodes_of;  // [cell]
  std::vector<int> first_corner, corners;        // corners of node p: [first_corner[p], first_corner[p + 1])
  std::vector<Face> boundary;
  std::vector<Vector<D>> x;                // [node] as loaded [m]
  std::vector<int> region;                 // [cell] MFEM's attribute
  std::vector<int> element_of, vertex_of;  // MFEM's numbers of our cells and nodes
};

extern template struct SimplexMesh<2>;
extern template struct SimplexMesh<3>;

}  // namespace titin
