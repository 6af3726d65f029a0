#include "solve/block_coupling.hpp"

#include <algorithm>
#include <cstring>

namespace titin {

namespace {

typedef double FourDoubles __attribute__((vector_size(32)));

/// In four sums, which is another order than one by one.
double dot(int n, const double* a, const double* b) {
  FourDoubles sums{};
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    FourDoubles x, y;
    std::memcpy(&x, a + i, sizeof(x));
    std::memcpy(&y, b + i, sizeof(y));
    sums += x * y;
  }
  double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Coupling::Coupling(const CellBlocks& blocks, const Multigrid& multigrid)
    : blocks_(blocks), values_(blocks.layout().size()) {
  const int n = blocks.layout().size();
  places_.reserve(std::size_t(blocks.layout().cells) * n);
  for (int cell = 0; cell < blocks.layout().cells; ++cell)
    for (int c = 0; c < n; ++c) places_.push_back(multigrid.place(cell, c));
}

void Coupling::divergence(int cell, const double* x, double* t) const {
  const int n = blocks_.layout().size(), m = blocks_.layout().modes;
  const int* place = &places_[std::size_t(cell) * n];
  for (int c = 0; c < n; ++c) values_[c] = x[place[c]];
  for (int l = 0; l < m; ++l) t[l] = dot(n, blocks_.B(cell) + l * n, values_.data());
}

void Coupling::add_gradient(int cell, const double* p, double* y) const {
  const int n = blocks_.layout().size(), m = blocks_.layout().modes;
  const int* place = &places_[std::size_t(cell) * n];
  std::fill(values_.begin(), values_.end(), 0.0);
  double* values = values_.data();
  for (int l = 0; l < m; ++l) {
    const double* B = blocks_.B(cell) + l * n;
    for (int c = 0; c < n; ++c) values[c] += B[c] * p[l];
  }
  for (int c = 0; c < n; ++c) y[place[c]] += values[c];
}

}  // namespace titin
