#include "fv/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"

namespace titin {
namespace {

/// A step whose cells change their volumes by more than this many times the bound it was chosen for is taken again.
constexpr double volume_margin = 2;
/// A cell whose nodes miss its linear velocity by less than this part of their differences is strained as a whole,
/// which no jump in it does.
constexpr double linear_flow = 0.05;
/// Part of a cell's energy that is round-off in its heat.
constexpr double heat_round_off = 1e-12;
std::vector<int> numbers(int n) {
  std::vector<int> list(n);
  std::iota(list.begin(), list.end(), 0);
  return list;
}

template <int D>
void set_stress(const Sym3& T, CellFields<D>& q) {
  if constexpr (D == 2)
    q[2] = T[0], q[3] = T[1], q[4] = T[3];
  else
    std::copy(T.begin(), T.end(), q.begin() + 3);
}

}  // namespace

template <int D>
FlowScheme<D>::FlowScheme(const SimplexMesh<D>& mesh, NodeExchange& exchange, const FvConfig& config,
                          std::vector<BoundaryCondition<D>> conditions, const std::vector<CellStart>& start)
    : mesh_(mesh),
      exchange_(exchange),
      config_(config),
      closure_(mesh.cells()),
      mass_(mesh.cells()),
      inverse_edges_(mesh.cells()),
      all_(numbers(mesh.cells())),
      all_nodes_(numbers(mesh.nodes())),
      waves_(mesh.cells()),
      stiffening_(mesh.cells()),
      boundary_(mesh, exchange, std::move(conditions)),
      reconstruction_(mesh, exchange, boundary_.mirrors()),
      nodes_(mesh, exchange, boundary_),
      mood_(mesh, exchange, config.cascade),
      now_(mesh.cells(), mesh.nodes()),
      next_(mesh.cells(), mesh.nodes()),
      half_x_(mesh.x) {
  troubled_.reserve(mesh.cells());
  now_.x = next_.x = mesh.x;
  for (int c = 0; c < mesh.cells(); ++c) {
    closure_[c] = start[c].closure;
    const Corners<D> x = mesh.corners_of(c, mesh.x);
    mass_[c] = start[c].density * simplex_volume<D>(x);
    inverse_edges_[c] = inverse_of<D>(edges<D>(x));
    for (int i = 0; i < D; ++i) now_.cell[c].q[i] = start[c].velocity[i];
    const Vector<D> v = velocity_of<D>(now_.cell[c].q);
    now_.energy[c] = start[c].energy + 0.5 * dot(v, v);
  }
  judges_heat_ = config_.order == 2 && config_.limiter == Limiter::mood && !config_.patch_pressure &&
                 std::none_of(start.begin(), start.end(), [](const CellStart& c) { return c.closure->does_work(); });
  if (config_.patch_pressure) patches_ = std::make_unique<PatchPressure<D>>(mesh, exchange, closure_);
  update(all_, 0, 0);  // without forces: completes the state
  std::swap(now_, next_);
  source_ = {&now_, &now_.x, 0};
  boundary_.prepare(0, 0, now_.x);
  solve_all(0, CellOrder::constant);
  now_.v = next_.v;
  nodes_have_moved_ = true;
  const double acoustic = config_.cfl * *std::min_element(now_.crossing.begin(), now_.crossing.end());
  largest_dt_ = config_.first_step * min(std::min(acoustic, config_.volume_change * filling_time()));
}

/// Shortest time in which a cell of this rank would change by its own volume, as its nodes move at the start.
template <int D>
double FlowScheme<D>::filling_time() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < mesh_.cells(); ++c) {
    const Corners<D> normals = corner_normals<D>(mesh_.corners_of(c, now_.x));
    double rate = 0;
    for (int p = 0; p <= D; ++p) rate += dot(normals[p], now_.v[mesh_.nodes_of[c][p]]);
    shortest = std::min(shortest, now_.volume[c] / std::abs(rate));
  }
  return shortest;
}

template <int D>
Mat3 FlowScheme<D>::deformation(int cell, const FlowState<D>& state) const {
  const Matrix<D> F = matrix_product<D>(edges<D>(mesh_.corners_of(cell, state.x)), inverse_edges_[cell]);
  Mat3 full = identity;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) full[3 * i + j] = F[D * i + j];
  return full;
}

template <int D>
double FlowScheme<D>::internal_energy(int cell, const FlowState<D>& state) const {
  const Vector<D> v = velocity_of<D>(state.cell[cell].q);
  return state.energy[cell] - 0.5 * dot(v, v);
}

template <int D>
CellOrder FlowScheme<D>::first_order() const {
  if (config_.order == 1) return CellOrder::constant;
  return config_.limiter == Limiter::barth_jespersen ? CellOrder::limited : CellOrder::linear;
}

template <int D>
std::string FlowScheme<D>::advance(double t, double dt) {
  if (config_.predictor == Predictor::rk2 && config_.order == 2) {
    half_step(t, dt);
  } else {
    for (int p = 0; p < mesh_.nodes(); ++p) half_x_[p] = moved(now_.x[p], dt / 2, now_.v[p]);
    source_ = {&now_, &half_x_, dt};
  }
  boundary_.prepare(t + dt / 2, dt, half_x_);
  solve_all(dt, first_order());
  move(all_nodes_, dt);
  update(all_, t, dt);
  const std::string failure = judge(t, dt);
  if (!failure.empty()) largest_dt_ = dt / 2;
  return failure;
}

/// Euler's half step of the whole scheme: where the second half takes its fields and geometry from.
template <int D>
void FlowScheme<D>::half_step(double t, double dt) {
  if (!half_) half_ = std::make_unique<FlowState<D>>(mesh_.cells(), mesh_.nodes());
  source_ = {&now_, &now_.x, 0};
  boundary_.prepare(t, dt / 2, now_.x);
  solve_all(dt / 2, first_order());
  move(all_nodes_, dt / 2);
  update(all_, t, dt / 2);
  std::swap(*half_, next_);
  if (patches_) patches_->apply(*half_);
  half_x_ = half_->x;
  source_ = {half_.get(), &half_x_, 0};
}

template <int D>
void FlowScheme<D>::solve_all(double dt, CellOrder order) {
  mood_.start(order);
  if (order != CellOrder::constant) reconstruction_.gather(*source_.state);
  if (order == CellOrder::limited) reconstruction_.gather_ranges(*source_.state);
  find_corners(all_, dt);
  nodes_.solve(now_.x, next_.v);
}

template <int D>
void FlowScheme<D>::load(int b, int cell, PredictedBlock<D>& block) const {
  const FlowState<D>& state = *source_.state;
  block.g[b] = {};
  if (mood_.order(cell) != CellOrder::constant) block.g[b] = reconstruction_.slopes(cell, state);
  if (mood_.order(cell) == CellOrder::limited) reconstruction_.limit(cell, state, block.g[b]);
  block.q[b] = state.cell[cell].q;
  block.density[b] = state.cell[cell].density;
  block.energy[b] = internal_energy(cell, state);
  block.shift[b] = stress_shift(cell);
  block.F[b] = closure_[cell]->is_solid() ? deformation(cell, state) : identity;
}

template <int D>
void FlowScheme<D>::find_corners(std::span<const int> cells, double t) {
  for_blocks(cells, [&](std::span<const int> run, const Closure& closure) {
    PredictedBlock<D> block;
    block.n = static_cast<int>(run.size());
    bool flat = true;
    for (int b = 0; b < block.n; ++b) {
      load(b, run[b], block);
      flat = flat && mood_.order(run[b]) == CellOrder::constant;
    }
    if (source_.predicted > 0 && !flat) predict<D>(config_.predictor, closure, t, source_.predicted, block);
    for (int b = 0; b < block.n; ++b) {
      const bool constant = mood_.order(run[b]) == CellOrder::constant;  // keeps the bits of the first-order scheme
      write_corners(run[b], block.g[b], constant ? source_.state->cell[run[b]].q : block.q[b]);
    }
  });
}

template <int D>
void FlowScheme<D>::write_corners(int cell, const Slopes<D>& g, const CellFields<D>& q) {
  const FlowState<D>& state = *source_.state;
  const CellRecord<D>& record = state.cell[cell];
  const Corners<D> normals = corner_normals<D>(mesh_.corners_of(cell, *source_.x));
  std::array<CellFields<D>, D + 1> at;
  double jump = 0;  // squared
  for (int p = 0; p <= D; ++p) {
    const int node = mesh_.nodes_of[cell][p];
    const Vector<D> s = difference(state.x[node], record.centre);
    for (int f = 0; f < field_count<D>; ++f) at[p][f] = q[f] + dot(g[f], s);
    const Vector<D> gap = difference(now_.v[node], velocity_of<D>(at[p]));
    jump = std::max(jump, dot(gap, gap));
  }
  if (nodes_have_moved_) stiffening_[cell] = config_.shock_impedance * std::sqrt(jump);
  const auto M =
      corner_impedances<D>(normals, config_.impedance * record.density * (state.speed[cell] + stiffening_[cell]));
  CornerForce<D>* corner = nodes_.corners(cell);
  for (int p = 0; p <= D; ++p) {
    corner[p].M = M[p];
    corner[p].b = difference(product<D>(M[p], velocity_of<D>(at[p])), product<D>(stress_of<D>(at[p]), normals[p]));
  }
}

template <int D>
void FlowScheme<D>::move(std::span<const int> nodes, double dt) {
  for (int p : nodes) next_.x[p] = moved(now_.x[p], dt, next_.v[p]);
}

/// Forces and power of the corners into velocity and total energy of the next state.
template <int D>
void FlowScheme<D>::take_forces(int cell, double dt) {
  const double per_mass = dt / mass_[cell];
  CellRecord<D>& record = next_.cell[cell];
  record.q = now_.cell[cell].q;
  double power = 0;
  const CornerForce<D>* corner = nodes_.corners(cell);
  for (int p = 0; p <= D && dt > 0; ++p) {
    const Vector<D>& v = next_.v[mesh_.nodes_of[cell][p]];
    const Vector<D> f = corner[p].force(v);
    for (int i = 0; i < D; ++i) record.q[i] += per_mass * f[i];
    power += dot(f, v);
  }
  next_.energy[cell] = now_.energy[cell] + per_mass * power;
}

template <int D>
void FlowScheme<D>::update(std::span<const int> cells, double t, double dt) {
  for_blocks(cells, [&](std::span<const int> run, const Closure& closure) {
    const int n = static_cast<int>(run.size());
    std::array<Mat3, cells_per_block> F;
    std::array<double, cells_per_block> density, energy, speed, diameter, psi;
    std::array<Sym3, cells_per_block> T;
    for (int b = 0; b < n; ++b) {
      const int c = run[b];
      const Corners<D> x = mesh_.corners_of(c, next_.x);
      take_forces(c, dt);
      next_.volume[c] = simplex_volume<D>(x);
      diameter[b] = inner_diameter<D>(next_.volume[c], corner_normals<D>(x));
      density[b] = next_.cell[c].density = mass_[c] / next_.volume[c];
      next_.cell[c].centre = centroid<D>(x);
      energy[b] = internal_energy(c, next_);
      F[b] = closure.is_solid() ? deformation(c, next_) : identity;
    }
    closure.stress_and_speed({n, F.data(), density.data(), energy.data(), run.data(), t + dt}, waves_.data(), T.data(),
                             speed.data());
    if (judges_heat_ && closure.is_solid()) {
      closure.stored({n, F.data(), nullptr, nullptr, nullptr, t + dt}, psi.data());
      for (int b = 0; b < n; ++b) {
        next_.stored[run[b]] = psi[b];
        next_.most_heat[run[b]] = std::max(now_.most_heat[run[b]], energy[b] - psi[b]);
      }
    }
    for (int b = 0; b < n; ++b) {
      set_stress<D>(T[b], next_.cell[run[b]].q);
      next_.speed[run[b]] = speed[b];
      next_.crossing[run[b]] = diameter[b] / (speed[b] + stiffening_[run[b]]);
    }
  });
}

/// Computer and physics: numbers, a volume, a state that the material knows.
template <int D>
bool FlowScheme<D>::has_meaning(int cell) const {
  const CellRecord<D>& c = next_.cell[cell];
  const double sum = std::accumulate(c.q.begin(), c.q.end(), next_.energy[cell] + next_.speed[cell]);
  const double change = std::abs(next_.volume[cell] - now_.volume[cell]);
  return std::isfinite(sum) && next_.volume[cell] > 0 &&
         change <= volume_margin * config_.volume_change * now_.volume[cell] &&
         closure_[cell]->admissible(c.density, internal_energy(cell, next_));
}

/// The maximum principle, which a smooth flow may leave: a compression without a jump raises the largest density too,
/// and a body that is accelerated as a whole leaves all its velocities.
template <int D>
bool FlowScheme<D>::in_trouble(int cell, double dt) const {
  if (!has_meaning(cell) || is_shocked(cell) || has_lost_heat(cell)) return true;
  constexpr int judged = Reconstruction<D>::judged_count;
  const CellRecord<D>& before = now_.cell[cell];
  const double c = now_.speed[cell];
  std::array<double, judged> scale{before.density, before.density * c * c};
  std::fill_n(scale.begin() + 2, D, c);
  const auto candidate = Reconstruction<D>::judged(next_.cell[cell]);
  const auto ranges = reconstruction_.ranges(cell);
  for (int k = 0; k < (closure_[cell]->is_solid() ? 1 : judged); ++k) {
    const auto& [low, high] = ranges[k];
    const double allowed = std::max(config_.principle_tolerance * scale[k], config_.range_tolerance * (high - low));
    if (candidate[k] >= low - allowed && candidate[k] <= high + allowed) continue;
    const Slopes<D> g = reconstruction_.slopes(cell, *source_.state);
    const double gained = k < 2 ? 0 : dt / before.density * divergence_of_stress<D>(g)[k - 2];
    if (candidate[k] >= low + std::min(gained, 0.0) - allowed && candidate[k] <= high + std::max(gained, 0.0) + allowed)
      continue;
    return !is_smooth(cell, node_jumps(cell, g));
  }
  return false;
}

/// Is a fluid compressed within the cell by a good part of its wave speed, and not as one linear flow? Slopes take a
/// shock that spreads over their neighbours for a smooth compression: the cell then meets no resistance, takes up no
/// heat, and collapses.
template <int D>
bool FlowScheme<D>::is_shocked(int cell) const {
  if (closure_[cell]->is_solid() || next_.cell[cell].density <= now_.cell[cell].density) return false;
  const Vector<D> mean = mean_velocity(cell);
  const double least = config_.shock_jump * now_.speed[cell];
  const auto& nodes = mesh_.nodes_of[cell];
  if (std::none_of(nodes.begin(), nodes.end(), [&](int p) { return norm(difference(next_.v[p], mean)) > least; }))
    return false;
  const NodeJumps at = node_jumps(cell, reconstruction_.slopes(cell, *source_.state));
  return at.jump > linear_flow * at.variation;
}

/// Has a solid lost heat that it had, by more than slopes hide of motion within the cell, where slopes are
/// worse than none?
/// Constant cells make heat alone.
template <int D>
bool FlowScheme<D>::has_lost_heat(int cell) const {
  if (!judges_heat_ || !closure_[cell]->is_solid()) return false;
  const double heat = internal_energy(cell, next_) - next_.stored[cell],
               before = internal_energy(cell, now_) - now_.stored[cell], loss = now_.most_heat[cell] - heat;
  const double part = config_.heat_tolerance, round_off = heat_round_off * next_.energy[cell];
  if (heat >= before || loss <= part * next_.stored[cell] + round_off) return false;
  const NodeJumps at = node_jumps(cell, reconstruction_.slopes(cell, *source_.state));
  const double within = 0.5 * at.variation * at.variation;
  return loss > part * (next_.stored[cell] + within) + round_off && at.jump > at.variation && !is_smooth(cell, at);
}

/// Over the step.
template <int D>
Vector<D> FlowScheme<D>::mean_velocity(int cell) const {
  Vector<D> mean = velocity_of<D>(now_.cell[cell].q);
  for (int i = 0; i < D; ++i) mean[i] = 0.5 * (mean[i] + next_.cell[cell].q[i]);
  return mean;
}

template <int D>
typename FlowScheme<D>::NodeJumps FlowScheme<D>::node_jumps(int cell, const Slopes<D>& g) const {
  const FlowState<D>& from = *source_.state;
  const Vector<D> mean = mean_velocity(cell);
  NodeJumps at;
  for (int p : mesh_.nodes_of[cell]) {
    const Vector<D> s = difference(from.x[p], from.cell[cell].centre);
    Vector<D> rest = difference(next_.v[p], mean);
    at.variation = std::max(at.variation, norm(rest));
    for (int i = 0; i < D; ++i) rest[i] -= dot(g[i], s);
    at.jump = std::max(at.jump, norm(rest));
  }
  return at;
}

/// Do the cell's nodes move as its own linear velocity says? Where the flow is smooth they do but for terms of second
/// order in its size, at jumps they do not.
template <int D>
bool FlowScheme<D>::is_smooth(int cell, const NodeJumps& at) const {
  return at.jump <= std::max(config_.smooth_jump * at.variation, config_.small_jump * now_.speed[cell]);
}

template <int D>
std::string FlowScheme<D>::judge(double t, double dt) {
  const bool cascade = config_.order == 2 && config_.limiter == Limiter::mood;
  bool ranges = false;
  std::span<const int> cells = all_;
  while (cascade) {
    troubled_.clear();
    for (int c : cells)
      if (mood_.order(c) != CellOrder::constant && in_trouble(c, dt)) troubled_.push_back(c);
    if (!mood_.lower(troubled_)) break;
    if (!ranges) reconstruction_.gather_ranges(*source_.state);
    ranges = true;
    find_corners(mood_.lowered(), t);
    nodes_.solve(mood_.nodes(), now_.x, next_.v);
    move(mood_.nodes(), dt);
    update(mood_.touched(), t, dt);
    cells = mood_.touched();
  }
  return failure(cascade);
}

/// The first cell of the lowest rank that has no meaning, in words that all ranks share; "" when all have. Of judged
/// cells those that kept slopes have.
template <int D>
std::string FlowScheme<D>::failure(bool judged) const {
  const auto is_wrong = [&](int c) {
    const bool passed = judged && mood_.order(c) != CellOrder::constant;
    return !passed && !has_meaning(c);
  };
  const auto wrong = std::find_if(all_.begin(), all_.end(), is_wrong);
  const bool failed = wrong != all_.end();
  const double first = min(failed ? static_cast<double>(rank()) : std::numeric_limits<double>::infinity());
  if (!std::isfinite(first)) return "";
  std::vector<double> facts(6);
  if (failed && first == rank()) {
    std::copy(now_.cell[*wrong].centre.begin(), now_.cell[*wrong].centre.end(), facts.begin());
    facts[3] = next_.volume[*wrong] / now_.volume[*wrong];
    facts[4] = next_.cell[*wrong].density;
    facts[5] = internal_energy(*wrong, next_);
    for (double& fact : facts)
      if (!std::isfinite(fact)) fact = std::numeric_limits<double>::max();  // sums of others stay numbers
  }
  sum(facts);
  return fmt::format(
      "the cell around ({:.4g}, {:.4g}, {:.4g}) m has no state with a meaning even at first order: "
      "{:.3g} of its volume before, density {:.4g} kg/m^3, internal energy {:.4g} J/kg",
      facts[0], facts[1], facts[2], facts[3], facts[4], facts[5]);
}

template <int D>
void FlowScheme<D>::accept(double dt) {
  // Steps that the clock shortened, to land on a time, do not hold back the next ones.
  largest_dt_ = std::min((1 + config_.growth) * std::max(dt, largest_dt_), next_dt(dt));
  std::swap(now_, next_);
  if (patches_) patches_->apply(now_);
}

template <int D>
double FlowScheme<D>::stored_shift(int cell) const {
  if (!patches_) return 0;
  const double at_rest = simplex_volume<D>(mesh_.corners_of(cell, mesh_.x));
  return patches_->energy(cell) * at_rest / mass_[cell];
}

/// By acoustics, and by the volumes that the step just tried has changed. Collective.
template <int D>
double FlowScheme<D>::next_dt(double dt) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < mesh_.cells(); ++c) {
    const double change = std::abs(next_.volume[c] - now_.volume[c]) / dt;
    shortest = std::min({shortest, config_.cfl * next_.crossing[c], config_.volume_change * next_.volume[c] / change});
  }
  return min(shortest);
}

template class FlowScheme<2>;
template class FlowScheme<3>;

}  // namespace titin
