#include <gtest/gtest.h>

#include "math/dual.hpp"

namespace titin {
namespace {

using std::cos, std::exp, std::expm1, std::log, std::log1p, std::pow, std::sin, std::sqrt;

// Two operations of rounding each in values of order one.
constexpr double round_off = 1e-14;

template <class T>
T sample(const T& x, const T& y) {
  return sqrt(x) * exp(-y) / (1.0 + x * y) + log(x + y) - pow(x, 2.5) * sin(y) + cos(x * x) / 3.0 +
         expm1(y) * log1p(x) - 2.0 / y;
}

/// Derivatives of the sample, by hand for the parts and by the rules of calculus for their sums.
TEST(Dual, DerivativesOfAComposedFunctionAgreeWithFiniteDifferencesAtTheirOrder) {
  const double x = 0.7, y = 0.4;
  const auto f = sample(Dual<2>::variable(x, 0), Dual<2>::variable(y, 1));
  EXPECT_NEAR(f.value, sample(x, y), round_off);
  double last_gradient = 0, last_hessian = 0;
  for (double h : {1e-2, 5e-3}) {
    const double fx = (sample(x + h, y) - sample(x - h, y)) / (2 * h);
    const double fxy =
        (sample(x + h, y + h) - sample(x + h, y - h) - sample(x - h, y + h) + sample(x - h, y - h)) / (4 * h * h);
    const double gradient = std::abs(fx - f.gradient[0]), hessian = std::abs(fxy - f.hessian[Dual<2>::pair(1, 0)]);
    if (last_gradient > 0) {
      EXPECT_GT(std::log2(last_gradient / gradient), 1.9);
      EXPECT_GT(std::log2(last_hessian / hessian), 1.9);
    }
    last_gradient = gradient, last_hessian = hessian;
  }
}

TEST(Dual, ElementaryFunctionsHaveTheirKnownDerivatives) {
  const double x = 0.6;
  const auto v = Dual<1>::variable(x, 0);
  const auto expect = [](const Dual<1>& f, double value, double first, double second) {
    EXPECT_NEAR(f.value, value, round_off);
    EXPECT_NEAR(f.gradient[0], first, round_off);
    EXPECT_NEAR(f.hessian[0], second, 4 * round_off);
  };
  expect(sqrt(v), sqrt(x), 0.5 / sqrt(x), -0.25 / (x * sqrt(x)));
  expect(exp(v), exp(x), exp(x), exp(x));
  expect(expm1(v), expm1(x), exp(x), exp(x));
  expect(log(v), log(x), 1 / x, -1 / (x * x));
  expect(log1p(v), log1p(x), 1 / (1 + x), -1 / ((1 + x) * (1 + x)));
  expect(sin(v), sin(x), cos(x), -sin(x));
  expect(cos(v), cos(x), -sin(x), -cos(x));
  expect(pow(v, 3.0), x * x * x, 3 * x * x, 6 * x);
  expect(1.0 / v, 1 / x, -1 / (x * x), 2 / (x * x * x));
  expect(v / v, 1, 0, 0);
  expect(2.0 - v, 2 - x, -1, 0);
  expect(-v * v + 3.0, 3 - x * x, -2 * x, -2);
}

TEST(Dual, ComparesByValueAndTakesTheDerivativeOfTheBranch) {
  const auto positive_part = [](const auto& x) { return x > 0.0 ? x * x : 0.0 * x; };
  EXPECT_DOUBLE_EQ(positive_part(Dual<1>::variable(2, 0)).gradient[0], 4);
  EXPECT_DOUBLE_EQ(positive_part(Dual<1>::variable(-2, 0)).gradient[0], 0);
  EXPECT_TRUE(Dual<1>(1) < Dual<1>(2));
  EXPECT_TRUE(Dual<1>(1) == 1.0);
}

TEST(Dual, FirstOrderNumbersCarryTheSameGradient) {
  const auto first = sample(Dual<2, 1>::variable(0.7, 0), Dual<2, 1>::variable(0.4, 1));
  const auto second = sample(Dual<2>::variable(0.7, 0), Dual<2>::variable(0.4, 1));
  EXPECT_DOUBLE_EQ(first.gradient[0], second.gradient[0]);
  EXPECT_DOUBLE_EQ(first.gradient[1], second.gradient[1]);
}

}  // namespace
}  // namespace titin
