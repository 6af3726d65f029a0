// What steps of the other formulation come to, against steps that it takes.
#include "scene/explicit_or_implicit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene.hpp"

namespace titin {
namespace {

/// A block that is pushed in the plane, or in space.
std::string scene(const std::string& box, const std::string& cells) {
  return "model = \"lagrange\"\n[mesh]\nkind = \"simplices\"\nbox = \"" + box + "\"\ncells = " + cells + R"(
[time]
end = "20 ms"
[materials.gel]
density = "1000 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "200 kPa"}
terms.matrix = {law = "neo_hookean", mu = "100 kPa"}
[boundary."x-"]
wall = true
)";
}

TEST(ExplicitOrImplicit, ExplicitStepsAreAsManyAsARunTakes) {
  for (const auto& [box, cells] : {std::pair("20, 10 mm", "[16, 8]"), std::pair("20, 10, 10 mm", "[4, 2, 2]")}) {
    const Scene read = Scene::of_text(scene(box, cells), "block.toml", {});
    const SceneFacts facts(read.settings);
    const double steps = explicit_steps(facts, {.mesh = MeshChoice::of(facts)}, read.clock.end);
    Clock clock(read.clock, read.model->largest_dt());  // steps grow from a tenth of what is stable
    while (clock.steps() < 30) {
      const Step step = read.model->advance(clock.dt());
      read.model->accept();
      clock.accept(step, read.model->largest_dt());
    }
    EXPECT_NEAR(steps, read.clock.end / clock.dt(), 0.05 * steps) << box;
  }
}

TEST(ExplicitOrImplicit, AFluidHasNoImplicitSteps) {
  Probe probe;
  probe.times = probe.values = {0, 1};
  probe.largest = probe.steps = 1;
  EXPECT_EQ(implicit_instead(SceneFacts({"materials.gas.fluid.law = \"perfect_gas\""}), probe, 100, 0.01), "");
  EXPECT_NE(implicit_instead(SceneFacts({"materials.gel.density = \"1 kg/m^3\""}), probe, 100, 0.01), "");
}

TEST(ExplicitOrImplicit, LinesFollowAParabola) {
  Probe probe;
  probe.largest = 1, probe.steps = 64;
  for (int k = 0; k <= 64; ++k) probe.times.push_back(k / 64.), probe.values.push_back(std::pow(k / 64., 2));
  EXPECT_EQ(lines_that_follow(probe, 0.26), 1);  // they miss it by 1/4, 1/16, 1/64
  EXPECT_EQ(lines_that_follow(probe, 0.07), 2);
  EXPECT_EQ(lines_that_follow(probe, 0.02), 4);
}

}  // namespace
}  // namespace titin
