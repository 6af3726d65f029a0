#include <gtest/gtest.h>

#include "math/piecewise.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-14;

/// s^2 on [1, 2), 1 + 2 s + s^3 on [2, 3), then straight on with slope 5.
constexpr Piecewise<2, 3> curve{
    .breaks = {1, 2, 3}, .coefficients = {{{0, 0, 1, 0}, {1, 2, 0, 1}}}, .above = Continuation::linear};

TEST(Piecewise, TakesThePieceThatHoldsThePoint) {
  EXPECT_NEAR(curve(1.5), 0.25, round_off);
  EXPECT_NEAR(curve(2.0), 1, round_off);
  EXPECT_NEAR(curve(2.5), 1 + 1 + 0.125, round_off);
}

TEST(Piecewise, GoesOnConstantOrAlongItsTangent) {
  EXPECT_NEAR(curve(0.2), 0, round_off);
  EXPECT_NEAR(curve(3.0), 4, round_off);
  EXPECT_NEAR(curve(3.5), 4 + 0.5 * 5, round_off);
  const auto x = Dual<1>::variable(3.5, 0);
  EXPECT_NEAR(curve(x).gradient[0], 5, round_off);
  EXPECT_NEAR(curve(x).hessian[0], 0, round_off);
}

TEST(Piecewise, DerivativesAreThoseOfThePiece) {
  const auto p = curve(Dual<1>::variable(2.5, 0));
  EXPECT_NEAR(p.gradient[0], 2 + 3 * 0.25, round_off);
  EXPECT_NEAR(p.hessian[0], 3, round_off);
}

/// Simpson's rule, fine enough for 1e-12 on smooth pieces.
double simpson(double from, double to) {
  constexpr int n = 2000;
  const double h = (to - from) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double a = from + i * h, m = a + h / 2, b = a + h;
    // The end of an interval belongs to its own piece also where the curve jumps.
    sum += h / 6 * (curve(a) / a + 4 * curve(m) / m + curve(std::nextafter(b, a)) / b);
  }
  return sum;
}

TEST(Piecewise, IntegralOverXIsExactOnPiecesAndOutside) {
  const double tolerance = 1e-11;  // of the quadrature
  EXPECT_NEAR(curve.integral_over_x(1.2, 1.8), simpson(1.2, 1.8), tolerance);
  EXPECT_NEAR(curve.integral_over_x(1, 2), simpson(1, 2), tolerance);
  EXPECT_NEAR(curve.integral_over_x(0.5, 1), 0, tolerance);
  EXPECT_NEAR(curve.integral_over_x(3, 4.5), simpson(3, 4.5), tolerance);
  const double whole = simpson(1, 2) + simpson(2, 3) + simpson(3, 4);
  EXPECT_NEAR(curve.integral_over_x(0.5, 4), whole, tolerance);
  EXPECT_NEAR(curve.integral_over_x(4, 0.5), -whole, tolerance);
}

TEST(Piecewise, IntegralAddsPiecesAndContinuations) {
  EXPECT_NEAR(curve.integral(0.5, 1), 0, round_off);
  EXPECT_NEAR(curve.integral(1, 2), 1.0 / 3, round_off);
  EXPECT_NEAR(curve.integral(0.5, 3), 1.0 / 3 + 1 + 1 + 0.25, round_off);
  EXPECT_NEAR(curve.integral(4, 3), -(4 + 2.5), round_off);
}

}  // namespace
}  // namespace titin
