// A rod is stretched to 1.1 of its length and held: what time schemes, and each of the two velocities, make of the
// strain rate at three points (Almonacid's thesis, chapter 4: kappa = 1 MPa, nu = 0.4, 1060 kg/m^3, steps of 1 ms). In
// one dimension Young's modulus stands for both, E = 3 kappa (1 - 2 nu) = 600 kPa.
//
// Without inertia the rate is that of the ramp and then nothing: its total variation is twice the ramp's rate. Waves
// add to it; those of the exact solution never end, as nothing takes their energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "rods.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double ramp = 0.02, end = 0.1, dt = 1e-3;
const std::vector<std::string> points = {"near", "middle", "far"};

const std::string stretched = linear_rod + R"(
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = { time = "0, 20 ms", value = "0, 10 mm" }
[markers]
near = "22.5 mm"
middle = "47.5 mm"
far = "72.5 mm"
)";

struct Pulled {
  double variation = 0;  ///< total variation of the rate over that of the rod without inertia, largest of three points
  double late = 0;       ///< largest rate in the last quarter over that of the ramp
  double stretch = 1.1;  ///< at the end, farthest from 1.1
};

Pulled pull(const std::string& scheme, const std::string& velocity) {
  const auto rod = make_rod(stretched, {"time.scheme=" + scheme, "time.velocity=" + velocity, "rod.cells=20"});
  Pulled worst;
  std::map<std::string, double> before, variation;
  for (int n = 1; n <= std::lround(end / dt); ++n) {
    const Step step = rod->advance(dt);
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) return worst;
    EXPECT_LE(step.newton, 4);
    rod->accept();
    for (const std::string& point : points) {
      const double rate = quantity(*rod, "marker_" + point + "_rate") / (0.1 / ramp);
      variation[point] += std::abs(rate - before[point]);
      before[point] = rate;
      if (rod->time() > 0.75 * end) worst.late = std::max(worst.late, std::abs(rate));
      worst.variation = std::max(worst.variation, variation[point] / 2);
    }
  }
  for (const std::string& point : points) {
    const double stretch = quantity(*rod, "marker_" + point + "_stretch");
    if (std::abs(stretch - 1.1) > std::abs(worst.stretch - 1.1)) worst.stretch = stretch;
  }
  fmt::print("{}, {}: total variation {:.2f}, late rate {:.1e}, stretch {:.4f}\n", scheme, velocity, worst.variation,
             worst.late, worst.stretch);
  return worst;
}

TEST(StretchedRod, IsCalmestWithTheFirstOrderScheme) {
  std::map<std::string, Pulled> lines, rothe;
  for (const char* scheme : {"backward_euler", "hht_alpha", "newmark"}) {
    lines[scheme] = pull(scheme, "lines");
    rothe[scheme] = pull(scheme, "rothe");
  }
  for (auto* form : {&lines, &rothe}) {
    EXPECT_LT(4 * (*form)["backward_euler"].variation, (*form)["hht_alpha"].variation);
    EXPECT_LT((*form)["hht_alpha"].variation, (*form)["newmark"].variation);
    EXPECT_LT((*form)["backward_euler"].late, 0.01);
    EXPECT_GT((*form)["newmark"].late, 0.5);
    EXPECT_NEAR((*form)["backward_euler"].stretch, 1.1, 1e-4);
  }
  for (const char* scheme : {"hht_alpha", "newmark"}) EXPECT_LT(rothe[scheme].variation, lines[scheme].variation);
}

}  // namespace
}  // namespace titin
