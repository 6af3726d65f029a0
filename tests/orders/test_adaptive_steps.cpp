// Adaptive steps of a whole body: error against tolerance, against equal steps, and the times that steps end at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"
#include "solve/clock.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double end = 0.032;  // [s]
const std::vector<double> kinks{0.02, 0.0213, 0.024};

/// At rest for long, then struck: a soft clamped block under a short body force.
const std::string struck_block = "[time]\nscheme = \"generalised_alpha\"\n[muscle]\norder = 1\n" + soft_material + R"(
[boundary."x-"]
clamp = true
[body]
acceleration = "0, 0, 200 m/s^2"
scale = { time = "0.02, 0.0213, 0.024 s", value = [0, 1, 0.2] }
[solver]
tolerance = 1e-10
)";

struct Result {
  mfem::Vector u;
  std::vector<double> times;
  int rejected = 0;
};

Result run(const ClockConfig& config) {
  const auto model = make_block(struck_block);
  Clock clock(config);
  clock.land_on(model->kinks());
  Result result;
  while (!clock.done()) {
    const Step step = model->advance(clock.dt());
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) break;
    if (clock.reject(step)) {
      model->rewind();
      continue;
    }
    model->accept();
    clock.accept(step, model->largest_dt());
    EXPECT_NEAR(model->time(), clock.time(), 1e-12);
    result.times.push_back(clock.time());
  }
  result.u = model->displacement();
  result.rejected = clock.rejected();
  return result;
}

double error(const mfem::Vector& u, const mfem::Vector& exact) {
  mfem::Vector d = u;
  d -= exact;
  return std::sqrt(sum(d * d) / sum(exact * exact));
}

TEST(AdaptiveSteps, MakeAnErrorProportionalToTheToleranceWithFewerSteps) {
  const mfem::Vector exact = run({.end = end, .step = end / 3200}).u;
  std::vector<double> errors;
  for (double tolerance : {4e-2, 1e-2}) {
    const Result adaptive = run({.end = end, .step = 1e-3, .tolerance = tolerance});
    const int steps = static_cast<int>(adaptive.times.size());
    const Result equal = run({.end = end, .step = end / steps});
    errors.push_back(error(adaptive.u, exact));
    fmt::print("tolerance {:.0e}: {} steps, {} rejected, error {:.2e}; as many equal steps {:.2e}\n", tolerance, steps,
               adaptive.rejected, errors.back(), error(equal.u, exact));
    EXPECT_LT(1.5 * errors.back(), error(equal.u, exact));
    EXPECT_LT(adaptive.rejected, 0.3 * steps);
    for (double kink : kinks)
      EXPECT_EQ(std::count(adaptive.times.begin(), adaptive.times.end(), kink), 1) << "no step ends at " << kink;
  }
  EXPECT_GT(errors[0] / errors[1], 2.5) << "4 would be proportional";
  EXPECT_LT(errors[0] / errors[1], 7);
}

}  // namespace
}  // namespace titin
