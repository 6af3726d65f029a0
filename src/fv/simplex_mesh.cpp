#include "fv/simplex_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace titin {
namespace {

/// MFEM's cells in our order.
std::vector<int> order_of_cells(mfem::ParMesh& mesh) {
  mfem::Array<int> place;
  mesh.GetHilbertElementOrdering(place);
  std::vector<int> order(mesh.GetNE());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(mesh.GetAttribute(a), place[a]) < std::pair(mesh.GetAttribute(b), place[b]);
  });
  return order;
}

template <int D>
Vector<D> vertex(const mfem::ParMesh& mesh, int v) {
  Vector<D> x;
  for (int i = 0; i < D; ++i) x[i] = mesh.GetVertex(v)[i];
  return x;
}

}  // namespace

template <int D>
SimplexMesh<D>::SimplexMesh(mfem::ParMesh& mesh) : element_of(order_of_cells(mesh)) {
  std::vector<int> node_of(mesh.GetNV(), -1);
  mfem::Array<int> vertices;
  for (int element : element_of) {
    mesh.GetElementVertices(element, vertices);
    auto& own = nodes_of.emplace_back();
    for (int p = 0; p <= D; ++p) {
      int& node = node_of[vertices[p]];
      if (node < 0) {
        node = static_cast<int>(vertex_of.size());
        vertex_of.push_back(vertices[p]);
        x.push_back(vertex<D>(mesh, vertices[p]));
      }
      own[p] = node;
    }
    if (simplex_volume<D>(corners_of(cells() - 1, x)) < 0) std::swap(own[D - 1], own[D]);
    region.push_back(mesh.GetAttribute(element));
  }
  first_corner.assign(nodes() + 1, 0);
  for (const auto& own : nodes_of)
    for (int node : own) ++first_corner[node + 1];
  std::partial_sum(first_corner.begin(), first_corner.end(), first_corner.begin());
  corners.resize(first_corner.back());
  std::vector<int> next(first_corner.begin(), first_corner.end() - 1);
  for (int c = 0; c < cells(); ++c)
    for (int p = 0; p <= D; ++p) corners[next[nodes_of[c][p]]++] = corners_per_cell * c + p;
  for (int b = 0; b < mesh.GetNBE(); ++b) {
    mesh.GetBdrElementVertices(b, vertices);
    Face face{{}, mesh.GetBdrAttribute(b)};
    for (int p = 0; p < D; ++p) face.nodes[p] = node_of[vertices[p]];
    int element, info;
    mesh.GetBdrElementAdjacentElement(b, element, info);
    mfem::Vector centre;
    mesh.GetElementCenter(element, centre);
    const auto corner = corners_of(face, x);
    const auto N = area_vector<D>(corner);
    double outward = 0;
    for (int i = 0; i < D; ++i) outward += N[i] * (corner[0][i] - centre(i));
    if (outward < 0) std::swap(face.nodes[0], face.nodes[1]);
    boundary.push_back(face);
  }
}

template struct SimplexMesh<2>;
template struct SimplexMesh<3>;

}  // namespace titin
