// Eight symmetric matrices at a time against the same by plain loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "solve/block_lanes.hpp"
#include "solve/block_matrices.hpp"

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

/// Largest error of A x against plain sums, over sum_j s_i s_j |x_j| with s_i^2 = |A_ii|.
double product_error(const std::vector<FloatLanes>& A, int n, BlockMatrices::Entries entries) {
  BlockMatrices kept(entries);
  kept.add(n);
  kept.add(n);  // the second of two
  kept.set(0, std::vector<FloatLanes>(packed_size(n)).data());
  kept.set(1, A.data());
  std::vector<FloatLanes> x(n), y(n);
  for (int i = 0; i < n; ++i)
    for (int lane = 0; lane < float_lanes; ++lane) x[i][lane] = std::sin(static_cast<float>(i + 3 * lane));
  const auto given = x;
  kept.multiply(1, x.data(), y.data());
  double error = 0;
  for (int lane = 0; lane < float_lanes; ++lane)
    for (int i = 0; i < n; ++i) {
      double sum = 0, size = 1e-30;
      const auto diagonal = [&](int k) { return std::sqrt(std::abs(A[packed_index(k, k)][lane])); };
      for (int j = 0; j < n; ++j) {
        sum += double(A[packed_index(i, j)][lane]) * given[j][lane];
        size += diagonal(i) * diagonal(j) * std::abs(given[j][lane]);
      }
      error = std::max(error, std::abs(y[i][lane] - sum) / size);
    }
  kept.multiply(0, x.data(), y.data());
  for (int i = 0; i < n; ++i)
    for (int lane = 0; lane < float_lanes; ++lane) EXPECT_EQ(y[i][lane], 0.0f);
  return error;
}

TEST_P(BlockLanes, product_is_that_of_a_loop) {
  const int n = GetParam();
  EXPECT_LE(product_error(positive_matrices(n), n, BlockMatrices::Entries::floats), 1e-6);
}

constexpr double half_of_16_bits = 0.5 / 32767;

TEST_P(BlockLanes, product_of_rounded_entries_is_off_by_their_rounding) {
  const int n = GetParam();
  const double error = product_error(positive_matrices(n), n, BlockMatrices::Entries::rounded);
  EXPECT_LE(error, 1.1 * half_of_16_bits);
}

/// As entries of stiff and soft directions are: rows in units of their own do not change the relative error.
TEST_P(BlockLanes, rounding_does_not_know_units) {
  const int n = GetParam();
  auto A = positive_matrices(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) A[packed_index(i, j)] *= std::pow(10.0f, static_cast<float>(i % 3 + j % 3) - 9);
  EXPECT_LE(product_error(A, n, BlockMatrices::Entries::rounded), 1.1 * half_of_16_bits);
}

/// Entries may then be larger than their diagonals: rounding is coarser, nothing overflows.
TEST(BlockLanesOfBadMatrices, rounded_products_bear_indefinite_ones) {
  const int n = 6;
  auto A = positive_matrices(n);
  A[packed_index(4, 1)] = FloatLanes{} - 20.0f;
  const double error = product_error(A, n, BlockMatrices::Entries::rounded);
  EXPECT_LE(error, 20 * half_of_16_bits);
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
