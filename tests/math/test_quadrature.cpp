#include <gtest/gtest.h>

#include "math/quadrature.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-14;

TEST(Integrate, IsExactForPolynomialsOfDegreeFifteen) {
  for (int degree = 0; degree <= 15; ++degree) {
    const double exact = (std::pow(2.0, degree + 1) - std::pow(0.5, degree + 1)) / (degree + 1);
    EXPECT_NEAR(integrate([&](double x) { return std::pow(x, degree); }, 0.5, 2), exact, round_off * exact) << degree;
  }
}

TEST(Integrate, ReachesRoundOffWithPanels) {
  const double exact = std::expm1(12.0);
  EXPECT_NEAR(integrate([](double x) { return std::exp(x); }, 0, 12, 6), exact, 10 * round_off * exact);
}

}  // namespace
}  // namespace titin
