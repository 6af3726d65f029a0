#include "fv/lagrange_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

/// Units of extensive quantities: in the plane per metre of thickness.
template <int D>
std::string extensive(const char* unit) {
  if constexpr (D == 3) return unit;
  return std::string(unit) == "m^3" ? "m^2" : std::string(unit) + "/m";
}

template <int D>
Vec3 spatial(const Vector<D>& a) {
  Vec3 b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}

}  // namespace

template <int D>
LagrangeHistory<D>::LagrangeHistory(const FlowScheme<D>& scheme, const std::vector<MarkerConfig>& markers,
                                    const std::vector<TorqueConfig>& torques)
    : scheme_(scheme), forces_(scheme.boundary().conditions().size()) {
  for (const MarkerConfig& marker : markers) take_marker(marker);
  for (const TorqueConfig& torque : torques) torques_.push_back({torque, {}});
  start_ = now_ = kept();
  energy_scale_ = std::abs(start_.energy);
  momentum_scale_ = std::sqrt(2 * start_.mass * start_.kinetic);
}

/// Barycentric coordinates in the cell that holds it at rest.
template <int D>
void LagrangeHistory<D>::take_marker(const MarkerConfig& config) {
  Marker& marker = markers_.emplace_back();
  marker.name = config.name;
  if (config.cell < 0) return;
  const SimplexMesh<D>& mesh = scheme_.mesh();
  marker.cell = static_cast<int>(std::find(mesh.element_of.begin(), mesh.element_of.end(), config.cell) -
                                 mesh.element_of.begin());
  const Corners<D> x = mesh.corners_of(marker.cell, mesh.x);
  const Matrix<D> inverse = inverse_of<D>(edges<D>(x));
  marker.share[0] = 1;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) marker.share[i + 1] += inverse[D * i + j] * (config.position[j] - x[0][j]);
    marker.share[0] -= marker.share[i + 1];
  }
}

template <int D>
typename LagrangeHistory<D>::Kept LagrangeHistory<D>::kept() const {
  std::vector<double> x(9);
  for (int c = 0; c < scheme_.mesh().cells(); ++c) {
    const auto& cell = scheme_.state().cell[c];
    const double m = scheme_.mass(c);
    const Vec3 v = spatial<D>(velocity_of<D>(cell.q)), spin = cross(spatial<D>(cell.centre), v);
    x[0] += m;
    x[1] += m * scheme_.state().energy[c];
    x[2] += 0.5 * m * dot(v, v);
    for (int i = 0; i < 3; ++i) x[3 + i] += m * v[i], x[6 + i] += m * spin[i];
  }
  sum(x);
  Kept all{x[0], x[1], x[2], {}, {x[6], x[7], x[8]}};
  std::copy_n(&x[3], D, all.momentum.begin());
  return all;
}

template <int D>
void LagrangeHistory<D>::follow(double dt) {
  std::fill(forces_.begin(), forces_.end(), typename Boundary<D>::Force{});
  scheme_.boundary().add_forces(scheme_.state().v, forces_);
  std::vector<double> x;
  for (const auto& f : forces_) {
    x.insert(x.end(), f.force.begin(), f.force.end());
    x.push_back(f.power);
  }
  sum(x);
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    std::copy_n(&x[(D + 1) * k], D, forces_[k].force.begin());
    forces_[k].power = x[(D + 1) * k + D];
    accumulate(impulse_, dt, forces_[k].force);
    work_ += dt * forces_[k].power;
  }
  follow_torques(dt);
  now_ = kept();
  energy_scale_ = std::max(energy_scale_, std::abs(now_.energy));
  momentum_scale_ = std::max(momentum_scale_, std::sqrt(2 * now_.mass * now_.kinetic));
  energy_error_ = std::max(energy_error_, std::abs(now_.energy - start_.energy - work_));
  momentum_error_ = std::max(momentum_error_, norm(difference(difference(now_.momentum, start_.momentum), impulse_)));
}

/// Forces are those of the step: they act where nodes were in its middle.
template <int D>
void LagrangeHistory<D>::follow_torques(double dt) {
  if (torques_.empty()) return;
  std::vector<Vector<D>> middle = scheme_.state().x;
  for (std::size_t p = 0; p < middle.size(); ++p) accumulate(middle[p], -0.5 * dt, scheme_.state().v[p]);
  for (Torque& torque : torques_) {
    const Vec3 part = scheme_.boundary().moment(torque.config.index, torque.config.point, middle);
    std::vector<double> all(part.begin(), part.end());
    sum(all);
    std::copy_n(all.begin(), 3, torque.moment.begin());
  }
}

template <int D>
std::vector<Quantity> LagrangeHistory<D>::conservation() const {
  const auto over = [](double error, double scale) { return scale > 0 ? error / scale : error; };
  return {{"momentum_error", "", over(momentum_error_, momentum_scale_)},
          {"energy_error", "", over(energy_error_, energy_scale_)},
          {"mass_error", "", std::abs(now_.mass - start_.mass) / start_.mass}};
}

template <int D>
void LagrangeHistory<D>::add_energies(double time, std::vector<Quantity>& list) const {
  double elastic = 0;
  scheme_.for_blocks(scheme_.all_cells(), [&](std::span<const int> run, const Closure& closure) {
    if (!closure.is_solid()) return;
    std::array<Mat3, cells_per_block> F;
    std::array<double, cells_per_block> psi;
    for (std::size_t b = 0; b < run.size(); ++b) F[b] = scheme_.deformation(run[b], scheme_.state());
    CellBatch in;
    in.n = static_cast<int>(run.size());
    in.F = F.data();
    in.time = time;
    closure.stored(in, psi.data());
    for (std::size_t b = 0; b < run.size(); ++b)
      elastic += scheme_.mass(run[b]) * (psi[b] + scheme_.stored_shift(run[b]));
  });
  elastic = sum(elastic);
  const std::string J = extensive<D>("J");
  list.push_back({"energy_total", J, now_.energy});
  list.push_back({"energy_kinetic", J, now_.kinetic});
  list.push_back({"energy_internal", J, now_.energy - now_.kinetic});
  list.push_back({"energy_elastic", J, elastic});
  list.push_back({"energy_heat", J, now_.energy - now_.kinetic - elastic});
  list.push_back({"work_boundary", J, work_});
}

template <int D>
void LagrangeHistory<D>::add_boundaries(std::vector<Quantity>& list) const {
  for (std::size_t k = 0; k < forces_.size(); ++k)
    for (int i = 0; i < D; ++i)
      list.push_back({fmt::format("force_{}_{}", scheme_.boundary().conditions()[k].name, axes[i]), extensive<D>("N"),
                      forces_[k].force[i]});
  for (const Torque& torque : torques_)
    for (int i = first_torque_axis(D); i < 3; ++i)
      list.push_back(
          {fmt::format("torque_{}_{}", torque.config.boundary, axes[i]), extensive<D>("N m"), torque.moment[i]});
}

template <int D>
void LagrangeHistory<D>::add_cells(std::vector<Quantity>& list) const {
  std::vector<double> x(4);  // volume, cells, limited, constant
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int c = 0; c < scheme_.mesh().cells(); ++c) {
    x[0] += scheme_.state().volume[c];
    x[1] += 1;
    x[2] += scheme_.order(c) == CellOrder::limited;
    x[3] += scheme_.order(c) == CellOrder::constant;
    least = std::min(least, scheme_.state().cell[c].density);
    most = std::max(most, scheme_.state().cell[c].density);
  }
  sum(x);
  list.push_back({"volume", extensive<D>("m^3"), x[0]});
  list.push_back({"density_min", "kg/m^3", min(least)});
  list.push_back({"density_max", "kg/m^3", max(most)});
  list.push_back({"cells_limited", "percent", 100 * x[2] / x[1]});
  list.push_back({"cells_constant", "percent", 100 * x[3] / x[1]});
}

/// Where the body begins and ends along each axis.
template <int D>
void LagrangeHistory<D>::add_extent(std::vector<Quantity>& list) const {
  for (int i = 0; i < D; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& x : scheme_.state().x) low = std::min(low, x[i]), high = std::max(high, x[i]);
    list.push_back({fmt::format("{}_min", axes[i]), "m", min(low)});
    list.push_back({fmt::format("{}_max", axes[i]), "m", max(high)});
  }
}

template <int D>
void LagrangeHistory<D>::add_markers(std::vector<Quantity>& list) const {
  for (const Marker& marker : markers_)
    for (int i = 0; i < D; ++i) {
      double moved = 0;
      for (int p = 0; p <= D && marker.cell >= 0; ++p) {
        const int node = scheme_.mesh().nodes_of[marker.cell][p];
        moved += marker.share[p] * (scheme_.state().x[node][i] - scheme_.mesh().x[node][i]);
      }
      list.push_back({fmt::format("marker_{}_u{}", marker.name, axes[i]), "m", sum(moved)});
    }
}

template <int D>
std::vector<Quantity> LagrangeHistory<D>::quantities(double time) const {
  std::vector<Quantity> list{{"mass", extensive<D>("kg"), now_.mass}};
  for (int i = 0; i < D; ++i)
    list.push_back({fmt::format("momentum_{}", axes[i]), extensive<D>("kg m/s"), now_.momentum[i]});
  for (int i = D == 2 ? 2 : 0; i < 3; ++i)
    list.push_back({fmt::format("angular_momentum_{}", axes[i]), extensive<D>("kg m^2/s"), now_.angular[i]});
  add_energies(time, list);
  add_boundaries(list);
  add_cells(list);
  add_extent(list);
  add_markers(list);
  return list;
}

template class LagrangeHistory<2>;
template class LagrangeHistory<3>;

}  // namespace titin
