// Pressures averaged over patches: what they keep, what they leave alone, and what they store.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "flows_for_tests.hpp"
#include "fv/patch_pressure.hpp"

namespace titin {
namespace {

using namespace test;

/// Rubber on the unit box whose cells right of the middle are another region; nodes moved by `map`.
template <int D>
struct Patched {
  explicit Patched(const std::function<Vector<D>(const Vector<D>&)>& map, double distortion = 0.2)
      : parallel(two_regions(distortion)),
        mesh(*parallel),
        exchange(*parallel, mesh),
        rubber_closure(make_closure(rubber())),
        closure(mesh.cells(), rubber_closure.get()),
        state(mesh.cells(), mesh.nodes()),
        patches(mesh, exchange, closure) {
    for (int p = 0; p < mesh.nodes(); ++p) state.x[p] = map(mesh.x[p]);
    for (int c = 0; c < mesh.cells(); ++c) state.volume[c] = simplex_volume<D>(mesh.corners_of(c, state.x));
    patches.apply(state);
  }
  static std::unique_ptr<mfem::ParMesh> two_regions(double distortion) {
    auto box = unit_box<D>(4, distortion);
    mfem::Vector centre;
    for (int e = 0; e < box->GetNE(); ++e) {
      box->GetElementCenter(e, centre);
      box->SetAttribute(e, centre(0) > 0.5 ? 5 : 2);
    }
    box->SetAttributes();
    return box;
  }
  double at_rest(int c) const { return simplex_volume<D>(mesh.corners_of(c, mesh.x)); }

  std::unique_ptr<mfem::ParMesh> parallel;
  SimplexMesh<D> mesh;
  NodeExchange exchange;
  std::unique_ptr<Closure> rubber_closure;
  std::vector<const Closure*> closure;
  FlowState<D> state;
  PatchPressure<D> patches;
};

template <class Dimension>
class PatchPressures : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PatchPressures, Dimensions);

// Each region is compressed evenly, one more than the other: cells of one never see the other.
TYPED_TEST(PatchPressures, LeaveEvenCompressionAloneAndKeepToTheirRegion) {
  constexpr int D = TypeParam::value;
  const Patched<D> body(
      [](Vector<D> x) {
        x[0] = x[0] < 0.5 ? 0.9 * x[0] : 0.45 + 0.7 * (x[0] - 0.5);
        return x;
      },
      0);
  for (int c = 0; c < body.mesh.cells(); ++c) EXPECT_NEAR(body.patches.stress(c), 0, 1e-13 * rubber_kappa);
}

// The energy of cells is that of the patches: sum over nodes and regions of W U(sum |w| / sum |w0|), here over all
// ranks.
TYPED_TEST(PatchPressures, StoreTheEnergyOfThePatches) {
  constexpr int D = TypeParam::value;
  const Patched<D> body([](Vector<D> x) {
    x[0] *= 1 + 0.05 * std::sin(9 * x[D - 1] + 5 * x[0]);
    return x;
  });
  std::map<std::pair<int, int>, std::array<double, 2>> volumes;
  double stored = 0, changed = 0;
  for (int c = 0; c < body.mesh.cells(); ++c) {
    const double at_rest = body.at_rest(c), own = body.rubber_closure->volumetric(body.state.volume[c] / at_rest).U;
    stored += at_rest * (own + body.patches.energy(c));
    changed += at_rest * std::abs(body.patches.energy(c));
    for (int p : body.mesh.nodes_of[c]) {
      volumes[{p, body.mesh.region[c]}][0] += body.state.volume[c];
      volumes[{p, body.mesh.region[c]}][1] += at_rest;
    }
  }
  if (ranks() > 1) return;  // the sum below is over whole patches
  double of_patches = 0;
  for (const auto& [key, volume] : volumes)
    of_patches += volume[1] / (D + 1) * body.rubber_closure->volumetric(volume[0] / volume[1]).U;
  EXPECT_NEAR(stored, of_patches, 1e-12 * of_patches);
  EXPECT_GT(changed, 0.05 * of_patches) << "there was something to average";
}

// The work of averaged pressures is the rate of their energy: sum of stress times change of volume, for any motion.
TYPED_TEST(PatchPressures, DeriveFromTheirEnergy) {
  constexpr int D = TypeParam::value;
  const auto energy_and_power = [](double t) {
    const Patched<D> body([t](Vector<D> x) {
      x[0] *= 1 + 0.05 * std::sin(9 * x[D - 1] + 5 * x[0]) + 0.02 * t * std::cos(7 * x[0] + x[D - 1]);
      return x;
    });
    const Patched<D> rest([](Vector<D> x) { return x; });
    double energy = 0;
    std::vector<double> dU(body.mesh.cells()), volume = body.state.volume;
    for (int c = 0; c < body.mesh.cells(); ++c) {
      const auto own = body.rubber_closure->volumetric(volume[c] / body.at_rest(c));
      energy += body.at_rest(c) * (own.U + body.patches.energy(c));
      dU[c] = own.dU + body.patches.stress(c);
    }
    return std::tuple(sum(energy), dU, volume);
  };
  constexpr double h = 1e-4;
  const auto [before, dU_before, w_before] = energy_and_power(-h);
  const auto [after, dU_after, w_after] = energy_and_power(h);
  const auto [now, dU, w] = energy_and_power(0);
  double work = 0;
  for (std::size_t c = 0; c < dU.size(); ++c) work += dU[c] * (w_after[c] - w_before[c]);
  EXPECT_NEAR(after - before, sum(work), 1e-5 * std::abs(after - before));
}

TYPED_TEST(PatchPressures, KeepMomentumAndEnergy) {
  constexpr int D = TypeParam::value;
  const Table ramp({0, 1e-3}, {0, 1});
  BoundaryCondition<D> pulled, held;
  pulled.attributes = {1};
  pulled.traction[0] = 2e6;
  pulled.traction_scale = &ramp;
  held.attributes = {3};
  held.velocity[0] = held.velocity[1] = &at_rest;
  for (Predictor predictor : {Predictor::hancock, Predictor::ader, Predictor::rk2}) {
    FvConfig config;
    config.predictor = predictor;
    config.patch_pressure = true;
    Flow<D> flow(unit_box<D>(3, 0.2), make_closure(rubber()), config, {pulled, held},
                 [](const Vector<D>& x, const Closure& closure) {
                   CellStart start{nullptr, rubber_density, closure.energy_at(0, 0), {}};
                   start.velocity[0] = 20 * std::sin(5 * x[1]);
                   return start;
                 });
    for (int k = 0; k < 8; ++k) {
      const Totals before = totals(*flow.scheme);
      flow.step();
      const Totals after = totals(*flow.scheme);
      const auto outside = boundary_force(*flow.scheme);
      EXPECT_NEAR(after.energy - before.energy, flow.last_dt * outside.power, 1e-13 * std::abs(after.energy));
      for (int i = 0; i < D; ++i)
        EXPECT_NEAR(after.momentum[i] - before.momentum[i], flow.last_dt * outside.force[i],
                    1e-13 * std::sqrt(after.energy * after.mass));
    }
    double most = 0;
    for (int c = 0; c < flow.mesh.cells(); ++c) most = std::max(most, std::abs(flow.scheme->stress_shift(c)));
    EXPECT_GT(max(most), 1) << "Pa: pressures are averaged";
  }
}

}  // namespace
}  // namespace titin
