/// Velocities of nodes from the forces that the cells around them exert (EUCCLHYD with sub-face impedances).
///
/// The force of cell c on its corner at node p is f_pc = T_pc (a n)_pc + M_pc (v_p - v_pc), where T_pc and v_pc are the
/// cell's stress and velocity at the node and M_pc = sum over the cell's faces f at p of z A_f / D n_f (x) n_f, z the
/// acoustic impedance. The forces around a node balance the external one:
///
///   (sum_c M_pc) v_p = sum_c [M_pc v_pc - T_pc (a n)_pc] + F_p.
///
/// Because cells take up the same f_pc with the same v_p, momentum and total energy are kept to round-off for any T_pc.
/// Maire, Abgrall, Breil, Ovadia (2007), SIAM J. Sci. Comput. 29:1781; Maire (2009), J. Comput. Phys. 228:2391, sec. 3;
/// Boscheri, Loubere, Maire (2022), J. Comput. Phys. 449:110779. A simplex has D faces at a corner: M_pc is definite.
#pragma once

#include <vector>

#include "fv/boundary.hpp"

namespace titin {

/// What a corner brings to its node: f = M v - b.
template <int D>
struct CornerForce {
  Symmetric<D> M{};  // [kg/s]
  Vector<D> b{};     // [N]
  Vector<D> force(const Vector<D>& v) const { return difference(product<D>(M, v), b); }
};

/// Of all corners of a cell: corner normals of the simplex and impedance z [kg/(m^2 s)] give M.
template <int D>
std::array<Symmetric<D>, D + 1> corner_impedances(const Corners<D>& normals, double z) {
  std::array<Symmetric<D>, D + 1> face, M;
  Symmetric<D> all{};
  for (int p = 0; p <= D; ++p) {  // face opposite to p: area vector -D (a n)_p, so A n (x) n = D (an)(an) / |an|
    face[p] = {};
    add_square<D>(face[p], z / norm(normals[p]), normals[p]);
    accumulate(all, 1, face[p]);
  }
  for (int p = 0; p <= D; ++p) M[p] = difference(all, face[p]);
  return M;
}

template <int D>
class NodalSolver {
 public:
  NodalSolver(const SimplexMesh<D>& mesh, NodeExchange& exchange, Boundary<D>& boundary);

  /// [corner]; whoever predicts the cells writes them.
  CornerForce<D>* corners(int cell) { return &corners_[(D + 1) * cell]; }
  const CornerForce<D>* corners(int cell) const { return &corners_[(D + 1) * cell]; }

  /// Velocities v of all nodes; x is where they were at the start of the step. Collective.
  void solve(const std::vector<Vector<D>>& x, std::vector<Vector<D>>& v);
  /// The same for these nodes alone, which all ranks that share one must name. Collective.
  void solve(const std::vector<int>& nodes, const std::vector<Vector<D>>& x, std::vector<Vector<D>>& v);

 private:
  struct NodeSum {
    Symmetric<D> M;
    Vector<D> b;
  };
  void add_corners(int node);
  Vector<D> velocity(int node, const std::vector<Vector<D>>& x) const;

  const SimplexMesh<D>& mesh_;
  NodeExchange& exchange_;
  Boundary<D>& boundary_;
  std::vector<CornerForce<D>> corners_;
  std::vector<NodeSum> sums_;  // [node]
};

extern template class NodalSolver<2>;
extern template class NodalSolver<3>;

}  // namespace titin
