// Exact motions of solids: Blake's cavity against tabulated values and its own equations, the swinging plate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/exact_motion.hpp"

namespace titin {
namespace {

// E = 62.5 GPa, nu = 0.25, 3000 kg/m^3: a wave of 5000 m/s.
const LinearSolid rock{62.5e9 / 1.5, 25e9, 3000};
const Blake cavity(rock, 0.1, 1e6);

double pressure(const Sym3& T) { return -(T[0] + T[1] + T[2]) / 3; }

// At 160 us; by an independent evaluation of the formulas of Kamm & Ankeny (2009), as ExactPack's blake module has
// them.
TEST(ExactMotion, BlakesCavityHasTheTabulatedValues) {
  struct Row {
    double r, u, p, deviator;
  };
  for (const Row& row : {Row{0.1, 1.001770e-6, -9.832e2, -1.000983e6}, Row{0.2, 2.493179e-7, 1.9075e3, -1.26185e5},
                         Row{0.5, 3.183090e-8, -3.0253e3, -3.9460e3}, Row{0.7, 6.909425e-8, -2.05439e4, 6.5645e3},
                         Row{0.895, 7.222267e-9, 5.79710e4, -4.71838e4}}) {
    const MotionPoint point = cavity.at({row.r, 0, 0}, 1.6e-4);
    const double p = pressure(point.stress);
    EXPECT_NEAR(point.displacement[0], row.u, 1e-6 * row.u) << row.r;
    EXPECT_NEAR(p, row.p, 2e-4 * std::abs(row.p)) << row.r;
    EXPECT_NEAR(point.stress[0] + p, row.deviator, 2e-4 * std::abs(row.deviator)) << row.r;
  }
}

TEST(ExactMotion, BlakesCavityStandsUnderItsPressureAndMovesAsNewtonSays) {
  EXPECT_NEAR(cavity.at({0.1, 0, 0}, 5e-5).stress[0], -1e6, 1e-3);
  EXPECT_EQ(norm(cavity.at({0.91, 0, 0}, 1.6e-4).displacement), 0) << "ahead of the front";
  const double r = 0.4, t = 1.2e-4, h = 1e-5, k = 1e-9;  // rho dv/dt = dT_rr/dr + 2 (T_rr - T_tt) / r
  const auto at = [](double radius, double time) { return cavity.at({0, radius, 0}, time); };
  const double slope = (at(r + h, t).stress[1] - at(r - h, t).stress[1]) / (2 * h);
  const double force = slope + 2 * (at(r, t).stress[1] - at(r, t).stress[0]) / r;
  const double acceleration = (at(r, t + k).velocity[1] - at(r, t - k).velocity[1]) / (2 * k);
  EXPECT_NEAR(rock.density * acceleration, force, 1e-5 * std::abs(force));
  EXPECT_NEAR((at(r, t + k).displacement[1] - at(r, t - k).displacement[1]) / (2 * k), at(r, t).velocity[1], 1e-8);
}

TEST(ExactMotion, SwingingPlateMovesAsNewtonSays) {
  const Swing plate({56.67e6, 5.862069e6, 1100}, 5e-4, 2);
  EXPECT_NEAR(plate.frequency(), 162.16756, 1e-4);
  const double x = 0.7, y = 0.3, t = 3e-3, h = 1e-4, k = 1e-6;
  const auto T = [&](double a, double b) { return plate.at({a, b, 0}, t).stress; };
  const double force = (T(x + h, y)[0] - T(x - h, y)[0] + T(x, y + h)[3] - T(x, y - h)[3]) / (2 * h);
  const auto v = [&](double time) { return plate.at({x, y, 0}, time).velocity[0]; };
  EXPECT_NEAR(1100 * (v(t + k) - v(t - k)) / (2 * k), force, 1e-6 * std::abs(force));
  EXPECT_NEAR(norm(plate.at({x, y, 0}, std::numbers::pi / plate.frequency()).displacement), 0, 1e-18);
}

}  // namespace
}  // namespace titin
