// What a Lagrangian run keeps between its steps, in a walk (solve/state_walk.hpp).
#include <algorithm>
#include <limits>

#include "fv/lagrange.hpp"

namespace titin {
namespace {

/// Of this rank's nodes, as mesh/mesh_numbers.hpp has them.
template <int D>
std::vector<long> node_numbers(const SimplexMesh<D>& cells, const std::vector<long>& cell, NodeExchange& exchange) {
  std::vector<double> least(cells.nodes(), -std::numeric_limits<double>::infinity());  // negative: max is at hand
  for (int c = 0; c < cells.cells(); ++c)
    for (int p = 0; p <= D; ++p) {
      double& number = least[cells.nodes_of[c][p]];
      number = std::max(number, -(static_cast<double>(cell[c]) * (D + 1) + p));
    }
  exchange.max(least.data(), 1);
  std::vector<long> numbers;
  for (const double number : least) numbers.push_back(static_cast<long>(-number));
  return numbers;
}

}  // namespace

template <int D>
void FlowScheme<D>::walk(StateWalk& walk, const StateRows& cells, const StateRows& nodes) {
  constexpr int numbers = field_count<D> + D + 10 + 6 + 1;
  walk.number("largest_dt", largest_dt_);
  walk.records("state", cells, numbers, [&](std::size_t c, auto take) {
    CellRecord<D>& record = now_.cell[c];
    for (double& x : record.q) take(x);
    for (double& x : record.centre) take(x);
    double order = static_cast<double>(mood_.order(static_cast<int>(c)));
    for (double* x : {&record.density, &now_.energy[c], &now_.stored[c], &now_.most_heat[c], &now_.volume[c],
                      &now_.speed[c], &now_.crossing[c], &stiffening_[c], &rest_[c], &waves_[c].speed, &order})
      take(*x);
    mood_.set_order(static_cast<int>(c), static_cast<CellOrder>(static_cast<int>(order)));
    for (double& x : waves_[c].C) take(x);
  });
  if (patches_) patches_->walk(walk, cells);
  walk.records("motion", nodes, 3 * D, [&](std::size_t p, auto take) {
    for (double& x : now_.x[p]) take(x);
    for (double& x : now_.v[p]) take(x);
    for (double& x : half_x_[p]) take(x);
  });
}

template <int D>
void LagrangeHistory<D>::walk(StateWalk& walk) {
  std::vector<double*> all = {&work_, &momentum_error_, &energy_error_, &momentum_scale_, &energy_scale_};
  for (Kept* kept : {&start_, &now_}) {
    all.insert(all.end(), {&kept->mass, &kept->energy, &kept->kinetic});
    for (double& x : kept->momentum) all.push_back(&x);
    for (double& x : kept->angular) all.push_back(&x);
  }
  for (double& x : impulse_) all.push_back(&x);
  for (auto& force : forces_) {
    for (double& x : force.force) all.push_back(&x);
    all.push_back(&force.power);
  }
  for (auto& torque : torques_)
    for (double& x : torque.moment) all.push_back(&x);
  std::vector<double> values;
  for (const double* x : all) values.push_back(*x);
  walk.common("accounts", values);
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = values.at(k);
}

template <int D>
void Lagrange<D>::walk_state(StateWalk& walk) {
  StateRows cells{"cells", {}};
  for (const int element : cells_.element_of) cells.number.push_back(mesh_.numbers.cell.at(element));
  const StateRows nodes{"nodes", node_numbers<D>(cells_, cells.number, exchange_)};
  scheme_.walk(walk, cells, nodes);
  history_.walk(walk);
  walk.number("time", time_);
  walk.number("longest_dt", longest_dt_);
}

template void FlowScheme<2>::walk(StateWalk&, const StateRows&, const StateRows&);
template void FlowScheme<3>::walk(StateWalk&, const StateRows&, const StateRows&);
template void LagrangeHistory<2>::walk(StateWalk&);
template void LagrangeHistory<3>::walk(StateWalk&);
template void Lagrange<2>::walk_state(StateWalk&);
template void Lagrange<3>::walk_state(StateWalk&);

}  // namespace titin
