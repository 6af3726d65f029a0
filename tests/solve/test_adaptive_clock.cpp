// Adaptive steps on an equation that is solved by hand, with the error it would report: u' = cos t + jumps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solve/clock.hpp"

namespace titin {
namespace {

constexpr double end = 10;

/// Explicit Euler for u' = g(t), whose step makes the error dt^2 g'(t) / 2 but for higher orders.
struct Euler {
  double u = 0;
  static double rate(double t) { return std::exp(-50 * (t - 5) * (t - 5)) + 0.1 * std::cos(t); }
  static double exact(double from, double to) {
    const double root = std::sqrt(50.0), half = std::sqrt(M_PI) / (2 * root);
    return half * (std::erf(root * (to - 5)) - std::erf(root * (from - 5))) + 0.1 * (std::sin(to) - std::sin(from));
  }
  Step step(double t, double dt) {
    Step step;
    step.dt = dt, step.time = t + dt, step.newton = 2, step.order = 1;
    step.error = std::abs(0.5 * dt * (rate(t + dt) - rate(t)));
    return step;
  }
};

struct Course {
  int steps = 0, rejected = 0;
  double error = 0, shortest = end, longest = 0;
};

Course run(const ClockConfig& config, const std::vector<double>& landings = {}) {
  Clock clock(config);
  clock.land_on(landings);
  Euler euler;
  Course result;
  std::vector<double> times;
  while (!clock.done() && clock.steps() < 1000000) {
    const double t = clock.time(), dt = clock.dt();
    const Step step = euler.step(t, dt);
    if (clock.reject(step)) continue;
    euler.u += dt * Euler::rate(t);
    clock.accept(step, std::numeric_limits<double>::infinity());
    result.shortest = std::min(result.shortest, dt), result.longest = std::max(result.longest, dt);
    times.push_back(clock.time());
  }
  for (double landing : landings) EXPECT_EQ(std::count(times.begin(), times.end(), landing), 1) << landing;
  result.steps = clock.steps(), result.rejected = clock.rejected();
  result.error = std::abs(euler.u - Euler::exact(0, end));
  return result;
}

TEST(AdaptiveClock, MakesAnErrorProportionalToItsTolerance) {
  std::vector<Course> runs;
  for (double tolerance : {4e-2, 2e-2, 1e-2}) {
    runs.push_back(run({.end = end, .step = 0.01, .tolerance = tolerance}));
    const Course& r = runs.back();
    fmt::print("tolerance {:.1e}: {} steps of {:.1e} to {:.1e}, {} rejected, error {:.2e}\n", tolerance, r.steps,
               r.shortest, r.longest, r.rejected, r.error);
    EXPECT_LT(r.rejected, 0.1 * r.steps);
    EXPECT_GT(r.longest, 5 * r.shortest);
  }
  EXPECT_NEAR(static_cast<double>(runs[2].steps) / runs[1].steps, 2, 0.3);
}

TEST(AdaptiveClock, NeedsFewerStepsThanEqualOnesOfTheSameLocalError) {
  const Course adaptive = run({.end = end, .step = 0.01, .tolerance = 1e-2});
  const int equal = static_cast<int>(end / adaptive.shortest);
  fmt::print("{} adaptive steps, {} equal ones\n", adaptive.steps, equal);
  EXPECT_LT(3 * adaptive.steps, equal);
}

TEST(AdaptiveClock, LandsOnTimesExactlyAndGoesOnAsBefore) {
  const std::vector<double> times{0.1, 1.0 / 3, 1.0, 4.999, 5, 5.0001, 9.7};
  const Course landing = run({.end = end, .step = 0.01, .tolerance = 1e-2}, times),
               free = run({.end = end, .step = 0.01, .tolerance = 1e-2});
  EXPECT_LE(landing.steps, free.steps + 4 * static_cast<int>(times.size()));
}

TEST(AdaptiveClock, IgnoresLandingsWhenItsStepIsFixed) {
  Clock clock({.end = 1, .step = 0.1});
  clock.land_on({0.55});
  EXPECT_EQ(clock.dt(), 0.1);
  Step wrong;
  wrong.error = 1e9;
  EXPECT_FALSE(clock.reject(wrong));
}

TEST(AdaptiveClock, KeepsToItsLargestStep) {
  const Course r = run({.end = end, .step = 0.01, .tolerance = 0.5, .largest_step = 0.05});
  EXPECT_LE(r.longest, 0.05 * (1 + 1e-12));
}

TEST(AdaptiveClock, DoesNotGrowWhenNewtonFindsItHard) {
  Clock clock({.end = 10, .step = 0.1, .tolerance = 1e-2});
  Step hard;
  hard.newton = 12, hard.error = 1e-12, hard.order = 1;
  for (int i = 0; i < 5; ++i) clock.accept(hard, std::numeric_limits<double>::infinity());
  EXPECT_LE(clock.dt(), 0.1 * (1 + 1e-12));
}

TEST(AdaptiveClock, GivesUpOnAnErrorThatNoStepMakesSmall) {
  Clock clock({.end = 1, .step = 0.1, .tolerance = 1e-2});
  Step wrong;
  wrong.error = 1, wrong.order = 1;
  int rejected = 0;
  while (clock.reject(wrong) && rejected < 1000) ++rejected;
  EXPECT_LT(rejected, 100);
}

}  // namespace
}  // namespace titin
