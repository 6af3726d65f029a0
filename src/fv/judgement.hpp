/// What is wrong with a cell of a step that was tried: the detectors of MOOD (fv/mood.hpp lowers the orders).
///
/// Computer and physics: finite numbers, a volume, a state that the material knows. A relaxed maximum principle on
/// density, mean stress and velocity, which a smooth flow may leave. Shocks within a cell of a fluid, and heat that a
/// solid has lost: docs/theory/lagrange.md. Clain, Diot, Loubere (2011), J. Comput. Phys. 230:4028.
#pragma once

#include <vector>

#include "fv/closure.hpp"
#include "fv/fv_config.hpp"
#include "fv/reconstruct.hpp"
#include "fv/state.hpp"

namespace titin {

/// What is judged: all of the scheme's, alive and in place as long as that is.
template <int D>
struct Judged {
  const SimplexMesh<D>& mesh;
  const FvConfig& config;
  const std::vector<const Closure*>& closure;  // of cells
  const Reconstruction<D>& reconstruction;
  const FlowState<D>&before, &after;  // the accepted state, and that of the step tried from it
};

template <int D>
class Judgement : private Judged<D> {
 public:
  explicit Judgement(const Judged<D>& judged) : Judged<D>(judged) {}

  /// Computer and physics.
  bool has_meaning(int cell) const;
  /// Anything: after a step of length dt whose slopes are those of `from`.
  bool in_trouble(int cell, const FlowState<D>& from, double dt) const;
  /// Does it ask what cells of this material store?
  bool asks_for_heat(const Closure& closure) const;

 private:
  struct NodeJumps {       // largest over a cell's nodes [m/s]
    double variation = 0;  // from its mean velocity
    double jump = 0;       // from its linear velocity
  };
  NodeJumps node_jumps(int cell, const FlowState<D>& from, const Slopes<D>& g) const;
  Vector<D> mean_velocity(int cell) const;
  bool is_smooth(int cell, const NodeJumps& at) const;
  bool is_shocked(int cell, const FlowState<D>& from) const;
  bool has_lost_heat(int cell, const FlowState<D>& from) const;

  using Judged<D>::mesh, Judged<D>::config, Judged<D>::closure, Judged<D>::reconstruction, Judged<D>::before,
      Judged<D>::after;
};

extern template class Judgement<2>;
extern template class Judgement<3>;

}  // namespace titin
