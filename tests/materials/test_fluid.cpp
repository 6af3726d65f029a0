// Equations of state against their closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/fluid.hpp"
#include "materials_for_tests.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-13;  // relative

std::shared_ptr<const Fluid> fluid(const std::string& lines) {
  Config config("[fluid]\n" + lines, "test.toml");
  auto law = Fluid::read(config.root().section("fluid"));
  config.finish();
  return law;
}

void expect_near(double value, double exact) { EXPECT_NEAR(value, exact, round_off * std::abs(exact)); }

TEST(PerfectGas, HasItsPressureAndSoundSpeed) {
  const auto air = fluid("law = \"perfect_gas\"\ngamma = 1.4");
  const auto state = air->state(1.2, 2e5);
  expect_near(state.pressure, 0.4 * 1.2 * 2e5);
  expect_near(state.sound_speed, std::sqrt(1.4 * state.pressure / 1.2));
  expect_near(air->energy(1.2, state.pressure), 2e5);
  EXPECT_TRUE(air->admissible(1.2, 2e5));
  EXPECT_FALSE(air->admissible(1.2, -1));
  EXPECT_FALSE(air->admissible(0, 2e5));
}

TEST(StiffenedGas, IsWaterAtRest) {
  const auto water = fluid("law = \"stiffened_gas\"\ngamma = 4.4\nstiffening = \"600 MPa\"");
  const double e = water->energy(1000, 1e5);
  const auto state = water->state(1000, e);
  EXPECT_NEAR(state.pressure, 1e5, 1e-6 * 1e5);  // the difference of two numbers 3e4 times larger
  EXPECT_NEAR(state.sound_speed, std::sqrt(4.4 * (1e5 + 6e8) / 1000), 1e-8);
  EXPECT_FALSE(water->admissible(1000, 0));  // pulled apart: p + Pi < 0
}

TEST(StiffenedGas, WithCovolumeHasTheNobleAbelSoundSpeed) {
  const auto gas = fluid(
      "law = \"stiffened_gas\"\ngamma = 1.25\ncovolume = \"1e-3 m^3/kg\"\nstiffening = \"1 MPa\"\nbond_energy = \"1e4 "
      "J/kg\"");
  const auto state = gas->state(200, 1e6);
  expect_near(state.pressure, 0.25 * 200 * (1e6 - 1e4) / (1 - 0.2) - 1.25e6);
  expect_near(state.sound_speed, std::sqrt(1.25 * (state.pressure + 1e6) / (200 * (1 - 0.2))));
  EXPECT_FALSE(gas->admissible(1001, 1e6));
}

TEST(MieGruneisen, FollowsItsHugoniot) {
  const double rho0 = 8930, c0 = 3940, s = 1.49;
  const auto copper = fluid(
      "law = \"mie_gruneisen\"\nreference_density = \"8930 kg/m^3\"\nsound_speed = \"3940 m/s\"\nslope = "
      "1.49\ngruneisen = 2.0");
  expect_near(copper->state(rho0, 0).sound_speed, c0);
  EXPECT_NEAR(copper->state(rho0, 0).pressure, 0, round_off * rho0 * c0 * c0);
  // behind a shock of particle speed u: Us = c0 + s u, rho = rho0 Us / (Us - u), e = u^2 / 2, p = rho0 Us u
  for (double u : {10.0, 500.0, 2000.0}) {
    const double Us = c0 + s * u;
    EXPECT_NEAR(copper->state(rho0 * Us / (Us - u), 0.5 * u * u).pressure, rho0 * Us * u, 1e-10 * rho0 * Us * u);
  }
  EXPECT_FALSE(copper->admissible(rho0 * s / (s - 1) * 1.001, 0));
}

TEST(IsotropicFamily, HasOneShearModulusForEveryShape) {
  using namespace testing;
  for (double a : {-1.0, -0.3, 0.0, 0.5}) {
    const auto m = material_of("isotropic_family", "mu = \"7 Pa\", a = " + std::to_string(a));
    Point p;
    const double g = 1e-5;
    p.F = {1, g, 0, 0, 1, 0, 0, 0, 1};
    EXPECT_NEAR(stress(*m, p)[1] / g, 7, 1e-6) << a;
  }
}

}  // namespace
}  // namespace titin
