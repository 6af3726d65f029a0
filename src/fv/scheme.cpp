#include "fv/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"

namespace titin {
namespace {

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
      rest_(mesh.cells()),
      boundary_(mesh, exchange, std::move(conditions)),
      reconstruction_(mesh, exchange, boundary_.mirrors()),
      nodes_(mesh, exchange, boundary_),
      mood_(mesh, exchange, config.cascade),
      now_(mesh.cells(), mesh.nodes()),
      next_(mesh.cells(), mesh.nodes()),
      judgement_({mesh, config_, closure_, reconstruction_, now_, next_}),
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
  for (int c = 0; c < mesh_.cells(); ++c)
    if (rest_[c] > 0) mood_.set_order(c, CellOrder::constant);
  if (order != CellOrder::constant) reconstruction_.gather(*source_.state);
  if (order == CellOrder::limited) reconstruction_.gather_ranges(*source_.state);
  find_corners(all_, dt);
  nodes_.solve(now_.x, next_.v);
}

template <int D>
void FlowScheme<D>::load(int b, int cell, PredictedBlock<D>& block) const {
  const FlowState<D>& state = *source_.state;
  block.g[b] = mood_.order(cell) == CellOrder::constant ? Slopes<D>{} : reconstruction_.slopes(cell, state);
  if (mood_.order(cell) == CellOrder::limited) reconstruction_.limit(cell, state, block.g[b]);
  store_registers<D>(state.cell[cell].packed(), block.q[b]);
  block.density[b] = state.cell[cell].density;
  block.energy[b] = state.internal_energy(cell);
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
      if (mood_.order(run[b]) == CellOrder::constant)  // keeps the bits of the first-order scheme
        store_registers<D>(source_.state->cell[run[b]].packed(), block.q[b]);
      write_corners(run[b], block.g[b], block.q[b]);
    }
  });
}

template <int D>
void FlowScheme<D>::write_corners(int cell, const Slopes<D>& g, const PackedFields<D>& q) {
  const FlowState<D>& state = *source_.state;
  const CellRecord<D>& record = state.cell[cell];
  const Corners<D> normals = corner_normals<D>(mesh_.corners_of(cell, *source_.x));
  std::array<PackedFields<D>, D + 1> at;
  const Registers<D> centre = load_registers<D>(q.data());
  double jump = 0;  // squared
  for (int p = 0; p <= D; ++p) {
    const int node = mesh_.nodes_of[cell][p];
    Registers<D> here = change_along<D>(difference(state.x[node], record.centre), g);
    for (int k = 0; k < packed_registers<D>; ++k) here[k] += centre[k];
    store_registers<D>(here, at[p]);
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
      energy[b] = next_.internal_energy(c);
      F[b] = closure.is_solid() ? deformation(c, next_) : identity;
    }
    const bool wants_heat = judgement_.asks_for_heat(closure);
    closure.stress_and_speed({n, F.data(), density.data(), energy.data(), run.data(), t + dt}, waves_.data(), T.data(),
                             speed.data(), wants_heat ? psi.data() : nullptr);
    if (wants_heat) {
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

template <int D>
std::string FlowScheme<D>::judge(double t, double dt) {
  const bool cascade = has_cascade();
  bool ranges = false;
  std::span<const int> cells = all_;
  while (cascade) {
    troubled_.clear();
    for (int c : cells)
      if (mood_.order(c) != CellOrder::constant && judgement_.in_trouble(c, *source_.state, dt)) troubled_.push_back(c);
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
    return !passed && !judgement_.has_meaning(c);
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
    facts[5] = next_.internal_energy(*wrong);
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
  if (has_cascade()) take_rest(dt);
  std::swap(now_, next_);
  if (patches_) patches_->apply(now_);
}

/// Of fluids' cells that a step has left constant in a shock faster than sound. (Behind weaker ones it costs more than
/// it saves: a fifth more error in Sod's tube.)
template <int D>
void FlowScheme<D>::take_rest(double dt) {
  for (int c = 0; c < mesh_.cells(); ++c)
    if (rest_[c] > 0)
      rest_[c] -= dt / next_.crossing[c];
    else if (mood_.order(c) == CellOrder::constant && !closure_[c]->is_solid() && stiffening_[c] > now_.speed[c])
      rest_[c] = config_.rest;
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
