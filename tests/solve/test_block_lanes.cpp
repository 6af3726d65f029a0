// Eight symmetric matrices at a time against the same by plain loops.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "solve/block_lanes.hpp"

namespace titin {
namespace {

constexpr double float_round_off = 2e-5;  // of sums of some dozen products of numbers of order one

/// Positive definite, its smallest eigenvalue one: I + R R^T / n.
std::vector<FloatLanes> positive_matrices(int n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1, 1);
  std::vector<FloatLanes> A(packed_size(n));
  for (int lane = 0; lane < float_lanes; ++lane) {
    std::vector<float> R(n * n);
    for (float& r : R) r = number(random);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        float sum = i == j ? 1.0f : 0.0f;
        for (int k = 0; k < n; ++k) sum += R[i * n + k] * R[j * n + k] / static_cast<float>(n);
        A[packed_index(i, j)][lane] = sum;
      }
  }
  return A;
}

class BlockLanes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OddAndEvenSizes, BlockLanes, ::testing::Values(1, 2, 7, 24, 81));

TEST_P(BlockLanes, product_is_that_of_a_loop) {
  const int n = GetParam();
  const auto A = positive_matrices(n);
  std::vector<FloatLanes> x(n), y(n);
  for (int i = 0; i < n; ++i)
    for (int lane = 0; lane < float_lanes; ++lane) x[i][lane] = std::sin(static_cast<float>(i + 3 * lane));
  multiply_packed(n, A.data(), x.data(), y.data());
  for (int lane = 0; lane < float_lanes; ++lane)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += double(A[packed_index(i, j)][lane]) * x[j][lane];
      EXPECT_NEAR(y[i][lane], sum, float_round_off);
    }
}

TEST_P(BlockLanes, inverse_times_matrix_is_one) {
  const int n = GetParam();
  const auto A = positive_matrices(n);
  auto inverse = A;
  invert_packed(n, inverse.data());
  for (int lane = 0; lane < float_lanes; ++lane)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        double sum = 0;
        for (int k = 0; k < n; ++k) sum += double(A[packed_index(i, k)][lane]) * inverse[packed_index(k, j)][lane];
        EXPECT_NEAR(sum, i == j, float_round_off);
      }
}

TEST(BlockLanesOfBadMatrices, inverse_leaves_out_what_has_none) {
  const int n = 3;
  std::vector<FloatLanes> A(packed_size(n));
  A[packed_index(0, 0)] = FloatLanes{} + 2.0f;
  A[packed_index(1, 0)] = FloatLanes{} + 1.0f;
  A[packed_index(1, 1)] = FloatLanes{} + 0.5f;  // the first two rows are dependent
  A[packed_index(2, 2)] = FloatLanes{} - 3.0f;
  invert_packed(n, A.data());
  for (int lane = 0; lane < float_lanes; ++lane)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) EXPECT_EQ(A[packed_index(i, j)][lane], i == 0 ? 0.5f : 0.0f);
}

}  // namespace
}  // namespace titin
