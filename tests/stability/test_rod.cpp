// A rod is stretched to 1.1 of its length and held: which time schemes, and which of the two velocities, show waves
// that the load cannot have made (Almonacid's thesis, chapter 4)? Figure: scripts/plot_rod.py.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double ramp = 0.01, end = 0.03, dt = 0.5e-3;  // [s]; a wave takes 2 ms from end to end

const std::string rod = R"(
[muscle]
order = 1
fibre_rate = "velocity_gradient"
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "1 MPa" }
terms.base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
terms.passive = { law = "hill_passive", peak_stress = "200 kPa" }
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = { x = { time = "0, 10 ms", value = "0, 3 mm" }, y = "0 mm", z = "0 mm" }
)";

struct Rates {
  double variation = 0;  ///< total variation of the strain rate after the ramp, over the rate during it
  double stretch = 0;    ///< at the end
};

Rates pull(const std::string& scheme, const std::string& velocity) {
  const auto model = make_block("[time]\nscheme = \"" + scheme + "\"\nvelocity = \"" + velocity + "\"\n" + rod);
  Rates rates;
  double before = 0;
  for (int n = 1; n <= std::lround(end / dt); ++n) {
    const Step step = model->advance(dt);
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) return rates;
    model->accept();
    const double rate = quantity(*model, "mean_fibre_rate_muscle");
    if (model->time() > ramp * 1.01) rates.variation += std::abs(rate - before);
    before = rate;
  }
  rates.variation /= 0.1 / ramp;
  rates.stretch = quantity(*model, "mean_stretch_muscle");
  fmt::print("{}, {}: total variation of the strain rate {:.3f}, stretch {:.4f}\n", scheme, velocity, rates.variation,
             rates.stretch);
  return rates;
}

TEST(Rod, IsCalmAfterItsStretchWithBackwardEulerOnly) {
  const double calm = pull("backward_euler", "rothe").variation;
  EXPECT_NEAR(pull("backward_euler", "lines").variation, calm, 1e-6 * calm) << "steps end on the kinks: no difference";
  EXPECT_LT(calm, 1);
  for (const char* scheme : {"newmark", "hht_alpha"})
    for (const char* velocity : {"rothe", "lines"}) EXPECT_GT(pull(scheme, velocity).variation, 2 * calm) << scheme;
}

TEST(Rod, RingsLessInTheVelocityOfDisplacements) {
  EXPECT_LT(pull("newmark", "rothe").variation, pull("newmark", "lines").variation);
}

}  // namespace
}  // namespace titin
