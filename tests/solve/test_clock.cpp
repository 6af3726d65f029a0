#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solve/clock.hpp"

namespace titin {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

Step solved(const Clock& clock, int newton = 4) {
  Step step;
  step.dt = clock.dt();
  step.newton = newton;
  return step;
}

/// Steps to the end, all of which succeed.
std::vector<double> steps_to_end(Clock& clock, double largest_dt = no_limit, int newton = 4) {
  std::vector<double> steps;
  while (!clock.done() && steps.size() < 100000) {
    steps.push_back(clock.dt());
    clock.accept(solved(clock, newton), largest_dt);
  }
  return steps;
}

TEST(Clock, TakesEqualStepsWithoutRoundOff) {
  for (const double step : {0.025, 0.1 / 3, 0.5 / 7, 1e-4, 0.5}) {
    Clock clock({.end = 0.5, .step = step});
    const auto steps = steps_to_end(clock);
    EXPECT_EQ(steps.size(), static_cast<std::size_t>(std::lround(0.5 / step)));
    for (const double dt : steps) EXPECT_EQ(dt, step);  // the very same number: nothing is rebuilt for a new step
    EXPECT_EQ(clock.time(), 0.5);
    EXPECT_EQ(clock.fraction(), 1);
  }
}

TEST(Clock, KeepsTimeOnTheGridOfItsSteps) {
  Clock clock({.end = 1, .step = 1e-5});
  for (int i = 0; i < 70000; ++i) clock.accept(solved(clock), no_limit);
  EXPECT_DOUBLE_EQ(clock.time(), 0.7);
}

TEST(Clock, ShortensTheLastStepOnly) {
  Clock clock({.end = 0.1, .step = 0.03});
  const auto steps = steps_to_end(clock);
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_NEAR(steps.back(), 0.01, 1e-15);
  EXPECT_EQ(clock.time(), 0.1);
}

TEST(Clock, TakesOneStepWhenTheStepIsLongerThanTheRun) {
  Clock clock({.end = 0.1, .step = 3});
  EXPECT_EQ(steps_to_end(clock), std::vector<double>{0.1});
}

TEST(Clock, StretchesTheLastStepRatherThanLeaveASliver) {
  Clock clock({.end = 1, .step = 0.333333333});
  EXPECT_EQ(steps_to_end(clock).size(), 3u);
  EXPECT_EQ(clock.time(), 1);
}

TEST(Clock, CutsInHalfAndGrowsBackAfterThreeEasySteps) {
  Clock clock({.end = 10, .step = 1, .max_cuts = 3});
  EXPECT_TRUE(clock.cut({}));
  EXPECT_TRUE(clock.cut({}));
  EXPECT_EQ(clock.dt(), 0.25);
  EXPECT_EQ(steps_to_end(clock), (std::vector<double>{0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 1, 1, 1, 1, 1, 1, 1, 0.75}));
  EXPECT_EQ(clock.cuts(), 2);
  EXPECT_EQ(clock.time(), 10);
}

TEST(Clock, DoesNotGrowOnHardSteps) {
  Clock clock({.end = 10, .step = 1});
  clock.cut({});
  EXPECT_EQ(steps_to_end(clock, no_limit, 9), std::vector<double>(20, 0.5));
}

TEST(Clock, GivesUpAfterMaxCutsInARow) {
  Clock clock({.end = 10, .step = 1, .max_cuts = 2});
  EXPECT_TRUE(clock.cut({}));
  EXPECT_TRUE(clock.cut({}));
  EXPECT_FALSE(clock.cut({}));
  EXPECT_EQ(clock.dt(), 0.25);
  clock.accept(solved(clock), no_limit);
  EXPECT_TRUE(clock.cut({})) << "an accepted step starts the count anew";
}

TEST(Clock, EndsWhenEveryOtherStepFails) {
  Clock clock({.end = 10, .step = 1, .max_cuts = 8});
  int tries = 0;
  while (clock.cut({}) && ++tries < 1000) clock.accept(solved(clock), no_limit);
  EXPECT_LT(tries, 100);
}

TEST(Clock, KeepsToTheLargestStepOfTheFormulation) {
  Clock clock({.end = 1, .step = 1});
  clock.accept(solved(clock), 0.1);
  EXPECT_EQ(clock.time(), 1);  // the limit holds for the next step
  Clock limited({.end = 1, .step = 0.5});
  limited.accept(solved(limited), 0.2);
  EXPECT_EQ(limited.dt(), 0.2);
  limited.accept(solved(limited), 0.05);
  EXPECT_EQ(steps_to_end(limited, 0.05).size(), 6u);
  EXPECT_EQ(limited.time(), 1);
}

}  // namespace
}  // namespace titin
