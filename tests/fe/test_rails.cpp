// Plates on rails with forces and loads, and links between boundaries.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "blocks.hpp"
#include "materials/hill_curves.hpp"

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
/// Held at one end; the other keeps its shape, and its fibres are oblique: nothing about it is uniform.
const std::string held_muscle = R"(
[boundary."x-"]
clamp = true
[boundary."x+".displacement]
y = "0 mm"
z = "0 mm"
)";

/// Largest difference between the displacements along x of the plate at x+. Collective.
double spread_of_plate(Muscle& model) {
  const mfem::Array<int>& dofs = model.system().constraints().rails().list().at(0).dofs;
  double low = 1e300, high = -1e300;
  for (int dof : dofs) {
    low = std::min(low, model.displacement()(dof));
    high = std::max(high, model.displacement()(dof));
  }
  return max(high) - min(low);
}

struct Travel {
  std::vector<double> at;  // the ends of steps [m]
  int newton = 0;
};

/// The travel of a plate under a force that grows to 4 N, and back; whatever the linear solver.
Travel travel_under_force(const std::string& method, const std::string& time, const std::string& mass, int steps,
                          double dt) {
  const auto model = make_block(time + "[boundary.\"x+\".rail]\nalong = \"x\"\nmass = \"" + mass +
                                "\"\nforce = { time = \"0, 30, 60 ms\", value = \"0, 4, 1 N\" }\n" + held_muscle +
                                tight + "linear = \"" + method + "\"\nlinear_tolerance = 1e-6\n" + muscle_material);
  Travel travel;
  for (int n = 0; n < steps; ++n) {
    const Step step = model->advance(dt);
    EXPECT_TRUE(step.ok()) << method << ": " << step.failure;
    if (!step.ok()) break;
    model->accept();
    travel.newton += step.newton;
    travel.at.push_back(quantity(*model, "travel_x+"));
    EXPECT_EQ(spread_of_plate(*model), 0) << "all nodes move together, to the last digit";
  }
  return travel;
}

/// Moved as the force moved it, the plate needs the force: m a + reaction, at each step.
TEST(Rail, NeedsTheForceThatMovedIt) {
  constexpr int steps = 4;
  constexpr double dt = 0.015;
  for (const char* scheme : {"backward_euler", "newmark"}) {
    const std::string time = std::string("[time]\nscheme = \"") + scheme + "\"\nvelocity = \"rothe\"\n";
    const Travel travel = travel_under_force("direct", time, "0 kg", steps, dt);
    ASSERT_EQ(travel.at.size(), steps);
    EXPECT_GT(travel.at.front(), 1e-4);
    std::string times = "0", values = "0";
    for (int n = 0; n < steps; ++n) {
      times += fmt::format(", {:.17g}", (n + 1) * dt);
      values += fmt::format(", {:.17g}", travel.at[n]);
    }
    const auto moved = make_block(time + "[boundary.\"x+\".displacement]\nx = { time = \"" + times +
                                  " s\", value = \"" + values + " m\" }\ny = \"0 mm\"\nz = \"0 mm\"\n" +
                                  "[boundary.\"x-\"]\nclamp = true\n" + tight + muscle_material);
    const double force[] = {2, 4, 2.5, 1};
    for (int n = 0; n < steps; ++n) {
      ASSERT_TRUE(moved->advance(dt).ok());
      moved->accept();
      EXPECT_NEAR(quantity(*moved, "reaction_x+_x"), force[n], 20 * newton_accuracy * force[n])
          << scheme << ", step " << n + 1;
    }
  }
  const std::string time = "[time]\nscheme = \"backward_euler\"\n";
  const Travel heavy = travel_under_force("direct", time, "20 g", steps, dt);
  const Travel light = travel_under_force("direct", time, "0 kg", steps, dt);
  EXPECT_GT(std::abs(heavy.at[0] - light.at[0]), 0.01 * light.at[0]) << "inertia counts";
}

TEST(Rail, IsTheSameWithAllLinearSolvers) {
  const std::string time = "[time]\nscheme = \"backward_euler\"\n";
  const Travel direct = travel_under_force("direct", time, "20 g", 3, 0.01);
  fmt::print("plate on a rail: {} Newton iterations in 3 steps\n", direct.newton);
  EXPECT_LE(direct.newton, 18) << "its tangent is exact";
  for (const char* method : {"block", "condensed"}) {
    const Travel other = travel_under_force(method, time, "20 g", 3, 0.01);
    ASSERT_EQ(other.at.size(), direct.at.size());
    EXPECT_EQ(other.newton, direct.newton) << method;
    for (std::size_t n = 0; n < direct.at.size(); ++n)
      EXPECT_NEAR(other.at[n], direct.at[n], 1e-8 * std::abs(direct.at[n])) << method;
  }
}

const std::string stiff_material = R"(
[materials.stiff]
density = "1 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "500 MPa" }
[materials.stiff.terms]
base = { law = "neo_hookean", mu = "100 MPa" }
)";

/// A load on a rail, held by a spring to ground and driven from rest by a constant force: F / k (1 - cos omega t).
TEST(Rail, CarriesALoadThatOscillates) {
  const double k = 12, mass = 0.003 + 3e-6, force = 0.006, omega = std::sqrt(k / mass), end = 0.04;
  for (const auto& [scheme, order] : {std::pair{"backward_euler", 1.0},
                                      {"newmark", 2.0},
                                      {"hht_alpha", 2.0},
                                      {"generalised_alpha", 2.0},
                                      {"bdf2", 2.0},
                                      {"energy_momentum", 2.0}}) {
    const auto run = [&, scheme = scheme](int steps) {
      const auto model = make_block(std::string("[time]\nscheme = \"") + scheme + "\"\n" + sliding_sides +
                                    "[boundary.\"x+\"]\nspring = \"12, 0, 0 N/m\"\nrail = { along = \"x\", mass = "
                                    "\"3 g\", force = \"6 mN\" }\n" +
                                    tight + stiff_material);
      for (const Step& step : march(*model, end, end / steps)) {
        EXPECT_TRUE(step.ok()) << step.failure;
        EXPECT_LE(step.newton, 5);
      }
      if (order == 2)
        EXPECT_NEAR(quantity(*model, "energy_balance_error"), 0, 0.02 * quantity(*model, "work_force_x+")) << scheme;
      return std::abs(quantity(*model, "travel_x+") - force / k * (1 - std::cos(omega * end)));
    };
    const double coarse = run(20), fine = run(40);
    fmt::print("load on a spring, {}: error {:.2e} m, half the step {:.2e} m, order {:.2f}\n", scheme, coarse, fine,
               std::log2(coarse / fine));
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.25) << scheme;
  }
}

/// Kirchhoff stress along a bar, free at its sides, whose fibre has the isochoric stretch l and the rate r (over its
/// largest).
double hill_bar(double l, double r) {
  const double c1 = 40e3, c2 = 73e3, I1 = l * l + 2 / l, peak = 200e3;
  const double base = 2 * (c1 + 2 * c2 * (I1 - 3)) * (l * l - 1 / l);
  const auto curve = HillCurve::flexodeal;
  return base + peak * (hill::active_force(curve, l) * hill::force_velocity(curve, r) + hill::passive_force(curve, l));
}

/// An isotonic contraction follows the force-velocity curve: the fully active muscle, loaded by F, shortens at each
/// instant at the rate at which Hill's bar carries F.
TEST(Rail, LetsMuscleShortenAtTheRateOfItsForceVelocityCurve) {
  double last = 1e300;
  for (const double force : {2.0, 6.0, 12.0}) {
    const auto model = make_block(
        sliding_sides +
            "[boundary.\"x-\"]\ndisplacement.x = \"0 mm\"\n[boundary.\"x+\".rail]\nalong = \"x\"\nforce = \"" +
            fmt::format("{} N", force) + "\"\n[markers]\nend = \"30, 10, 10 mm\"\n" + tight + muscle_material,
        false,
        {"materials.muscle.fibre=[1, 0, 0]", "materials.muscle.terms.active.activation=1",
         "materials.muscle.density=\"1e-6 kg/m^3\""});
    const double dt = 1e-3;
    double l_old = 1, fastest = 0;
    for (int n = 0; n < 8; ++n) {
      const Step step = model->advance(dt);
      ASSERT_TRUE(step.ok()) << step.failure;
      model->accept();
      const double stretch = 1 + quantity(*model, "travel_x+") / 0.03;
      const double l = stretch * std::cbrt(3e-6 / quantity(*model, "volume"));
      const double rate = (l - l_old) / dt / 5;
      EXPECT_NEAR(hill_bar(l, rate) * 1e-4 / stretch, force, 1e-6 * force) << "step " << n;
      l_old = l;
      fastest = std::min(fastest, rate);
    }
    fmt::print("isotonic, {} N: shortens at {:.4f} of the largest rate at first\n", force, -fastest);
    EXPECT_LT(-fastest, last) << "the heavier, the slower";
    EXPECT_GT(-fastest, 0.01);
    last = -fastest;
  }
}

/// Work and energy of a muscle that throws a load: the balance closes at first order.
TEST(Rail, BalancesTheEnergyOfALoadThatIsThrown) {
  const auto run = [](int steps) {
    const auto model =
        make_block(held_muscle + "[boundary.\"x+\".rail]\nalong = \"x\"\nmass = \"1 kg\"\n" + tight + muscle_material);
    for (const Step& step : march(*model, 0.04, 0.04 / steps)) EXPECT_TRUE(step.ok()) << step.failure;
    EXPECT_GT(quantity(*model, "energy_load_x+"), 1e-5);
    return std::abs(quantity(*model, "energy_balance_error"));
  };
  const double coarse = run(16), fine = run(32);
  fmt::print("thrown load: energy balance {:.2e} J, half the step {:.2e} J, order {:.2f}\n", coarse, fine,
             std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.25);
}

/// A bar and a spring beside it, pulled together: the bar's own law and the spring's.
TEST(Link, CarriesItsShareOfAPull) {
  const double k = 300, mu = 100e3, kappa = 500e3;
  for (const bool plate : {false, true}) {
    const auto model = make_block(
        "[muscle]\ninertia = \"quasi-static\"\n" + sliding_sides +
        "[boundary.\"x-\"]\ndisplacement.x = \"0 mm\"\n[link.beside]\nbetween = [\"x-\", \"x+\"]\nspring = \"300, 0, 0 "
        "N/m\"\n[boundary.\"x+\"]\n" +
        (plate ? "rail = { along = \"x\", force = \"3 N\" }\n" : "traction = \"30, 0, 0 kPa\"\n") +
        "[markers]\nend = \"30, 10, 10 mm\"\n" + tight + soft_material);
    const Step step = model->advance(1.0);
    ASSERT_TRUE(step.ok()) << step.failure;
    EXPECT_LE(step.newton, 6);
    model->accept();
    const double u = quantity(*model, "marker_end_ux"), l = 1 + u / 0.03;
    const double m = 1 + quantity(*model, "marker_end_uy") / 0.01, J = l * m * m, I1 = l * l + 2 * m * m;
    const double dU = kappa / 2 * (J - 1 / J), P = mu * std::pow(J, -2.0 / 3) * (l - I1 / (3 * l)) + dU * m * m;
    EXPECT_GT(u, 1e-3);
    EXPECT_NEAR(P * 1e-4 + k * u, 3, 3 * newton_accuracy);
    EXPECT_NEAR(quantity(*model, "force_beside_x"), k * u, newton_accuracy);
    EXPECT_NEAR(quantity(*model, "elongation_beside_x"), u, 1e-12);
    EXPECT_NEAR(quantity(*model, "reaction_x-_x"), -3, 3 * newton_accuracy) << "what holds x- holds both";
  }
}

/// A soft bar between two loads that are pulled apart, and a damper beside it: with the bar's stiffness K the
/// elongation obeys m/2 e'' + c e' + K e = F.
TEST(Link, DampsWhatItsEndsDoAgainstEachOther) {
  const double mass = 0.01, c = 0.4, force = 1e-3, E = 300e3, K = E * 1e-4 / 0.03, end = 0.02;
  const double m = mass / 2, decay = c / (2 * m), omega = std::sqrt(K / m - decay * decay);
  const double exact =
      force / K * (1 - std::exp(-decay * end) * (std::cos(omega * end) + decay / omega * std::sin(omega * end)));
  const auto run = [&](int steps) {
    const auto model = make_block(
        "[time]\nscheme = \"newmark\"\n" + sliding_sides +
            "[boundary.\"x-\".rail]\nalong = \"x\"\nmass = \"10 g\"\nforce = \"-1 mN\"\n[boundary.\"x+\".rail]\nalong "
            "= "
            "\"x\"\nmass = \"10 g\"\nforce = \"1 mN\"\n[link.d]\nbetween = [\"x-\", \"x+\"]\ndamper = \"0.4, 0, 0 N "
            "s/m\"\n" +
            tight + stiff_material,
        false,
        {"materials.stiff.volumetric.bulk_modulus=\"1 GPa\"", "materials.stiff.terms.base.mu=\"100.0033 kPa\"",
         "materials.stiff.density=\"0.01 kg/m^3\""});
    for (const Step& step : march(*model, end, end / steps)) EXPECT_TRUE(step.ok()) << step.failure;
    EXPECT_NEAR(quantity(*model, "travel_x+"), -quantity(*model, "travel_x-"), 1e-12);
    EXPECT_GT(quantity(*model, "dissipation_link_d_x"), 0);
    return std::abs(quantity(*model, "elongation_d_x") - exact);
  };
  const double coarse = run(32), fine = run(64);
  fmt::print("damper between two loads: elongation {:.4e} m, error {:.2e} m, half the step {:.2e} m, order {:.2f}\n",
             exact, coarse, fine, std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25);
}

}  // namespace
}  // namespace titin
