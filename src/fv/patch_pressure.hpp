/// Against volumetric locking: pressures of solids that are averaged over the patches of cells about nodes.
///
/// F of a simplex follows its nodes, so each cell has a volume of its own to keep: about two to a node in the plane,
/// more than five in space, more than the nodes have motions. With J_p = sum |w_c| / sum |w_c0| over the cells of one
/// region about node p, the volumetric part of a cell's stress is the mean of dU/dJ(J_p) over its corners instead of
/// dU/dJ(J_c). Their power is the rate of sum_p W_p U(J_p), W_p = sum |w_c0| / (D + 1): an energy is stored, and the
/// scheme keeps momentum and total energy whatever the stress is. Bonet & Burton (1998), Commun. Numer. Methods Eng.
/// 14:437. Units SI.
#pragma once

#include <vector>

#include "fv/closure.hpp"
#include "fv/node_exchange.hpp"
#include "fv/state.hpp"
#include "solve/state_walk.hpp"

namespace titin {

template <int D>
class PatchPressure {
 public:
  /// `closure` of each cell; volumes at rest are those of the mesh. Collective.
  PatchPressure(const SimplexMesh<D>& mesh, NodeExchange& exchange, const std::vector<const Closure*>& closure);

  /// Turns the stresses of cells into those with averaged pressures. Collective.
  void apply(FlowState<D>& state);
  void walk(StateWalk& walk, const StateRows& cells) {
    walk.records("patch_shift", cells, 2,
                 [&](std::size_t c, auto take) { take(shift_[c].first), take(shift_[c].second); });
  }
  /// What was added to the mean stress [Pa], and to the energy stored per volume at rest [J/m^3].
  double stress(int cell) const { return shift_[cell].first; }
  double energy(int cell) const { return shift_[cell].second; }

 private:
  struct Patch {  // the cells of a region about a node
    int node, region;
    double at_rest = 0, now = 0;  // their volume
    Closure::Volumetric law{};
    bool is_known = false;
  };
  void find_patches();
  void sum_over_ranks();

  const SimplexMesh<D>& mesh_;
  NodeExchange& exchange_;
  const std::vector<const Closure*>& closure_;
  std::vector<int> region_;                       // [cell] from 0
  int regions_ = 0;                               // of all ranks
  std::vector<Patch> patches_;                    // of this rank
  std::vector<std::array<int, D + 1>> patch_of_;  // [cell]
  std::vector<double> volume_at_rest_;            // [cell]
  std::vector<double> at_nodes_;                  // [node][region]
  std::vector<std::pair<double, double>> shift_;  // [cell]
};

extern template class PatchPressure<2>;
extern template class PatchPressure<3>;

}  // namespace titin
