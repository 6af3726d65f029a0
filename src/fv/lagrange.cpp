#include "fv/lagrange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "fv/motion_errors.hpp"

namespace titin {
namespace {

const Table no_velocity{0.0};

template <int D>
Vec3 spatial(const Vector<D>& a) {
  Vec3 b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}
template <int D>
Vector<D> first(const std::array<double, 3>& a) {
  Vector<D> b;
  std::copy_n(a.begin(), D, b.begin());
  return b;
}

}  // namespace

template <int D>
Lagrange<D>::Lagrange(NamedMesh mesh, LagrangeConfig config)
    : mesh_(std::move(mesh)),
      config_(std::move(config)),
      cells_(*mesh_.mesh),
      exchange_(*mesh_.mesh, cells_),
      scheme_(cells_, exchange_, config_.fv, conditions(), start()),
      history_(scheme_, config_.markers, config_.torques),
      means_(scheme_, config_.averages),
      fields_(*mesh_.mesh, scheme_) {}

template <int D>
std::vector<BoundaryCondition<D>> Lagrange<D>::conditions() const {
  std::vector<BoundaryCondition<D>> list;
  for (const FlowBoundaryConfig& from : config_.boundaries) {
    BoundaryCondition<D>& to = list.emplace_back();
    to.name = from.name;
    for (const std::string& name : from.on) to.attributes.push_back(mesh_.boundaries.at(name));
    if (from.wall) to.normal_velocity = &no_velocity;
    to.mirrors = from.wall;
    if (from.has_normal_velocity) to.normal_velocity = &from.normal_velocity;
    for (int i = 0; i < D; ++i)
      if (from.prescribed[i]) to.velocity[i] = &from.velocity[i];
    if (from.has_pressure) to.pressure = &from.pressure;
    to.traction = first<D>(from.traction);
    if (norm(from.traction) > 0) to.traction_scale = &from.traction_scale;
    const auto exact = config_.exact;
    if (from.exact == ExactBoundary::pressure)
      to.pressure_at = [exact](const Vector<D>& x, double t) { return exact->pressure_on_boundary(spatial<D>(x), t); };
    if (from.exact == ExactBoundary::velocity)
      to.velocity_at = [exact](const Vector<D>& x, double t) { return first<D>(exact->at(spatial<D>(x), t).velocity); };
    to.has_obstacle = from.has_obstacle;
    if (!from.has_obstacle) continue;
    to.obstacle = {first<D>(from.obstacle_point), first<D>(from.obstacle_normal), from.contact};
    const double size = norm(to.obstacle.normal);
    for (double& component : to.obstacle.normal) component /= size;
  }
  return list;
}

/// What the scene says of a cell: the state, and the start whose energy it shares, or -1.
template <int D>
std::pair<FlowPoint, int> Lagrange<D>::start_of(int cell) const {
  const Corners<D> at = cells_.corners_of(cell, cells_.x);
  const Vec3 x = spatial<D>(centroid<D>(at));
  std::vector<Vec3> corners;
  for (const Vector<D>& corner : at) corners.push_back(spatial<D>(corner));
  FlowPoint point;
  if (config_.exact) point = config_.exact->at(x, 0);
  int shares = -1;
  for (std::size_t k = 0; k < config_.initial.size(); ++k) {
    const InitialConfig& initial = config_.initial[k];
    if (!initial.holds(cells_.region[cell], x, corners)) continue;
    if (initial.density > 0) {
      point = {initial.density, initial.pressure, {}};
      shares = initial.energy > 0 ? static_cast<int>(k) : -1;
    }
    point.velocity = initial.velocity_at(x);
  }
  return {point, shares};
}

template <int D>
std::vector<CellStart> Lagrange<D>::start() const {
  std::vector<CellStart> list(cells_.cells());
  std::vector<int> shares(cells_.cells());
  std::vector<double> mass(config_.initial.size());  // that shares the energy of each
  for (int c = 0; c < cells_.cells(); ++c) {
    const std::string& material = config_.material_of_region.at(cells_.region[c]);
    auto [point, from] = start_of(c);
    shares[c] = from;
    const auto solid = config_.densities.find(material);
    if (solid != config_.densities.end()) point.density = solid->second;
    const Closure& closure = *config_.closures.at(material);
    list[c] = {&closure, point.density, closure.energy_at(point.density, point.pressure), point.velocity};
    if (from >= 0) mass[from] += point.density * simplex_volume<D>(cells_.corners_of(c, cells_.x));
  }
  sum(mass);
  for (int c = 0; c < cells_.cells(); ++c)
    if (shares[c] >= 0 && !list[c].closure->is_solid())
      list[c].energy = config_.initial[shares[c]].energy / mass[shares[c]];
  return list;
}

template <int D>
Step Lagrange<D>::advance(double dt) {
  Step step;
  step.time = time_ + dt;
  step.dt = dt_ = dt;
  step.failure = has_collapsed() ? collapse() : scheme_.advance(time_, dt);
  return step;
}

/// Which cell allows the shortest step, and what has become of it. Collective.
template <int D>
std::string Lagrange<D>::collapse() const {
  const auto& state = scheme_.state();
  const auto narrowest = std::min_element(state.crossing.begin(), state.crossing.end());
  const double least = min(*narrowest);
  const double first = min(*narrowest == least ? static_cast<double>(rank()) : std::numeric_limits<double>::infinity());
  std::vector<double> facts(5);
  if (first == rank()) {
    const auto cell = static_cast<int>(narrowest - state.crossing.begin());
    std::copy(state.cell[cell].centre.begin(), state.cell[cell].centre.end(), facts.begin());
    facts[3] = state.volume[cell] / simplex_volume<D>(cells_.corners_of(cell, cells_.x));
    facts[4] = state.cell[cell].density;
  }
  sum(facts);
  return fmt::format(
      "the cell around ({:.4g}, {:.4g}, {:.4g}) m has collapsed to {:.3g} of its volume, density {:.4g} kg/m^3: cells "
      "allow steps of {:.3g} s, where {:.3g} s were possible",
      facts[0], facts[1], facts[2], facts[3], facts[4], scheme_.largest_dt(), longest_dt_);
}

template <int D>
void Lagrange<D>::accept() {
  scheme_.accept(dt_);
  time_ += dt_;
  longest_dt_ = std::max(longest_dt_, scheme_.largest_dt());
  history_.follow(dt_);
}

template <int D>
std::vector<Quantity> Lagrange<D>::quantities() {
  std::vector<Quantity> list = history_.quantities(time_);
  means_.list(time_, list);
  return list;
}

template <int D>
long Lagrange<D>::unknowns() const {
  long nodes = 0;
  for (int p = 0; p < cells_.nodes(); ++p) nodes += exchange_.owns(p);
  return (D + 1) * sum(static_cast<long>(cells_.cells())) + D * sum(nodes);
}

template <int D>
double Lagrange<D>::bytes_per_step() const {
  return sum(scheme_.bytes_per_step());
}

/// Of density, pressure and velocity at the centres of cells: mean and root of the mean square over the body times its
/// volume (integrals), and the largest.
template <int D>
std::vector<Quantity> Lagrange<D>::errors() {
  if (config_.exact_motion) return motion_errors<D>(scheme_, *config_.exact_motion, time_);
  if (!config_.exact) return {};
  constexpr const char* names[] = {"density", "pressure", "velocity"};
  constexpr const char* units[] = {"kg/m^3", "Pa", "m/s"};
  std::vector<double> integral(6);
  std::array<double, 3> largest{};
  for (int c = 0; c < cells_.cells(); ++c) {
    const auto& cell = scheme_.state().cell[c];
    const FlowPoint exact = config_.exact->at(spatial<D>(cell.centre), time_);
    const Vec3 v = spatial<D>(velocity_of<D>(cell.q));
    const double error[] = {std::abs(cell.density - exact.density), std::abs(-cell.q[D] - exact.pressure),
                            norm(difference(v, exact.velocity))};
    for (int k = 0; k < 3; ++k) {
      integral[2 * k] += scheme_.state().volume[c] * error[k];
      integral[2 * k + 1] += scheme_.state().volume[c] * error[k] * error[k];
      largest[k] = std::max(largest[k], error[k]);
    }
  }
  sum(integral);
  std::vector<Quantity> list;
  for (int k = 0; k < 3; ++k) {
    const std::string name = names[k];
    list.push_back({name + "_L1", units[k], integral[2 * k]});
    list.push_back({name + "_L2", units[k], std::sqrt(integral[2 * k + 1])});
    list.push_back({name + "_Linf", units[k], max(largest[k])});
  }
  add_surface_errors(list);
  return list;
}

/// How far nodes lie from where the exact flow has its own surfaces, of each boundary that takes over a part of it.
template <int D>
void Lagrange<D>::add_surface_errors(std::vector<Quantity>& list) const {
  const auto& conditions = scheme_.boundary().conditions();
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    if (config_.boundaries[k].exact != ExactBoundary::pressure) continue;
    double largest = 0;
    std::vector<double> x(2);  // sum, how many; a node counts once for each of its faces
    for (const auto& face : cells_.boundary) {
      if (std::count(conditions[k].attributes.begin(), conditions[k].attributes.end(), face.attribute) == 0) continue;
      for (int node : face.nodes) {
        const double off = config_.exact->off_surface(spatial<D>(scheme_.state().x[node]), time_);
        largest = std::max(largest, off);
        x[0] += off;
        x[1] += 1;
      }
    }
    sum(x);
    list.push_back({fmt::format("{}_off_max", conditions[k].name), "m", max(largest)});
    list.push_back({fmt::format("{}_off_mean", conditions[k].name), "m", x[0] / x[1]});
  }
}

std::unique_ptr<Model> make_lagrange(NamedMesh mesh, LagrangeConfig config) {
  if (mesh.mesh->Dimension() == 2) return std::make_unique<Lagrange<2>>(std::move(mesh), std::move(config));
  return std::make_unique<Lagrange<3>>(std::move(mesh), std::move(config));
}

template class Lagrange<2>;
template class Lagrange<3>;

}  // namespace titin
