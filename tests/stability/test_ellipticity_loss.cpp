// On the descending limb of the force-length curve longer fibres pull less. Where the base is too soft to make up for
// it, ellipticity is lost, bands form and Newton's method fails in the end; the watch says so before. A stiffer base
// keeps both.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../fe/blocks.hpp"

namespace titin {
namespace {

using namespace test;

/// Clamped, 30 mm long, pulled in 0.5 s and then activated until 1 s.
std::unique_ptr<Muscle> stretched_muscle(const std::string& base, const std::string& pull = "9 mm",
                                         double activation = 1) {
  return make_block(R"([muscle]
inertia = "quasi-static"
ellipticity = true
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
activation = { time = "0, 0.5, 1 s", value = [0, 0, )" +
                        std::to_string(activation) +
                        R"(] }
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement.x = { time = "0, 0.5 s", value = "0, )" +
                        pull +
                        R"(" }
displacement.y = "0 mm"
displacement.z = "0 mm"
[materials.muscle.terms.base]
law = "neo_hookean"
mu = ")" + base + "\"\n",
                    false, {"mesh.cells=[4, 1, 1]"});
}

struct Outcome {
  int steps = 0, watched = 0;  // since activation began; of these, with ellipticity lost
  std::string failure;
};

Outcome activate(Muscle& model, double dt) {
  Outcome outcome;
  for (const Step& step : march(model, 0.5, 0.05)) EXPECT_TRUE(step.ok()) << step.failure;
  EXPECT_EQ(quantity(model, "cells_not_elliptic"), 0) << "passive muscle is elliptic";
  while (model.time() < 1 - 0.5 * dt) {
    const Step step = model.advance(dt);
    outcome.failure = step.failure;
    if (!step.ok()) break;
    model.accept();
    outcome.steps += 1;
    if (quantity(model, "cells_not_elliptic") > 0) outcome.watched += 1;
  }
  fmt::print("{} steps, {} of them after ellipticity was lost; {}\n", outcome.steps, outcome.watched,
             outcome.failure.empty() ? "finished" : outcome.failure);
  return outcome;
}

TEST(Ellipticity, IsFoundLostBeforeNewtonFails) {
  const auto model = stretched_muscle("10 kPa");
  const Outcome outcome = activate(*model, 0.005);
  EXPECT_FALSE(outcome.failure.empty()) << "a soft base ends in bands";
  EXPECT_GE(outcome.watched, 3) << "the last steps before that knew";
  EXPECT_LT(quantity(*model, "legendre_hadamard"), 0);
}

// configs/bench/stretched_active.toml
TEST(Ellipticity, IsFoundLostBeforeNewtonFailsAtAnyStretch) {
  for (const char* pull : {"0 mm", "6 mm", "12 mm", "18 mm"}) {
    SCOPED_TRACE(pull);
    const Outcome calm = activate(*stretched_muscle("20 kPa", pull, 0.1), 0.05);
    EXPECT_EQ(calm.failure, "");
    EXPECT_EQ(calm.watched, 0);
    EXPECT_GE(activate(*stretched_muscle("20 kPa", pull, 1), 0.005).watched, 1);
  }
}

TEST(Ellipticity, IsKeptByAStifferBase) {
  const auto model = stretched_muscle("200 kPa");
  const Outcome outcome = activate(*model, 0.05);
  EXPECT_EQ(outcome.failure, "");
  EXPECT_EQ(outcome.steps, 10);
  EXPECT_EQ(outcome.watched, 0);
  EXPECT_GT(quantity(*model, "legendre_hadamard"), 0);
}

}  // namespace
}  // namespace titin
