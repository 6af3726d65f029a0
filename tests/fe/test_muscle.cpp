// The muscle formulation against exact answers: patch test, rigid motion, free fall, pressure, uniaxial load, work.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double round_off = 1e-11;       // relative: sums of some thousand products in double precision
constexpr double newton_accuracy = 1e-7;  // relative: what solver.tolerance = 1e-10 leaves after a quadratic last step

const std::string tight = "[solver]\ntolerance = 1e-10\n";

double norm_of(const mfem::Vector& v) { return std::sqrt(sum(v * v)); }

TEST(PatchTest, AffineDisplacementLeavesInnerForcesZeroOnBentCells) {
  for (int order : {1, 2, 3}) {
    const auto model = make_block(
        "[muscle]\ninertia = \"quasi-static\"\norder = " + std::to_string(order) + "\n" + muscle_material, true);
    auto& space = model->system().space();
    const mfem::Vector u = interpolate(space, [](const mfem::Vector& x, mfem::Vector& u) {
      u(0) = 0.1 * x(0) + 0.05 * x(1);
      u(1) = -0.05 * x(1) + 0.02 * x(2);
      u(2) = 0.03 * x(0) - 0.045 * x(2);
    });
    mfem::Vector R(u.Size());
    ASSERT_TRUE(model->system().residual(u, R));
    mfem::Array<int> surface, all(model->mesh().bdr_attributes.Max());
    all = 1;
    space.GetEssentialTrueDofs(all, surface);
    const double largest = norm_of(R);
    for (int dof : surface) R(dof) = 0;
    EXPECT_GT(largest, 1e-3);
    fmt::print("patch test, order {}: inner forces {:.1e} of the surface's\n", order, norm_of(R) / largest);
    EXPECT_LT(norm_of(R), round_off * largest) << "order " << order;
  }
}

TEST(RigidMotion, RotationLeavesNoStress) {
  const auto model = make_block(muscle_material, true);
  const double c = std::cos(1.1), s = std::sin(1.1);
  const mfem::Vector u = interpolate(model->system().space(), [&](const mfem::Vector& x, mfem::Vector& u) {
    u(0) = (c - 1) * x(0) - s * x(1) + 0.01;
    u(1) = s * x(0) + (c - 1) * x(1) - 0.02;
    u(2) = 0.0;
  });
  mfem::Vector R(u.Size());
  ASSERT_TRUE(model->system().residual(u, R));
  const double typical_force = 1e7 * 1e-4;  // bulk modulus x a face of the block [N]
  fmt::print("rotation: forces {:.1e} of bulk modulus x face\n", norm_of(R) / typical_force);
  EXPECT_LT(norm_of(R), round_off * typical_force);
}

TEST(FreeFall, FollowsTheSchemeExactly) {
  const auto model = make_block("[body]\nacceleration = \"0, 0, -9.81 m/s^2\"\n[markers]\np = \"7, 3, 2 mm\"\n" +
                                tight + soft_material);
  const double dt = 1e-3;
  const int steps = 5;
  for (const Step& step : march(*model, steps * dt, dt)) ASSERT_TRUE(step.ok()) << step.failure;
  const double fallen = -9.81 * dt * dt * steps * (steps + 1) / 2;  // backward Euler's own parabola
  EXPECT_NEAR(quantity(*model, "marker_p_uz"), fallen, newton_accuracy * std::abs(fallen));
  const double mass = 1000 * 3e-6, speed = 9.81 * dt * steps;
  EXPECT_NEAR(quantity(*model, "energy_kinetic"), 0.5 * mass * speed * speed, newton_accuracy * mass * speed * speed);
  EXPECT_NEAR(quantity(*model, "work_body"), mass * -9.81 * fallen, newton_accuracy * mass * -9.81 * fallen);
}

const std::string symmetry_planes = R"(
[muscle]
inertia = "quasi-static"
[boundary."x-"]
displacement.x = "0 mm"
[boundary."y-"]
displacement.y = "0 mm"
[boundary."z-"]
displacement.z = "0 mm"
)";

TEST(Pressure, CompressesABlockByTheVolumetricLaw) {
  const auto model =
      make_block(symmetry_planes + "[boundary.outside]\non = [\"x+\", \"y+\", \"z+\"]\npressure = \"100 kPa\"\n" +
                 tight + soft_material);
  const Step step = model->advance(1.0);
  ASSERT_TRUE(step.ok()) << step.failure;
  model->accept();
  // kappa/2 (D - 1/D) = -p
  const double a = 100e3 / 500e3, D = -a + std::sqrt(a * a + 1);
  EXPECT_NEAR(quantity(*model, "volume"), 3e-6 * D, newton_accuracy * 3e-6);
  EXPECT_NEAR(quantity(*model, "energy_base"), 0, newton_accuracy * quantity(*model, "energy_volumetric"));
}

TEST(Traction, StretchesABlockByTheUniaxialSolution) {
  const auto model = make_block(symmetry_planes +
                                "[boundary.\"x+\"]\ntraction = \"60, 0, 0 kPa\"\n[markers]\nend = \"30, 10, 10 mm\"\n" +
                                tight + soft_material);
  const Step step = model->advance(1.0);
  ASSERT_TRUE(step.ok()) << step.failure;
  model->accept();
  const double l = 1 + quantity(*model, "marker_end_ux") / 0.03, m = 1 + quantity(*model, "marker_end_uy") / 0.01;
  EXPECT_NEAR(m, 1 + quantity(*model, "marker_end_uz") / 0.01, newton_accuracy);
  // W = mu/2 (J^-2/3 (l^2 + 2 m^2) - 3) + kappa/4 (J^2 - 1 - 2 ln J), J = l m^2: dW/dl = traction, dW/dm = 0
  const double mu = 100e3, kappa = 500e3, J = l * m * m, I1 = l * l + 2 * m * m, k = std::pow(J, -2.0 / 3);
  const double dU = kappa / 2 * (J - 1 / J);
  EXPECT_NEAR(mu * k * (l - I1 / (3 * l)) + dU * m * m, 60e3, newton_accuracy * kappa);
  EXPECT_NEAR(mu * k * (2 * m - 2 * I1 / (3 * m)) + dU * 2 * l * m, 0, newton_accuracy * kappa);
  EXPECT_GT(l, 1.1);
}

TEST(Work, OfTheBoundaryIsWhatTheBodyTakesUp) {
  const std::string text =
      muscle_material + tight +
      "[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 0.05, 0.1 s\", "
      "value = \"0, 2, 1 mm\" }\ndisplacement.y = \"0 mm\"\ndisplacement.z = \"0 mm\"\n";
  const auto model = make_block(text);
  double last_error = 0;
  for (int n = 0; n < 10; ++n) {
    ASSERT_TRUE(model->advance(0.01).ok());
    model->accept();
    const double error = quantity(*model, "energy_balance_error");
    EXPECT_GE(error, last_error - round_off) << "backward Euler only dissipates";
    last_error = error;
  }
  const double x = quantity(*model, "reaction_x+_x"), y = quantity(*model, "reaction_x-_x");
  EXPECT_LT(std::abs(x + y), 0.02 * std::abs(x)) << "reactions balance but for inertia";
  EXPECT_GT(last_error, 0);
}

TEST(Viscosity, RelaxesAHeldBlockByItsSeriesAndKeepsItsBooks) {
  const std::string text = symmetry_planes + R"(
[boundary."x+"]
displacement.x = { time = "0, 0.1, 100 s", value = "0, 3, 3 mm" }
[materials.soft]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "500 kPa" }
[materials.soft.terms]
base = { law = "neo_hookean", mu = "100 kPa", prony = { strength = [0.5, 0.25], time = "0.2, 1 s" } }
)" + tight;
  const auto model = make_block(text);
  const double dt = 0.05;
  double peak = 0, last = 0;
  for (int n = 1; n <= 300; ++n) {
    if (n % 50 == 0) model->advance(3 * dt), model->rewind();  // a forgotten step must leave no trace
    const Step step = model->advance(dt);
    ASSERT_TRUE(step.ok()) << step.failure;
    EXPECT_LE(step.newton, 5);
    model->accept();
    peak = std::max(peak, quantity(*model, "reaction_x+_x"));
    EXPECT_GE(quantity(*model, "dissipation_base"), last - round_off);
    last = quantity(*model, "dissipation_base");
  }
  const auto elastic =
      make_block(symmetry_planes + soft_material + tight + "[boundary.\"x+\"]\ndisplacement.x = \"3 mm\"\n");
  ASSERT_TRUE(elastic->advance(1).ok());
  elastic->accept();
  const double long_term = quantity(*elastic, "reaction_x+_x");
  EXPECT_NEAR(quantity(*model, "reaction_x+_x"), long_term, 1e-5 * long_term) << "15 s are 15 longest relaxation times";
  EXPECT_GT(peak, 1.4 * long_term);
  const double work = quantity(*model, "work_boundary");
  EXPECT_GT(last, 0.01 * work);
  const auto unbalanced = [&](double step) {
    const auto loaded = make_block(text);
    march(*loaded, 0.1, step);
    return quantity(*loaded, "energy_balance_error");
  };
  EXPECT_NEAR(unbalanced(0.005) / unbalanced(0.0025), 2.0, 0.1) << "first order, as the end-point rule of work is";
}

TEST(Newton, IsQuadraticAndNeedsFewIterations) {
  const std::string text = muscle_material +
                           "[solver]\ntolerance = 1e-12\nlinear_tolerance = 1e-12\n[boundary.\"x-\"]\nclamp = "
                           "true\n[boundary.\"x+\"]\nclamp = true\n";
  const auto model = make_block(text);
  const auto steps = march(*model, 0.1, 0.01);
  constexpr double quadratic = 1.8, asymptotic = 1e-2, measurable = 1e-11;
  int measured = 0;
  double lowest = 1e9;
  for (const Step& step : steps) {
    ASSERT_TRUE(step.ok()) << step.failure;
    EXPECT_LE(step.newton, 8);
    for (std::size_t k = 2; k < step.residuals.size(); ++k) {
      const double r0 = step.residuals[k - 2], r1 = step.residuals[k - 1], r2 = step.residuals[k];
      if (r1 > asymptotic || r2 < measurable) continue;
      lowest = std::min(lowest, std::log(r2 / r1) / std::log(r1 / r0));
      ++measured;
    }
  }
  fmt::print("Newton: lowest order {:.2f} of {} measured\n", lowest, measured);
  EXPECT_GT(measured, 0);
  EXPECT_GT(lowest, quadratic);
}

TEST(Newton, WithTheSymmetricTangentOfTheVelocityGradientFindsTheSameForceInMoreIterations) {
  const auto total = [](const std::string& rate) {
    const auto model = make_block("[muscle]\nfibre_rate = \"" + rate + "\"\n" + muscle_material +
                                  "[solver]\ntolerance = 1e-10\nlinear_tolerance = 1e-10\n[boundary.\"x-\"]\nclamp = "
                                  "true\n[boundary.\"x+\"]\nclamp = true\n");
    int iterations = 0;
    for (const Step& step : march(*model, 0.1, 0.01)) iterations += step.newton;
    return std::pair(iterations, quantity(*model, "reaction_x+_x"));
  };
  const auto [exact, force] = total("velocity_gradient");
  const auto [symmetric, same_force] = total("velocity_gradient_symmetric");
  fmt::print("Newton iterations: {} exact, {} symmetric\n", exact, symmetric);
  EXPECT_GT(symmetric, exact);
  EXPECT_NEAR(same_force, force, newton_accuracy * std::abs(force));
}

TEST(Failure, IsAValueAndLeavesTheStateAsItWas) {
  const std::string text = soft_material +
                           "[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 1 s\", "
                           "value = \"0, -40 mm\" }\ndisplacement.y = \"0 mm\"\ndisplacement.z = \"0 mm\"\n";
  const auto model = make_block(text);
  const Step impossible = model->advance(1.0);
  EXPECT_FALSE(impossible.ok());
  EXPECT_NE(impossible.failure.find("inside out"), std::string::npos) << impossible.failure;
  model->rewind();
  EXPECT_EQ(model->time(), 0);
  const Step small = model->advance(0.02);
  EXPECT_TRUE(small.ok()) << small.failure;
}

}  // namespace
}  // namespace titin
