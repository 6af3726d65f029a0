// Springs to ground and rigid walls against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double newton_accuracy = 1e-7;  // relative: what solver.tolerance = 1e-10 leaves

const std::string tight = "[solver]\ntolerance = 1e-10\n";
const std::string sliding_sides = R"(
[boundary."y-"]
displacement.y = "0 mm"
[boundary."z-"]
displacement.z = "0 mm"
)";

TEST(Spring, HoldsABlockThatIsPulledAtItsOtherEnd) {
  const double k = 300;  // N/m
  const auto model =
      make_block("[muscle]\ninertia = \"quasi-static\"\n" + sliding_sides +
                 "[boundary.\"x-\"]\ndisplacement.x = \"-6 mm\"\n[boundary.\"x+\"]\nspring = \"300, 0, 0 "
                 "N/m\"\n[markers]\nend = \"30, 10, 10 mm\"\n" +
                 tight + soft_material);
  const Step step = model->advance(1.0);
  ASSERT_TRUE(step.ok()) << step.failure;
  EXPECT_LE(step.newton, 6);
  model->accept();
  const double u = quantity(*model, "marker_end_ux"), l = 1 + (u + 0.006) / 0.03;
  const double m = 1 + quantity(*model, "marker_end_uy") / 0.01;
  const double mu = 100e3, kappa = 500e3, J = l * m * m, I1 = l * l + 2 * m * m, y = std::pow(J, -2.0 / 3);
  const double dU = kappa / 2 * (J - 1 / J), P = mu * y * (l - I1 / (3 * l)) + dU * m * m;
  EXPECT_LT(u, -1e-3);
  EXPECT_NEAR(P * 1e-4, -k * u, newton_accuracy * k * std::abs(u)) << "the block's own law against the spring's";
  EXPECT_NEAR(quantity(*model, "support_x+_x"), -k * u, newton_accuracy);
  EXPECT_NEAR(quantity(*model, "reaction_x-_x"), k * u, newton_accuracy);
  EXPECT_NEAR(quantity(*model, "energy_support_x+"), 0.5 * k * u * u, newton_accuracy * k * u * u);
}

/// A stiff block falls on a spring: at each step backward Euler's own answer for a mass m, at the end of first order to
/// the exact m g / k (1 - cos omega t).
TEST(Spring, CarriesAMassThatOscillates) {
  const double k = 12, mass = 1000 * 3e-6, g = 2, omega = std::sqrt(k / mass), end = 0.04;
  const auto run = [&](int steps) {
    const auto model =
        make_block("[body]\nacceleration = \"2, 0, 0 m/s^2\"\n" + sliding_sides +
                   "[boundary.\"x+\"]\nspring = \"12, 0, 0 N/m\"\n[markers]\np = \"30, 0, 0 mm\"\n" + tight +
                   "[materials.stiff]\ndensity = \"1000 kg/m^3\"\nvolumetric = { law = \"simo\", bulk_modulus "
                   "= \"500 MPa\" }\n[materials.stiff.terms]\nbase = { law = \"neo_hookean\", mu = \"100 MPa\" "
                   "}\n");
    const double dt = end / steps;
    double x = 0, v = 0;
    for (const Step& step : march(*model, end, dt)) {
      EXPECT_TRUE(step.ok()) << step.failure;
      EXPECT_LE(step.newton, 4);
      v = (v + dt * (g - k / mass * x)) / (1 + dt * dt * k / mass);
      x += dt * v;
    }
    const double u = quantity(*model, "marker_p_ux");
    constexpr double elastic = 1e-4;  // the block gives by k L / (E A) = 1e-5 of that
    EXPECT_NEAR(u, x, elastic * std::abs(x));
    return std::abs(u - mass * g / k * (1 - std::cos(omega * end)));
  };
  const double coarse = run(40), fine = run(80);
  fmt::print("mass on a spring: error {:.2e}, half the step {:.2e}, order {:.2f}\n", coarse, fine,
             std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.15);
}

/// The same mass, damped and under its weight from the start, by two schemes: the exact decaying oscillation.
TEST(Damper, TakesAnOscillationAtTheOrderOfTheScheme) {
  const double k = 12, c = 0.05, mass = 1000 * 3e-6, g = 2, end = 0.04;
  const double omega = std::sqrt(k / mass), decay = c / (2 * mass), damped = std::sqrt(omega * omega - decay * decay);
  const double exact =
      mass * g / k * (1 - std::exp(-decay * end) * (std::cos(damped * end) + decay / damped * std::sin(damped * end)));
  for (const auto& [scheme, order] : {std::pair{"backward_euler", 1.0}, {"newmark", 2.0}}) {
    const auto run = [&, scheme = scheme](int steps) {
      const auto model = make_block(std::string("[time]\nscheme = \"") + scheme +
                                    "\"\n[body]\nacceleration = \"2, 0, 0 m/s^2\"\n" + sliding_sides +
                                    "[boundary.\"x+\"]\nspring = \"12, 0, 0 N/m\"\ndamper = \"0.05, 0, 0 N s/m\"\n"
                                    "[markers]\np = \"30, 0, 0 mm\"\n" +
                                    tight +
                                    "[materials.stiff]\ndensity = \"1000 kg/m^3\"\nvolumetric = { law = \"simo\", "
                                    "bulk_modulus = \"500 MPa\" }\n[materials.stiff.terms]\nbase = { law = "
                                    "\"neo_hookean\", mu = \"100 MPa\" }\n");
      for (const Step& step : march(*model, end, end / steps)) {
        EXPECT_TRUE(step.ok()) << step.failure;
        EXPECT_LE(step.newton, 4);
      }
      if (order == 2) {
        const double held = quantity(*model, "energy_support_x+") + quantity(*model, "energy_kinetic");
        const double taken = quantity(*model, "dissipation_support_x+");
        EXPECT_GT(taken, 0.1 * held);
        EXPECT_NEAR(held + taken, quantity(*model, "work_body"), 1e-3 * held) << "energy goes nowhere else";
      }
      return std::abs(quantity(*model, "marker_p_ux") - exact);
    };
    const double coarse = run(20), fine = run(40);
    fmt::print("damped mass on a spring, {}: error {:.2e}, half the step {:.2e}, order {:.2f}\n", scheme, coarse, fine,
               std::log2(coarse / fine));
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.25);
  }
}

/// Pressed by 0.5 mm on a plane, and lifted off: exact forces of a uniform block, no more gap than allowed, none of the
/// plane's pull.
TEST(Wall, IsMetWithinTheToleranceAndLetsGo) {
  const auto model = make_block(
      "[muscle]\ninertia = \"quasi-static\"\n[boundary.\"x-\"]\ndisplacement.x = \"0 mm\"\n[boundary.\"y-\"]\n"
      "displacement.y = \"0 mm\"\n[boundary.\"z-\"]\nwall = { point = \"0, 0, 0 mm\", normal = [0, 0, 1], penalty = "
      "\"1 "
      "GPa/m\", gap_tolerance = \"1 nm\" }\n[boundary.\"z+\"]\ndisplacement.z = { time = \"0, 1, 2 s\", value = \"0, "
      "-0.5, 0.5 mm\" }\n[markers]\nside = \"30, 0, 0 mm\"\n" +
      tight + soft_material);
  const Step pressed = model->advance(1.0);
  ASSERT_TRUE(pressed.ok()) << pressed.failure;
  fmt::print("pressed on a wall: {} Newton iterations\n", pressed.newton);
  EXPECT_LE(pressed.newton, 12);
  model->accept();
  const double l = 0.95, m = 1 + quantity(*model, "marker_side_ux") / 0.03;
  const double mu = 100e3, kappa = 500e3, J = l * m * m, I1 = l * l + 2 * m * m, y = std::pow(J, -2.0 / 3);
  const double dU = kappa / 2 * (J - 1 / J), force = -(mu * y * (l - I1 / (3 * l)) + dU * m * m) * 3e-4;
  constexpr double of_gap = 1e-9 / 0.5e-3;  // what a gap of the tolerance changes the strain by
  EXPECT_GT(force, 1);
  EXPECT_NEAR(quantity(*model, "support_z-_z"), force, 2 * of_gap * force);
  EXPECT_LE(std::abs(quantity(*model, "gap_z-")), 1e-9);
  const Step lifted = model->advance(1.0);
  ASSERT_TRUE(lifted.ok()) << lifted.failure;
  EXPECT_LE(lifted.newton, 12);
  model->accept();
  EXPECT_EQ(quantity(*model, "support_z-_z"), 0);
  EXPECT_NEAR(quantity(*model, "gap_z-"), 0.5e-3, 1e-9);
  EXPECT_NEAR(quantity(*model, "reaction_z+_z"), 0, newton_accuracy * force);
}

TEST(Wall, CarriesTheLoadAndTellsHowDeepTheBodySinksIn) {
  const auto model = make_block(
      "[muscle]\ninertia = \"quasi-static\"\n[boundary.\"x-\"]\ndisplacement.x = \"0 "
      "mm\"\n[boundary.\"y-\"]\ndisplacement.y "
      "= \"0 mm\"\n[boundary.\"z-\"]\nwall = { point = \"0, 0, 0 mm\", normal = [0, 0, 2], penalty = \"1 "
      "GPa/m\" }\n[boundary.\"z+\"]\ntraction = \"0, 0, -5 kPa\"\n" +
      tight + soft_material);
  const Step step = model->advance(1.0);
  ASSERT_TRUE(step.ok()) << step.failure;
  EXPECT_LE(step.newton, 8);
  model->accept();
  const double load = 5e3 * 3e-4;
  EXPECT_NEAR(quantity(*model, "support_z-_z"), load, newton_accuracy * load);
  EXPECT_NEAR(quantity(*model, "gap_z-"), -5e3 / 1e9, 1e-3 * 5e-6);
  EXPECT_NEAR(quantity(*model, "energy_support_z-"), 0.5 * load * 5e-6, 1e-2 * load * 5e-6);
}

TEST(Wall, ThatIsNotTouchedDoesNothing) {
  const std::string text =
      "[muscle]\ninertia = \"quasi-static\"\n[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ntraction = "
      "\"1, 0, 0 kPa\"\n" +
      tight + soft_material;
  const auto free = make_block(text),
             walled = make_block(text +
                                 "[boundary.\"z-\"]\nwall = { point = \"0, 0, -5 mm\", normal = [0, 0, 1], penalty "
                                 "= \"1 GPa/m\" }\n");
  for (Muscle* model : {free.get(), walled.get()}) {
    ASSERT_TRUE(model->advance(1).ok());
    model->accept();
  }
  EXPECT_EQ(quantity(*free, "energy_base"), quantity(*walled, "energy_base"));
  EXPECT_EQ(quantity(*walled, "support_z-_z"), 0);
  EXPECT_NEAR(quantity(*walled, "gap_z-"), 5e-3, 1e-4);
}

}  // namespace
}  // namespace titin
