// A rod is stretched to 1.1 of its length and held: which time schemes, and which of the two velocities, show waves
// that the load cannot have made (Almonacid's thesis, chapter 4)? Picture: scripts/plot_rod.py.
//
// On a linear chain, u_tt = c^2 u_xx with linear cells, the trapezoidal rule has v_n+1 = 2 du/dt - v_n: the velocity of
// Rothe's form, du/dt, is the mean of the scheme's own (lines) at both ends of a step, in which a wave of frequency w
// is smaller by cos(w dt / 2). So it rings less. Backward Euler's v is du/dt, and the forms differ at the moving end
// only.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../fe/blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double ramp = 0.02, end = 0.1, dt = 1e-3;  // [s]; a wave takes 7 ms from end to end
constexpr double pulled_rate = 0.1 / ramp;           // [1/s] of the whole rod
constexpr double still_stretch = 1.1018;             // quasi-static, on fine meshes: the clamped ends cannot thin
const std::vector<std::string> points = {"near", "middle", "far"};

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
displacement = { x = { time = "0, 20 ms", value = "0, 10 mm" }, y = "0 mm", z = "0 mm" }
[averages]
near = { lower = "20, 0, 0 mm", upper = "25, 10, 10 mm" }
middle = { lower = "45, 0, 0 mm", upper = "50, 10, 10 mm" }
far = { lower = "70, 0, 0 mm", upper = "75, 10, 10 mm" }
)";

struct Point {
  double variation = 0;  ///< total variation of the strain rate after the ramp, over the rate of the whole rod in it
  double late = 0;       ///< largest strain rate in the last quarter, over the same
  double stretch = 0;    ///< at the end
};

std::map<std::string, Point> pull(const std::string& scheme, const std::string& velocity) {
  const auto model = make_block("[time]\nscheme = \"" + scheme + "\"\nvelocity = \"" + velocity + "\"\n" + rod, false,
                                {"mesh.box=\"100, 10, 10 mm\"", "mesh.cells=[20, 1, 1]"});
  std::map<std::string, Point> result;
  std::map<std::string, double> before;
  for (int n = 1; n <= std::lround(end / dt); ++n) {
    const Step step = model->advance(dt);
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) return result;
    EXPECT_LE(step.newton, 6);
    model->accept();
    for (const std::string& point : points) {
      const double rate = quantity(*model, "mean_fibre_rate_" + point) / pulled_rate;
      if (model->time() > ramp + 0.5 * dt) result[point].variation += std::abs(rate - before[point]);
      if (model->time() > 0.75 * end) result[point].late = std::max(result[point].late, std::abs(rate));
      before[point] = rate;
    }
  }
  for (const std::string& point : points) {
    result[point].stretch = quantity(*model, "mean_stretch_" + point);
    fmt::print("{}, {}, {}: total variation {:.2f}, late rate {:.1e}, stretch {:.4f}\n", scheme, velocity, point,
               result[point].variation, result[point].late, result[point].stretch);
  }
  return result;
}

TEST(Rod, IsCalmAfterItsStretchWithBackwardEuler) {
  auto rothe = pull("backward_euler", "rothe"), lines = pull("backward_euler", "lines");
  for (const std::string& point : points) {
    EXPECT_LT(rothe[point].variation, 8) << "the waves of the start and the stop, and their echoes until they are gone";
    EXPECT_LT(rothe[point].late, 0.02);
    EXPECT_NEAR(rothe[point].stretch, still_stretch, 1e-3);
    EXPECT_NEAR(lines[point].variation, rothe[point].variation, 0.05 * rothe[point].variation);
  }
}

class Undamped : public testing::TestWithParam<const char*> {};

TEST_P(Undamped, RingsAndLessSoInTheVelocityOfDisplacements) {
  auto rothe = pull(GetParam(), "rothe"), lines = pull(GetParam(), "lines");
  for (const std::string& point : points) {
    EXPECT_GT(rothe[point].variation, 30);
    EXPECT_GT(rothe[point].late, 0.5);
    EXPECT_LT(rothe[point].variation, lines[point].variation);
  }
}

INSTANTIATE_TEST_SUITE_P(Rod, Undamped, testing::Values("newmark", "hht_alpha"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace titin
