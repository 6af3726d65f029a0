// Known flows against published and independent numbers, and the scheme against a strong shock.
#include <gtest/gtest.h>

#include "flows_for_tests.hpp"
#include "fv/hugoniot.hpp"
#include "fv/piston.hpp"
#include "fv/radial_gas.hpp"
#include "fv/riemann.hpp"
#include "fv/sedov.hpp"
#include "fv/simple_wave.hpp"
#include "materials/fluid.hpp"

namespace titin {
namespace {

using namespace test;

// Energies by Kamm & Timmes (2007), LA-UR-07-2849; what is behind a strong shock of speed D by Rankine and Hugoniot.
TEST(KnownFlows, SedovsBlast) {
  for (int j : {2, 3}) {
    const double energy = j == 2 ? 0.979264 : 0.851072;
    const Sedov blast({1, 1e-6, energy, 1.4}, j);
    EXPECT_NEAR(blast.alpha(), j == 2 ? 0.98407402 : 0.85107186, 1e-8);
    const double R = blast.shock_radius(1), D = 2 * R / (j + 2);
    const FlowPoint behind = blast.at({R * (1 - 1e-9), 0, 0}, 1), ahead = blast.at({R * (1 + 1e-9), 0, 0}, 1);
    EXPECT_NEAR(behind.density, 6, 1e-6);
    EXPECT_NEAR(behind.pressure, 2 * D * D / 2.4, 1e-7);
    EXPECT_NEAR(behind.velocity[0], 2 * D / 2.4, 1e-7);
    EXPECT_EQ(ahead.density, 1);
    const double a = blast.at({0, 1e-3, 0}, 1).pressure, b = blast.at({0, 0, 0.1}, 1).pressure;
    EXPECT_NEAR(a, b, 1e-6 * a) << "as good as uniform near the centre";
  }
}

// Mass inside the shock is what was there before: an integral over the whole profile.
TEST(KnownFlows, SedovKeepsMass) {
  for (int j : {2, 3}) {
    const Sedov blast({1, 1e-6, 1, 1.4}, j);
    const double R = blast.shock_radius(0.7);
    constexpr int n = 20000;
    double mass = 0;
    for (int k = 0; k < n; ++k) {
      const double r = R * (k + 0.5) / n;
      mass += blast.at({r, 0, 0}, 0.7).density * std::pow(r, j - 1) * R / n;
    }
    EXPECT_NEAR(mass, std::pow(R, j) / j, 1e-4 * mass);
  }
}

/// Of a side's fluid at a point of the flow [J/m^3].
double energy_density(const Riemann::Side& s, const FlowPoint& q) {
  const double e = (q.pressure + s.gamma * s.stiffening) * (1 - s.covolume * q.density) / ((s.gamma - 1) * q.density);
  return q.density * (e + 0.5 * dot(q.velocity, q.velocity));
}

// What lies between two planes that no wave has reached changes by the fluxes through them alone.
TEST(KnownFlows, RiemannProblemsOfTwoFluidsKeepMassMomentumAndEnergy) {
  const Riemann::Side light{1, 2, 0.1, 5.0 / 3, 0.2, 0}, dense{0.5, 0.2, -0.3, 1.2, 0.4, 0},
      stiff{0.8, -0.5, -1.5, 4.4, 0.3, 2}, rushing{0.8, -0.5, 1.5, 4.4, 0.3, 2};
  const Riemann::Side pairs[][2] = {{light, dense}, {light, stiff}, {rushing, dense}};
  for (const auto& [left, right] : pairs) {
    const Riemann flow(left, right, 0.5);
    constexpr double t = 0.1;
    constexpr int n = 200000;
    const double contact = 0.5 + flow.star_velocity() * t;
    double mass = 0, momentum = 0, energy = 0;
    for (int k = 0; k < n; ++k) {
      const double x = (k + 0.5) * 2 / n - 0.5;
      const FlowPoint q = flow.at({x, 0, 0}, t), start = flow.at({x, 0, 0}, 0);
      const Riemann::Side &now = x < contact ? left : right, &before = x < 0.5 ? left : right;
      mass += (q.density - start.density) * 2 / n;
      momentum += (q.density * q.velocity[0] - start.density * start.velocity[0]) * 2 / n;
      energy += (energy_density(now, q) - energy_density(before, start)) * 2 / n;
    }
    const auto flux = [](const Riemann::Side& s) {
      const FlowPoint q{s.density, s.pressure, {s.velocity, 0, 0}};
      return std::array{s.density * s.velocity, s.density * s.velocity * s.velocity + s.pressure,
                        (energy_density(s, q) + s.pressure) * s.velocity};
    };
    const auto in = flux(left), out = flux(right);
    EXPECT_NEAR(mass, t * (in[0] - out[0]), 3e-5);
    EXPECT_NEAR(momentum, t * (in[1] - out[1]), 3e-5);
    EXPECT_NEAR(energy, t * (in[2] - out[2]), 2e-4);
  }
}

// Behind the shock the law itself has the pressure of the jump: e = p (1 / rho_0 - 1 / rho) / 2.
TEST(KnownFlows, MieGrueneisenMeetsItsHugoniot) {
  const HugoniotShock shock({8930, 3940, 1.489, 1000});
  const FlowPoint behind = shock.at({}, 1e-6);
  EXPECT_NEAR(behind.pressure, 48.48097e9, 1e4);
  for (double gruneisen : {0.5, 2.0}) {
    const MieGruneisen copper{8930, 3940, 1.489, gruneisen};
    const double e = 0.5 * behind.pressure * (1 / 8930.0 - 1 / behind.density);
    EXPECT_NEAR(copper.pressure(behind.density, e), behind.pressure, 1e-9 * behind.pressure);
  }
}

// Jump conditions worked out by hand (multiples of those at no pressure: 4, 10, 20, 35, 56, 84, 120).
TEST(KnownFlows, PistonAndItsReflections) {
  const Piston piston({});
  const double start[] = {0, 0.749930, 0.899961, 0.949977, 0.971414, 0.982133, 0.988089},
               density[] = {3.998876, 9.996064, 19.990880, 34.982634, 55.970641, 83.954212, 119.932661},
               pressure[] = {1.333558, 7.998851, 27.992229, 74.640113, 167.931510, 335.850427, 615.708294};
  for (int k = 0; k < 7; ++k) {
    EXPECT_NEAR(piston.shocks()[k].start, start[k], 1e-6);
    EXPECT_NEAR(piston.shocks()[k].behind.density, density[k], 1e-6);
    EXPECT_NEAR(piston.shocks()[k].behind.pressure, pressure[k], 1e-6 * pressure[k]);
  }
  const Piston cold({1, 1e-12, 1, 1, 5.0 / 3});
  EXPECT_NEAR(cold.shocks()[6].behind.density, 120, 1e-4);
  EXPECT_EQ(piston.at({0.5, 0, 0}, 0.2).density, 1);
  EXPECT_NEAR(piston.at({0.25, 0, 0}, 0.2).velocity[0], 1, 0);
}

// Another code along the radius, 4000 shells (MUSCL and HLLC too); in one dimension the exact solution.
TEST(KnownFlows, ExplosionsAlongTheRadius) {
  struct Row {
    double r, density, velocity, pressure;
  };
  const Row cylinder[] = {{0.3, 0.70297, 0.37285, 0.61054}, {0.4, 0.47886, 0.72304, 0.35669},
                          {0.6, 0.33743, 0.95275, 0.21851}, {0.7, 0.35725, 0.86205, 0.23668},
                          {0.8, 0.23032, 0.80283, 0.24524}, {0.9, 0.23548, 0.76141, 0.25072}},
            ball[] = {{0.3, 0.64457, 0.42937, 0.54073},
                      {0.4, 0.40485, 0.79076, 0.28198},
                      {0.6, 0.26662, 0.95912, 0.15713},
                      {0.7, 0.30718, 0.77192, 0.19158},
                      {0.8, 0.20465, 0.67352, 0.20517}};
  Explosion::Setup setup;
  setup.shells = 1000;
  const auto compare = [&](int dimension, const auto& rows) {
    const RadialProfile profile = Explosion(setup, dimension).profile(0.25);
    for (const Row& row : rows) {
      EXPECT_NEAR(profile.at(row.r).density, row.density, 0.007 * row.density) << dimension << ", r = " << row.r;
      EXPECT_NEAR(profile.at(row.r).velocity[0], row.velocity, 0.007 * row.velocity) << dimension << ", r = " << row.r;
      EXPECT_NEAR(profile.at(row.r).pressure, row.pressure, 0.007 * row.pressure) << dimension << ", r = " << row.r;
    }
  };
  compare(2, cylinder);
  compare(3, ball);
  const RadialProfile slab = Explosion(setup, 1).profile(0.2);
  const Riemann sod({1, 1, 0}, {0.125, 0.1, 0}, 0.5, 1.4);
  double error = 0;
  for (int k = 0; k < 1000; ++k)
    error += std::abs(slab.at((k + 0.5) / 1000).density - sod.at({(k + 0.5) / 1000, 0, 0}, 0.2).density) / 1000;
  EXPECT_LT(error, 1.5e-3);
}

TEST(KnownFlows, SimpleWaveSolvesItsEquations) {
  const SimpleWave wave({});
  constexpr double t = 0.3, d = 1e-5;
  EXPECT_GT(wave.breaking_time(), 1);
  for (double x : {0.55, 0.7, 0.8}) {
    const FlowPoint here = wave.at({x, 0, 0}, t), right = wave.at({x + d, 0, 0}, t), left = wave.at({x - d, 0, 0}, t),
                    later = wave.at({x, 0, 0}, t + d), before = wave.at({x, 0, 0}, t - d);
    const double u = here.velocity[0], du = (right.velocity[0] - left.velocity[0]) / (2 * d);
    EXPECT_NEAR(
        (later.density - before.density) / (2 * d) + u * (right.density - left.density) / (2 * d) + here.density * du,
        0, 1e-6);
    EXPECT_NEAR(here.density * ((later.velocity[0] - before.velocity[0]) / (2 * d) + u * du) +
                    (right.pressure - left.pressure) / (2 * d),
                0, 1e-6);
  }
}

// Boxes cut along the same diagonal, on which single cells collapsed before shocks were seen.
TEST(Shocks, SaltzmansPistonWithSlopesKeepsItsCells) {
  const Table speed{-1.0};
  BoundaryCondition<2> push;
  push.attributes = {4};
  push.normal_velocity = &speed;
  auto mesh = unit_box<2>(50, 0, 1, 5);
  for (int v = 0; v < mesh->GetNV(); ++v) {
    double* x = mesh->GetVertex(v);
    x[0] += (0.1 - x[1]) * std::sin(M_PI * x[0]);
  }
  const Piston piston({});
  Flow<2> flow(std::move(mesh), make_closure(perfect_gas(5.0 / 3)), {}, {push, wall<2>({1, 2, 3})},
               start_from<2>(piston));
  flow.run_to(0.6);
  double densest = 0;
  for (const auto& cell : flow.scheme->state().cell) densest = std::max(densest, cell.density);
  densest = max(densest);  // of all ranks
  const MeanErrors errors = mean_errors(flow, piston);
  if (is_root())
    fmt::print("Saltzman: {} steps, density {:.3e} (largest {:.2f}), pressure {:.3e}\n", flow.steps, errors.density,
               densest, errors.pressure);
  EXPECT_LT(densest, 6);
  EXPECT_LT(errors.density, 1.0e-2);
  EXPECT_LT(flow.steps, 500);
}

}  // namespace
}  // namespace titin
