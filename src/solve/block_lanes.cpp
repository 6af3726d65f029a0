#include "solve/block_lanes.hpp"

namespace titin {

namespace {

/// Of its first value: what float leaves of a pivot that should be zero.
constexpr float smallest_pivot = 1e-6f;

}  // namespace

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
