/// Eight symmetric matrices of one size at a time, one in each lane of a vector register: the dense work of the
/// block solver (cell matrices, patch inverses) on the way to what it multiplies with (block_matrices.hpp).
///
/// Layout: entry (i, j), j <= i, of all eight is one FloatLanes at i (i + 1) / 2 + j.
#pragma once

#include <cstddef>
#include <vector>

namespace titin {

typedef float FloatLanes __attribute__((vector_size(32)));
constexpr int float_lanes = 8;

constexpr std::size_t packed_size(int n) { return std::size_t(n) * (n + 1) / 2; }
constexpr std::size_t packed_index(int i, int j) { return i >= j ? packed_size(i) + j : packed_size(j) + i; }

/// A <- A^-1, by sweeps over all pivots (Goodnight 1979). Without exchanges, which positive definite matrices do not
/// need. Where a pivot has fallen below a small part of its first value (a matrix that is not positive definite, or
/// singular) its row and column are left out and become zero: the result is always finite and positive semidefinite.
void invert_packed(int n, FloatLanes* A);

}  // namespace titin
