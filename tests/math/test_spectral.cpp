#include <gtest/gtest.h>

#include "math/spectral.hpp"

namespace titin {
namespace {

// Some tens of roundings of numbers of order one.
constexpr double round_off = 1e-14;

void expect_eigenpairs(const Mat3& S, double scale) {
  const Eigenpairs e = eigenpairs(S);
  Mat3 rebuilt{};
  for (int a = 0; a < 3; ++a) {
    add(rebuilt, e.values[a], dyad(e.vectors[a], e.vectors[a]));
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(dot(e.vectors[a], e.vectors[b]), a == b, round_off);
  }
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(rebuilt[i], S[i], round_off * scale);
}

TEST(Eigenpairs, RebuildTheirTensor) {
  expect_eigenpairs({2, -1, 0.3, -1, 1, 0.7, 0.3, 0.7, -3}, 4);
  expect_eigenpairs({1, 0, 0, 0, 2, 0, 0, 0, 3}, 3);
  expect_eigenpairs({1e-9, 2e-10, -1e-10, 2e-10, -3e-9, 5e-11, -1e-10, 5e-11, 4e-9}, 1e-9);
  expect_eigenpairs({}, 1);
}

TEST(Eigenpairs, AreExactAtRepeatedAndNearlyRepeatedValues) {
  expect_eigenpairs(identity, 1);
  const double h = 1e-9;  // I + h n (x) n
  expect_eigenpairs(
      {1 + h * 4 / 9, h * 2 / 9, h * 4 / 9, h * 2 / 9, 1 + h / 9, h * 2 / 9, h * 4 / 9, h * 2 / 9, 1 + h * 4 / 9}, 1);
  expect_eigenpairs({1, 1, 1, 1, 1, 1, 1, 1, 1}, 3);  // 3, 0, 0
}

TEST(DividedDifference, IsTheQuotientFarApartAndTheDerivativeAtEqualPoints) {
  const double m = -4.5, a = 0.3, b = 0.9;
  const double quotient = (std::exp(m * b) - std::exp(m * a)) / (std::exp(b) - std::exp(a));
  EXPECT_NEAR(divided_difference_of_power(m, a, b), quotient, round_off);
  EXPECT_NEAR(divided_difference_of_power(m, b, a), quotient, round_off);
  EXPECT_NEAR(divided_difference_of_power(m, a, a), m * std::exp((m - 1) * a), round_off);
}

/// Between nearly equal points the derivative at their middle is right to the square of the distance.
TEST(DividedDifference, KeepsItsDigitsAtNearlyEqualPoints) {
  for (double m : {-10.0, 0.65, 10.0})
    for (double h : {1e-6, 1e-9, 1e-12, 1e-15}) {
      const double derivative = m * std::exp((m - 1) * (0.2 + h / 2));
      EXPECT_NEAR(divided_difference_of_power(m, 0.2, 0.2 + h) / derivative, 1, 100 * h * h + round_off)
          << m << ' ' << h;
    }
}

}  // namespace
}  // namespace titin
