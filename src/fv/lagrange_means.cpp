#include "fv/lagrange_means.hpp"

#include <fmt/format.h>

#include "base/parallel.hpp"

namespace titin {

template <int D>
LagrangeMeans<D>::LagrangeMeans(const FlowScheme<D>& scheme, const std::vector<AverageConfig>& averages)
    : scheme_(scheme) {
  std::vector<int> cell_of(scheme.mesh().cells());  // of MFEM's elements
  for (int c = 0; c < scheme.mesh().cells(); ++c) cell_of[scheme.mesh().element_of[c]] = c;
  for (const AverageConfig& average : averages) {
    Box& box = boxes_.emplace_back();
    box.name = average.name;
    for (const int element : average.cells) box.cells.push_back(cell_of[element]);
  }
}

/// Pressure times volume, this rank's part [J].
template <int D>
double LagrangeMeans<D>::pressure_volume(const Box& box, double time) const {
  double sum = 0;
  const FlowState<D>& state = scheme_.state();
  scheme_.for_blocks(box.cells, [&](std::span<const int> run, const Closure& closure) {
    std::array<Mat3, cells_per_block> F;
    std::array<double, cells_per_block> density, energy;
    std::array<Sym3, cells_per_block> T;
    for (std::size_t b = 0; b < run.size(); ++b) {
      F[b] = scheme_.deformation(run[b], state);
      density[b] = state.cell[run[b]].density;
      energy[b] = state.internal_energy(run[b]);
    }
    closure.stress({static_cast<int>(run.size()), F.data(), density.data(), energy.data(), nullptr, time}, T.data());
    for (std::size_t b = 0; b < run.size(); ++b)
      sum -= state.volume[run[b]] * ((T[b][0] + T[b][1] + T[b][2]) / 3 + scheme_.stress_shift(run[b]));
  });
  return sum;
}

template <int D>
void LagrangeMeans<D>::list(double time, std::vector<Quantity>& quantities) const {
  for (const Box& box : boxes_) {
    std::vector<double> x(3 + D);  // mass, volume, pressure times volume, momentum
    for (const int c : box.cells) {
      x[0] += scheme_.mass(c);
      x[1] += scheme_.state().volume[c];
      for (int i = 0; i < D; ++i) x[3 + i] += scheme_.mass(c) * scheme_.state().cell[c].q[i];
    }
    x[2] = pressure_volume(box, time);
    sum(x);
    quantities.push_back({"mean_density_" + box.name, "kg/m^3", x[0] / x[1]});
    quantities.push_back({"mean_pressure_" + box.name, "Pa", x[2] / x[1]});
    for (int i = 0; i < D; ++i)
      quantities.push_back({fmt::format("mean_velocity_{}_{}", box.name, "xyz"[i]), "m/s", x[3 + i] / x[0]});
  }
}

template class LagrangeMeans<2>;
template class LagrangeMeans<3>;

}  // namespace titin
