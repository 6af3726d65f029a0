// Where the muscle formulation could fail: each ends right, or stops and says why.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "solve/clock.hpp"

namespace titin {
namespace {

using namespace test;

/// The run loop without its files: steps, cuts, and why it ended.
struct Outcome {
  bool finished = false;
  int steps = 0, cuts = 0, newton = 0;
  std::string failure;
};

Outcome run(Model& model, const ClockConfig& config) {
  Clock clock(config);
  clock.land_on(model.kinks());
  Outcome outcome;
  while (!clock.done()) {
    const Step step = model.advance(clock.dt());
    outcome.newton += step.newton;
    if (!step.ok()) {
      model.rewind();
      outcome.failure = step.failure;
      if (!clock.cut(step)) break;
      continue;
    }
    if (clock.reject(step)) {
      model.rewind();
      continue;
    }
    model.accept();
    clock.accept(step, model.largest_dt());
  }
  outcome.finished = clock.done(), outcome.steps = clock.steps(), outcome.cuts = clock.cuts();
  fmt::print("{}: {} steps, {} cuts, {} Newton iterations{}{}\n", outcome.finished ? "finished" : "stopped",
             outcome.steps, outcome.cuts, outcome.newton,
             outcome.failure.empty() ? "" : "; last failure: ", outcome.failure);
  return outcome;
}

/// A muscle with fibres along x; `stretch` of its length (30 mm) and `activation` against time in s.
std::string limb(const std::string& stretch, const std::string& activation, const std::string& inertia) {
  return "[muscle]\norder = 1\ninertia = \"" + inertia + R"("
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "1 MPa" }
[materials.muscle.terms]
base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
passive = { law = "hill_passive", peak_stress = "200 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
activation = )" +
         activation + "\n[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement = { x = " + stretch +
         ", y = \"0 mm\", z = \"0 mm\" }\n";
}

const std::string first_half = "time = \"0, 0.2 s\"", second_half = "time = \"0, 0.2, 0.4 s\"";
std::string early(const std::string& value) { return "{ " + first_half + ", value = " + value + " }"; }
std::string late(const std::string& value) { return "{ " + second_half + ", value = " + value + " }"; }

TEST(DescendingLimb, EndsAlikeWhicheverComesFirstWhenNothingRemembers) {
  const auto stretched_first = make_block(limb(early("\"0, 9 mm\""), late("[0, 0, 1]"), "quasi-static"));
  const auto active_first = make_block(limb(late("\"0, 0, 9 mm\""), early("[0, 1]"), "quasi-static"));
  ASSERT_TRUE(run(*stretched_first, {.end = 0.4, .step = 0.02}).finished);
  ASSERT_TRUE(run(*active_first, {.end = 0.4, .step = 0.02}).finished);
  const double a = quantity(*stretched_first, "reaction_x+_x"), b = quantity(*active_first, "reaction_x+_x");
  fmt::print("quasi-static, at 1.3 of its length: stretch then activation {:.4f} N, activation then stretch {:.4f} N\n",
             a, b);
  EXPECT_NEAR(a, b, 1e-4 * a);
}

TEST(DescendingLimb, PullsHarderWhileItIsStretchedActive) {
  const auto stretched_first = make_block(limb(early("\"0, 9 mm\""), late("[0, 0, 1]"), "dynamic"));
  const auto active_first = make_block(limb(late("\"0, 0, 9 mm\""), early("[0, 1]"), "dynamic"));
  ASSERT_TRUE(run(*stretched_first, {.end = 0.4, .step = 0.02}).finished);
  ASSERT_TRUE(run(*active_first, {.end = 0.4, .step = 0.02}).finished);
  const double a = quantity(*stretched_first, "reaction_x+_x"), b = quantity(*active_first, "reaction_x+_x");
  fmt::print("dynamic: stretch then activation {:.3f} N, activation then stretch {:.3f} N\n", a, b);
  EXPECT_GT(b, 1.05 * a) << "lengthening fibres carry more";
}

TEST(LargeSteps, OfAHundredTimesTheUsualEndWhereSmallOnesEnd) {
  const std::string text = limb("{ time = \"0, 1 s\", value = \"0, 6 mm\" }", "0.5", "quasi-static");
  const auto small = make_block(text), large = make_block(text);
  ASSERT_TRUE(run(*small, {.end = 1, .step = 0.05}).finished);
  ASSERT_TRUE(run(*large, {.end = 1, .step = 5}).finished);
  const double a = quantity(*small, "reaction_x+_x");
  EXPECT_NEAR(quantity(*large, "reaction_x+_x"), a, 1e-4 * a);
}

TEST(NearlyIncompressible, BodiesOfAMillionTimesTheShearModulusKeepTheirVolume) {
  const auto model = make_block(R"(
[muscle]
inertia = "quasi-static"
[materials.gel]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "10 GPa" }
terms.base = { law = "neo_hookean", mu = "10 kPa" }
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = { x = { time = "0, 1 s", value = "0, -6 mm" }, y = "0 mm", z = "0 mm" }
)");
  const double volume = quantity(*model, "volume");
  const Outcome outcome = run(*model, {.end = 1, .step = 0.1});
  ASSERT_TRUE(outcome.finished);
  EXPECT_NEAR(quantity(*model, "volume") / volume, 1, 1e-5);
  EXPECT_LE(outcome.newton, 10 * 10);
}

TEST(Inverted, BoundaryThatIsInsideOutFromTheStartStopsWithTheReason) {
  const auto model = make_block(soft_material + R"(
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = { x = "-60 mm", y = "0 mm", z = "0 mm" }
)");
  const Outcome outcome = run(*model, {.end = 1, .step = 0.1});
  EXPECT_FALSE(outcome.finished);
  EXPECT_EQ(outcome.steps, 0);
  EXPECT_EQ(outcome.cuts, 8);
  EXPECT_NE(outcome.failure.find("inside out"), std::string::npos) << outcome.failure;
}

TEST(Inverted, BodyHasNoForcesAndSaysWhere) {
  const auto model = make_block(soft_material);
  const mfem::Vector u = interpolate(model->system().space(), [](const mfem::Vector& x, mfem::Vector& u) {
    u = 0.0;
    u(0) = -2 * x(0);  // its mirror image
  });
  mfem::Vector R(u.Size());
  EXPECT_FALSE(model->system().residual(u, R));
  EXPECT_NE(model->system().domain_error().find("inside out"), std::string::npos);
}

}  // namespace
}  // namespace titin
