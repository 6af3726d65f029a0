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

/// More components than lanes, and not a multiple of them; one point too few for the last lanes.
TEST(Lanes, ScatterIsGatherTurnedRound) {
  constexpr int size = 2 * lane_count + 1, n = 2 * lane_count - 1;
  std::array<std::array<double, size>, n + 1> points{}, back{};
  for (int p = 0; p < n; ++p)
    for (int c = 0; c < size; ++c) points[p][c] = 100 * p + c + 1;
  for (int first = 0; first < n; first += lane_count) {
    std::array<Lanes, size> x;
    for (int c = 0; c < size; ++c) x[c] = gather(points.data(), c, first, n);
    scatter(x, back.data(), first, n);
  }
  EXPECT_EQ(points, back);  // the last one was not touched
}

}  // namespace
}  // namespace titin
