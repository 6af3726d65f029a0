#include "fv/lagrange.hpp"

#include <algorithm>
#include <cmath>

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
      history_(scheme_, config_.markers),
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

template <int D>
std::vector<CellStart> Lagrange<D>::start() const {
  std::vector<CellStart> list(cells_.cells());
  for (int c = 0; c < cells_.cells(); ++c) {
    const std::string& material = config_.material_of_region.at(cells_.region[c]);
    const Vec3 x = spatial<D>(centroid<D>(cells_.corners_of(c, cells_.x)));
    FlowPoint point;
    if (config_.exact) point = config_.exact->at(x, 0);
    for (const InitialConfig& initial : config_.initial) {
      if (!initial.holds(x)) continue;
      if (initial.density > 0) point = {initial.density, initial.pressure, {}};
      point.velocity = initial.velocity_at(x);
    }
    const auto solid = config_.densities.find(material);
    if (solid != config_.densities.end()) point.density = solid->second;
    const Closure& closure = *config_.closures.at(material);
    list[c] = {&closure, point.density, closure.energy_at(point.density, point.pressure), point.velocity};
  }
  return list;
}

template <int D>
Step Lagrange<D>::advance(double dt) {
  Step step;
  step.time = time_ + dt;
  step.dt = dt_ = dt;
  step.failure = scheme_.advance(time_, dt);
  return step;
}

template <int D>
void Lagrange<D>::accept() {
  scheme_.accept(dt_);
  time_ += dt_;
  history_.follow(dt_);
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
  return list;
}

std::unique_ptr<Model> make_lagrange(NamedMesh mesh, LagrangeConfig config) {
  if (mesh.mesh->Dimension() == 2) return std::make_unique<Lagrange<2>>(std::move(mesh), std::move(config));
  return std::make_unique<Lagrange<3>>(std::move(mesh), std::move(config));
}

template class Lagrange<2>;
template class Lagrange<3>;

}  // namespace titin
