/// Square matrices with few diagonals: those of a rod, whose nodes are numbered along it.
#pragma once

#include <mfem.hpp>
#include <vector>

namespace titin {

class BandMatrix {
 public:
  BandMatrix() = default;
  /// `half` diagonals on each side of the main one.
  BandMatrix(int size, int half) : size_(size), half_(half), values_(std::size_t(2 * half + 1) * size) {}

  int size() const { return size_; }
  int half() const { return half_; }
  double& operator()(int i, int j) { return values_[std::size_t(2 * half_ + 1) * j + half_ + i - j]; }
  double operator()(int i, int j) const {
    const bool inside = i - j <= half_ && j - i <= half_;
    return inside ? values_[std::size_t(2 * half_ + 1) * j + half_ + i - j] : 0;
  }
  void clear() { std::fill(values_.begin(), values_.end(), 0.0); }
  void add(double factor, const BandMatrix& other);  ///< of the same shape
  /// Row i becomes that of the unit matrix.
  void make_unit_row(int i);
  mfem::Vector multiply(const mfem::Vector& x) const;
  /// b becomes A^-1 b by Gauss elimination with pivots (LAPACK dgbsv); false when A is singular.
  bool solve(mfem::Vector& b) const;

 private:
  int first(int i) const { return std::max(0, i - half_); }
  int last(int i) const { return std::min(size_ - 1, i + half_); }

  int size_ = 0, half_ = 0;
  std::vector<double> values_;
};

}  // namespace titin
