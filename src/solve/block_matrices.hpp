/// Many symmetric matrices, eight at a time (block_lanes.hpp), kept to be multiplied with: products stream through
/// them, so that what counts is their size in memory, and that they lie in one stream.
///
/// Entries are floats, or integers q of 16 bits with A_ij = s_i s_j q_ij and s_i = sqrt(c max(|A_ii|, t max_j |A_ij|)):
/// |A_ij| <= sqrt(A_ii A_jj) holds for all entries of a positive semidefinite matrix, so that c = 1 / 32767 and errors
/// are 1.5e-5 of sqrt(A_ii A_jj) at most; for others c is larger, as it must be. Such matrices stay symmetric.
///
/// Layout: rows in groups of four, the last of fewer. A group has the entries of its rows beside each other, column by
/// column up to its own block, and then the lower triangle of that.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/block_lanes.hpp"
#include "solve/large_pages.hpp"

namespace titin {

typedef std::int16_t ShortLanes __attribute__((vector_size(16)));

class BlockMatrices {
 public:
  enum class Entries { floats, rounded };
  explicit BlockMatrices(Entries entries) : entries_(entries) {}

  void add(int n);  ///< room for eight more of size n; they get the next number
  /// A: packed. Zero for lanes without a matrix.
  void set(std::size_t number, const FloatLanes* A);
  /// y = A x, [n]. x is used up.
  void multiply(std::size_t number, FloatLanes* x, FloatLanes* y) const;
  int size(std::size_t number) const { return batches_[number].n; }
  std::size_t bytes() const;

 private:
  struct Batch {
    int n;
    std::size_t first, first_scale;
  };
  void set_scales(const Batch& batch, const FloatLanes* A);

  Entries entries_;
  std::vector<Batch> batches_;
  std::size_t room_ = 0;
  std::vector<FloatLanes, LargePages<FloatLanes>> floats_;
  std::vector<ShortLanes, LargePages<ShortLanes>> shorts_;
  std::vector<FloatLanes> scales_;
};

}  // namespace titin
