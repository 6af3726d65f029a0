#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/lanes.hpp"

namespace titin {
namespace {

// A few roundings of the last refinement.
constexpr double round_off = 1e-15;

TEST(Lanes, InverseCubeRootIsExactToRoundOffOverTwelveDecades) {
  for (double x = 1e-6; x < 1e6; x *= 1.01) {
    EXPECT_NEAR(inverse_cbrt(x) * std::cbrt(x), 1, round_off) << x;
    EXPECT_EQ(inverse_cbrt(Lanes(x))[0], inverse_cbrt(x)) << x;
  }
}

TEST(Lanes, InverseCubeRootOfWhatIsNotPositiveIsNaN) {
  EXPECT_TRUE(std::isnan(inverse_cbrt(0.0)));
  EXPECT_TRUE(std::isnan(inverse_cbrt(-1.0)));
  EXPECT_TRUE(std::isnan(inverse_cbrt(std::nan(""))));
}

TEST(Lanes, GatherFillsTheRestWithTheLastPoint) {
  const std::array<double, 2> points[3] = {{0, 10}, {1, 11}, {2, 12}};
  const Lanes x = gather(points, 1, 2, 3);
  for (int lane = 0; lane < lane_count; ++lane) EXPECT_EQ(x[lane], 12);
}

}  // namespace
}  // namespace titin
