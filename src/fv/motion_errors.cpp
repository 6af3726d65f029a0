#include "fv/motion_errors.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr int compared = 6;
constexpr std::array<const char*, compared> names{"displacement", "velocity",     "pressure",
                                                  "B_along",      "stress_along", "deviator_along"};
constexpr std::array<const char*, compared> units{"m", "m/s", "Pa", "", "Pa", "Pa"};

template <int D>
Vec3 spatial(const Vector<D>& a) {
  Vec3 b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}

double along(const Sym3& S, const Vec3& n) { return dot(n, multiply(full(S), n)); }

/// Sizes of the errors of one cell.
template <int D>
std::array<double, compared> sizes(const FlowScheme<D>& scheme, int cell, const Sym3& T, const ExactMotion& exact,
                                   double time) {
  const auto& record = scheme.state().cell[cell];
  const Vec3 X = spatial<D>(centroid<D>(scheme.mesh().corners_of(cell, scheme.mesh().x)));
  const Vec3 n = exact.direction(X);
  const MotionPoint point = exact.at(X, time);
  const Mat3 F = scheme.deformation(cell, scheme.state());
  const auto pressure = [](const Sym3& S) { return -(S[0] + S[1] + S[2]) / 3; };
  const double p = pressure(T), p_exact = pressure(point.stress);
  const double B = along(symmetric_part(multiply(F, transpose(F))), n) - 1, T_nn = along(T, n),
               T_exact = along(point.stress, n);
  return {norm(difference(difference(spatial<D>(record.centre), X), point.displacement)),
          norm(difference(spatial<D>(velocity_of<D>(record.q)), point.velocity)),
          std::abs(p - p_exact),
          std::abs(B - 2 * along(point.strain, n)),
          std::abs(T_nn - T_exact),
          std::abs(T_nn + p - T_exact - p_exact)};
}

}  // namespace

template <int D>
std::vector<Quantity> motion_errors(const FlowScheme<D>& scheme, const ExactMotion& exact, double time) {
  std::vector<double> integral(2 * compared);
  std::array<double, compared> largest{};
  scheme.for_blocks(scheme.all_cells(), [&](std::span<const int> run, const Closure& closure) {
    std::array<Mat3, cells_per_block> F;
    std::array<double, cells_per_block> density, energy;
    std::array<Sym3, cells_per_block> T;
    for (std::size_t b = 0; b < run.size(); ++b) {
      F[b] = scheme.deformation(run[b], scheme.state());
      density[b] = scheme.state().cell[run[b]].density;
      energy[b] = scheme.state().internal_energy(run[b]);
    }
    closure.stress({static_cast<int>(run.size()), F.data(), density.data(), energy.data(), nullptr, time}, T.data());
    for (std::size_t b = 0; b < run.size(); ++b) {
      for (int i = 0; i < 3; ++i) T[b][i] += scheme.stress_shift(run[b]);
      const auto error = sizes<D>(scheme, run[b], T[b], exact, time);
      const double volume = simplex_volume<D>(scheme.mesh().corners_of(run[b], scheme.mesh().x));
      for (int k = 0; k < compared; ++k) {
        integral[2 * k] += volume * error[k];
        integral[2 * k + 1] += volume * error[k] * error[k];
        largest[k] = std::max(largest[k], error[k]);
      }
    }
  });
  sum(integral);
  std::vector<Quantity> list;
  for (int k = 0; k < compared; ++k) {
    const std::string name = names[k];
    list.push_back({name + "_L1", units[k], integral[2 * k]});
    list.push_back({name + "_L2", units[k], std::sqrt(integral[2 * k + 1])});
    list.push_back({name + "_Linf", units[k], max(largest[k])});
  }
  return list;
}

template std::vector<Quantity> motion_errors<2>(const FlowScheme<2>&, const ExactMotion&, double);
template std::vector<Quantity> motion_errors<3>(const FlowScheme<3>&, const ExactMotion&, double);

}  // namespace titin
