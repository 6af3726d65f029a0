#include "fv/nodal_solver.hpp"

namespace titin {

template <int D>
NodalSolver<D>::NodalSolver(const SimplexMesh<D>& mesh, NodeExchange& exchange, Boundary<D>& boundary)
    : mesh_(mesh),
      exchange_(exchange),
      boundary_(boundary),
      corners_(static_cast<std::size_t>(D + 1) * mesh.cells()),
      sums_(mesh.nodes()) {}

/// This rank's cells and loads.
template <int D>
void NodalSolver<D>::add_corners(int node) {
  NodeSum sum{};
  for (int k = mesh_.first_corner[node]; k < mesh_.first_corner[node + 1]; ++k) {
    const CornerForce<D>& corner = corners_[mesh_.corners[k]];
    accumulate(sum.M, 1, corner.M);
    accumulate(sum.b, 1, corner.b);
  }
  if (const int place = boundary_.place(node); place >= 0) accumulate(sum.b, 1, boundary_.load(place));
  sums_[node] = sum;
}

template <int D>
Vector<D> NodalSolver<D>::velocity(int node, const std::vector<Vector<D>>& x) const {
  const NodeSum& sum = sums_[node];
  const int place = boundary_.place(node);
  if (place >= 0) return boundary_.velocity(place, sum.M, sum.b, x[node]);
  return Directions<D>{}.solve(sum.M, sum.b);
}

template <int D>
void NodalSolver<D>::solve(const std::vector<Vector<D>>& x, std::vector<Vector<D>>& v) {
  for (int p = 0; p < mesh_.nodes(); ++p) add_corners(p);
  exchange_.sum(&sums_[0].M[0], sizeof(NodeSum) / sizeof(double));
  for (int p = 0; p < mesh_.nodes(); ++p) v[p] = velocity(p, x);
}

template <int D>
void NodalSolver<D>::solve(const std::vector<int>& nodes, const std::vector<Vector<D>>& x, std::vector<Vector<D>>& v) {
  for (int p : nodes) add_corners(p);
  for (int p : exchange_.shared()) add_corners(p);  // sums over ranks begin from this rank's part
  exchange_.sum(&sums_[0].M[0], sizeof(NodeSum) / sizeof(double));
  for (int p : nodes) v[p] = velocity(p, x);
}

template class NodalSolver<2>;
template class NodalSolver<3>;

}  // namespace titin
