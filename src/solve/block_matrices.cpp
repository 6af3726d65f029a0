#include "solve/block_matrices.hpp"

#include <algorithm>
#include <cmath>

namespace titin {

namespace {

typedef std::int32_t IntLanes __attribute__((vector_size(32)));

constexpr int group = 4;                // rows
constexpr int ahead = 2048;             // bytes that are fetched before they are used
constexpr float most = 32767;           // of 16 bits
constexpr float least_diagonal = 1e-3;  // of the largest entry in its row, that scales are made of

FloatLanes widen(FloatLanes a) { return a; }
FloatLanes widen(ShortLanes a) { return __builtin_convertvector(__builtin_convertvector(a, IntLanes), FloatLanes); }

FloatLanes larger(FloatLanes a, FloatLanes b) { return a > b ? a : b; }
FloatLanes size_of(FloatLanes a) { return a < 0 ? -a : a; }
FloatLanes root(FloatLanes a) {
  for (int lane = 0; lane < float_lanes; ++lane) a[lane] = std::sqrt(a[lane]);
  return a;
}

ShortLanes nearest(FloatLanes a) {
  a = a > most ? FloatLanes{} + most : a < -most ? FloatLanes{} - most : a;
  const FloatLanes half = a < 0 ? FloatLanes{} - 0.5f : FloatLanes{} + 0.5f;
  return __builtin_convertvector(__builtin_convertvector(a + half, IntLanes), ShortLanes);
}

/// Rows i to i + rows - 1, by their columns up to i + rows - 1. Returns what comes behind them.
template <int rows, class Lanes>
const Lanes* multiply_rows(int i, const Lanes* A, const FloatLanes* x, FloatLanes* y) {
  FloatLanes sum[rows] = {}, own[rows];
  for (int r = 0; r < rows; ++r) own[r] = x[i + r];
  for (int j = 0; j < i; ++j, A += rows) {
    __builtin_prefetch(reinterpret_cast<const char*>(A) + ahead);
    const FloatLanes xj = x[j];
    FloatLanes yj = y[j];
    for (int r = 0; r < rows; ++r) {
      const FloatLanes a = widen(A[r]);
      sum[r] += a * xj;
      yj += a * own[r];
    }
    y[j] = yj;
  }
  for (int r = 0; r < rows; ++r)
    for (int s = 0; s <= r; ++s, ++A) {
      const FloatLanes a = widen(*A);
      sum[r] += a * own[s];
      if (s < r) sum[s] += a * own[r];
    }
  for (int r = 0; r < rows; ++r) y[i + r] += sum[r];
  return A;
}

template <class Lanes>
void multiply_all(int n, const Lanes* A, const FloatLanes* x, FloatLanes* y) {
  std::fill_n(y, n, FloatLanes{});
  int i = 0;
  for (; i + group <= n; i += group) A = multiply_rows<group>(i, A, x, y);
  if (n - i == 3) multiply_rows<3>(i, A, x, y);
  if (n - i == 2) multiply_rows<2>(i, A, x, y);
  if (n - i == 1) multiply_rows<1>(i, A, x, y);
}

/// Calls visit(i, j), j <= i, in the order of the entries in memory.
template <class Visit>
void in_order(int n, Visit visit) {
  for (int first = 0; first < n; first += group) {
    const int end = std::min(first + group, n);
    for (int j = 0; j < first; ++j)
      for (int i = first; i < end; ++i) visit(i, j);
    for (int i = first; i < end; ++i)
      for (int j = first; j <= i; ++j) visit(i, j);
  }
}

}  // namespace

void BlockMatrices::add(int n) {
  batches_.push_back({n, room_, scales_.size()});
  room_ += packed_size(n);
  if (entries_ == Entries::rounded) scales_.resize(scales_.size() + n);
}

void BlockMatrices::set(std::size_t number, const FloatLanes* A) {
  const Batch& batch = batches_[number];
  if (entries_ == Entries::floats) {
    if (floats_.size() < room_) floats_.resize(room_);
    FloatLanes* to = &floats_[batch.first];
    return in_order(batch.n, [&](int i, int j) { *to++ = A[packed_index(i, j)]; });
  }
  if (shorts_.size() < room_) shorts_.resize(room_);
  set_scales(batch, A);
  std::vector<FloatLanes> inverse(&scales_[batch.first_scale], &scales_[batch.first_scale] + batch.n);
  for (FloatLanes& s : inverse) s = s > 0 ? 1 / s : FloatLanes{};
  ShortLanes* to = &shorts_[batch.first];
  in_order(batch.n, [&](int i, int j) { *to++ = nearest(A[packed_index(i, j)] * inverse[i] * inverse[j]); });
}

void BlockMatrices::set_scales(const Batch& batch, const FloatLanes* A) {
  const int n = batch.n;
  FloatLanes* scale = &scales_[batch.first_scale];
  std::fill_n(scale, n, FloatLanes{});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      const FloatLanes entry = size_of(A[packed_index(i, j)]);
      scale[i] = larger(scale[i], entry);
      scale[j] = larger(scale[j], entry);
    }
  for (int i = 0; i < n; ++i) scale[i] = root(larger(size_of(A[packed_index(i, i)]), least_diagonal * scale[i]));
  FloatLanes excess = FloatLanes{} + 1;  // over what positive semidefinite matrices have
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) {
      const FloatLanes bound = scale[i] * scale[j], entry = size_of(A[packed_index(i, j)]);
      excess = larger(excess, bound > 0 ? entry / bound : FloatLanes{});
    }
  const FloatLanes factor = root(excess / most);
  for (int i = 0; i < n; ++i) scale[i] *= factor;
}

void BlockMatrices::multiply(std::size_t number, FloatLanes* x, FloatLanes* y) const {
  const Batch& batch = batches_[number];
  const int n = batch.n;
  if (entries_ == Entries::floats) return multiply_all(n, &floats_[batch.first], x, y);
  const FloatLanes* scale = &scales_[batch.first_scale];
  for (int i = 0; i < n; ++i) x[i] *= scale[i];
  multiply_all(n, &shorts_[batch.first], x, y);
  for (int i = 0; i < n; ++i) y[i] *= scale[i];
}

std::size_t BlockMatrices::bytes() const {
  const auto size = [](const auto&... list) { return ((list.capacity() * sizeof(list[0])) + ...); };
  return size(batches_, floats_, shorts_, scales_);
}

}  // namespace titin
