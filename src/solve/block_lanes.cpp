#include "solve/block_lanes.hpp"

#include <algorithm>

namespace titin {

namespace {

/// Of its first value: what float leaves of a pivot that should be zero.
constexpr float smallest_pivot = 1e-6f;

}  // namespace

void multiply_packed(int n, const FloatLanes* A, const FloatLanes* x, FloatLanes* y) {
  int i = 0;
  std::fill_n(y, n, FloatLanes{});
  for (; i + 1 < n; i += 2) {  // two rows share the loads and stores of x and y
    const FloatLanes *row = A + packed_size(i), *next = A + packed_size(i + 1), xi = x[i], xn = x[i + 1];
    FloatLanes sum{}, sum_next{};
    for (int j = 0; j < i; ++j) {
      const FloatLanes a = row[j], b = next[j];
      sum += a * x[j];
      sum_next += b * x[j];
      y[j] += a * xi + b * xn;
    }
    y[i] += sum + row[i] * xi + next[i] * xn;
    y[i + 1] += sum_next + next[i] * xi + next[i + 1] * xn;
  }
  if (i < n) {
    const FloatLanes* row = A + packed_size(i);
    FloatLanes sum = row[i] * x[i];
    for (int j = 0; j < i; ++j) {
      sum += row[j] * x[j];
      y[j] += row[j] * x[i];
    }
    y[i] += sum;
  }
}

void invert_packed(int n, FloatLanes* A) {
  std::vector<FloatLanes> column(n), floor(n);
  for (int i = 0; i < n; ++i) {
    const FloatLanes d = A[packed_index(i, i)];
    floor[i] = smallest_pivot * (d > 0 ? d : -d);
  }
  for (int k = 0; k < n; ++k) {
    const FloatLanes pivot = A[packed_index(k, k)];
    const FloatLanes inverse = pivot > floor[k] ? 1.0f / pivot : FloatLanes{};
    for (int i = 0; i < n; ++i) column[i] = A[packed_index(i, k)];
    column[k] = FloatLanes{};
    for (int i = 0; i < n; ++i) {
      const FloatLanes factor = column[i] * inverse;
      FloatLanes* row = A + packed_size(i);
      for (int j = 0; j <= i; ++j) row[j] -= factor * column[j];
    }
    for (int i = 0; i < n; ++i) A[packed_index(i, k)] = column[i] * inverse;
    A[packed_index(k, k)] = -inverse;
  }
  for (std::size_t e = 0; e < packed_size(n); ++e) A[e] = -A[e];
}

}  // namespace titin
