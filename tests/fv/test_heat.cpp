// A solid's heat does not turn back into motion.
#include <gtest/gtest.h>

#include "flows_for_tests.hpp"

namespace titin {
namespace {

using namespace test;

std::shared_ptr<const Material> jelly() {
  Config text(R"(density = "1020 kg/m^3"
volumetric = { law = "quad_log", bulk_modulus = "0.918 MPa" }
terms.base = { law = "neo_hookean", mu = "85 Pa" })",
              "test.toml");
  auto material = Material::read(text.root());
  text.finish();
  return material;
}

double heat(const Flow<2>& flow) {
  std::vector<double> whole(1);
  const FlowScheme<2>& scheme = *flow.scheme;
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const Mat3 F = scheme.deformation(c, scheme.state());
    CellBatch in;
    in.n = 1;
    in.F = &F;
    double psi;
    flow.closure->stored(in, &psi);
    whole[0] += scheme.mass(c) * (scheme.state().internal_energy(c) - psi);
  }
  sum(whole);
  return whole[0];
}

/// A disc of jelly falls on a slippery floor at seven times the speed of its shear waves and is flattened. Returns the
/// most heat that is lost again, as a part of its energy, and what it has in the end.
std::array<double, 2> lost_heat(double tolerance) {
  constexpr double radius = 6.1e-3, end = 6e-3;
  BoundaryCondition<2> floor;
  floor.attributes = plane_sides;
  floor.has_obstacle = true;
  floor.obstacle.normal[1] = 1;
  FvConfig config;
  config.heat_tolerance = tolerance;
  const auto disc = [](double a, double b) {
    const double u = 2 * a - 1, v = 2 * b - 1;
    return Vector<2>{radius * u * std::sqrt(1 - v * v / 2), radius * (1 + v * std::sqrt(1 - u * u / 2))};
  };
  Flow<2> flow(mapped_grid(8, 8, disc), make_closure(jelly()), config, {floor},
               [](const Vector<2>&, const Closure& closure) {
                 return CellStart{nullptr, 1020, closure.energy_at(0, 0), {0, -2, 0}};
               });
  const double start = totals(*flow.scheme).energy;
  double most = 0, lost = 0, now = 0;
  while (flow.t < end && !testing::Test::HasFatalFailure()) {
    for (int k = 0; k < 10; ++k) flow.step();
    now = heat(flow) / start;
    most = std::max(most, now);
    lost = std::max(lost, most - now);
  }
  return {lost, now};
}

TEST(Heat, OfAFlatDropStaysWithMood) {
  const auto judged = lost_heat(FvConfig{}.heat_tolerance), free = lost_heat(1e9);
  if (is_root())
    fmt::print("flat drop: heat lost {:.2e} of {:.3f}; not judged {:.2e} of {:.3f}\n", judged[0], judged[1], free[0],
               free[1]);
  EXPECT_LT(judged[0], 3e-3);
  EXPECT_GT(free[0], 1e-2) << "or it shows nothing";
}

}  // namespace
}  // namespace titin
