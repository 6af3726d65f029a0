#include "fv/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace titin {
namespace {

/// A step whose cells change their volumes by more than this many times the bound it was chosen for is taken again.
constexpr double volume_margin = 2;
/// A cell whose nodes miss its linear velocity by less than this part of their differences is strained as a whole,
/// which no jump in it does.
constexpr double linear_flow = 0.05;
/// Part of a cell's energy that is round-off in its heat.
constexpr double heat_round_off = 1e-12;

}  // namespace

/// Computer and physics: numbers, a volume, a state that the material knows.
template <int D>
bool Judgement<D>::has_meaning(int cell) const {
  const CellRecord<D>& c = after.cell[cell];
  const double sum = std::accumulate(c.q.begin(), c.q.end(), after.energy[cell] + after.speed[cell]);
  const double change = std::abs(after.volume[cell] - before.volume[cell]);
  return std::isfinite(sum) && after.volume[cell] > 0 &&
         change <= volume_margin * config.volume_change * before.volume[cell] &&
         closure[cell]->admissible(c.density, after.internal_energy(cell));
}

/// The maximum principle, which a smooth flow may leave: a compression without a jump raises the largest density too,
/// and a body that is accelerated as a whole leaves all its velocities.
template <int D>
bool Judgement<D>::in_trouble(int cell, const FlowState<D>& from, double dt) const {
  if (!has_meaning(cell) || is_shocked(cell, from) || has_lost_heat(cell, from)) return true;
  constexpr int judged = Reconstruction<D>::judged_count;
  const double density = before.cell[cell].density, c = before.speed[cell];
  std::array<double, judged> scale{density, density * c * c};
  std::fill_n(scale.begin() + 2, D, c);
  const auto candidate = Reconstruction<D>::judged(after.cell[cell]);
  for (int k = 0; k < (closure[cell]->is_solid() ? 1 : judged); ++k) {
    const auto [low, high] = reconstruction.range(cell, k);
    const double allowed = std::max(config.principle_tolerance * scale[k], config.range_tolerance * (high - low));
    if (candidate[k] >= low - allowed && candidate[k] <= high + allowed) continue;
    const Slopes<D> g = reconstruction.slopes(cell, from);
    const double gained = k < 2 ? 0 : dt / density * divergence_of_stress<D>(g)[k - 2];
    if (candidate[k] >= low + std::min(gained, 0.0) - allowed && candidate[k] <= high + std::max(gained, 0.0) + allowed)
      continue;
    return !is_smooth(cell, node_jumps(cell, from, g));
  }
  return false;
}

/// Is a fluid compressed within the cell by a good part of its wave speed, and not as one linear flow? Slopes take a
/// shock that spreads over their neighbours for a smooth compression: the cell then meets no resistance, takes up no
/// heat, and collapses.
template <int D>
bool Judgement<D>::is_shocked(int cell, const FlowState<D>& from) const {
  if (closure[cell]->is_solid() || after.cell[cell].density <= before.cell[cell].density) return false;
  const Vector<D> mean = mean_velocity(cell);
  const double least = config.shock_jump * before.speed[cell];
  const auto& nodes = mesh.nodes_of[cell];
  if (std::none_of(nodes.begin(), nodes.end(), [&](int p) { return norm(difference(after.v[p], mean)) > least; }))
    return false;
  const NodeJumps at = node_jumps(cell, from, reconstruction.slopes(cell, from));
  return at.jump > linear_flow * at.variation;
}

/// Has a solid lost heat that it had, by more than slopes hide of motion within the cell, where slopes are
/// worse than none? Constant cells make heat alone.
template <int D>
bool Judgement<D>::has_lost_heat(int cell, const FlowState<D>& from) const {
  if (!asks_for_heat(*closure[cell])) return false;
  const double heat = after.internal_energy(cell) - after.stored[cell],
               had = before.internal_energy(cell) - before.stored[cell], loss = before.most_heat[cell] - heat;
  const double part = config.heat_tolerance, round_off = heat_round_off * after.energy[cell];
  if (heat >= had || loss <= part * after.stored[cell] + round_off) return false;
  const NodeJumps at = node_jumps(cell, from, reconstruction.slopes(cell, from));
  const double within = 0.5 * at.variation * at.variation;
  return loss > part * (after.stored[cell] + within) + round_off && at.jump > at.variation && !is_smooth(cell, at);
}

/// Over the step.
template <int D>
Vector<D> Judgement<D>::mean_velocity(int cell) const {
  Vector<D> mean = velocity_of<D>(before.cell[cell].q);
  for (int i = 0; i < D; ++i) mean[i] = 0.5 * (mean[i] + after.cell[cell].q[i]);
  return mean;
}

template <int D>
typename Judgement<D>::NodeJumps Judgement<D>::node_jumps(int cell, const FlowState<D>& from,
                                                          const Slopes<D>& g) const {
  const Vector<D> mean = mean_velocity(cell);
  NodeJumps at;
  for (int p : mesh.nodes_of[cell]) {
    const Vector<D> s = difference(from.x[p], from.cell[cell].centre);
    Vector<D> rest = difference(after.v[p], mean);
    at.variation = std::max(at.variation, norm(rest));
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) rest[i] -= g[j][i] * s[j];
    at.jump = std::max(at.jump, norm(rest));
  }
  return at;
}

/// Do the cell's nodes move as its own linear velocity says? Where the flow is smooth they do but for terms of second
/// order in its size, at jumps they do not.
template <int D>
bool Judgement<D>::is_smooth(int cell, const NodeJumps& at) const {
  return at.jump <= std::max(config.smooth_jump * at.variation, config.small_jump * before.speed[cell]);
}

template <int D>
bool Judgement<D>::asks_for_heat(const Closure& c) const {
  return config.order == 2 && config.limiter == Limiter::mood && !config.patch_pressure && c.is_solid() &&
         !c.does_work();
}

template class Judgement<2>;
template class Judgement<3>;

}  // namespace titin
