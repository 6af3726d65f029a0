#include "rod/band_matrix.hpp"

#include "rod/lapack.hpp"

namespace titin {

void BandMatrix::add(double factor, const BandMatrix& other) {
  for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += factor * other.values_[k];
}

void BandMatrix::make_unit_row(int i) {
  for (int j = first(i); j <= last(i); ++j) (*this)(i, j) = i == j;
}

mfem::Vector BandMatrix::multiply(const mfem::Vector& x) const {
  mfem::Vector y(size_);
  for (int i = 0; i < size_; ++i) {
    y(i) = 0;
    for (int j = first(i); j <= last(i); ++j) y(i) += (*this)(i, j) * x(j);
  }
  return y;
}

bool BandMatrix::solve(mfem::Vector& b) const {
  const int rows = 3 * half_ + 1, own = 2 * half_ + 1, one = 1;
  std::vector<double> factors(std::size_t(rows) * size_);
  for (int j = 0; j < size_; ++j)
    std::copy_n(values_.begin() + std::size_t(own) * j, own, factors.begin() + std::size_t(rows) * j + half_);
  std::vector<int> pivots(size_);
  int info = 0;
  dgbsv_(&size_, &half_, &half_, &one, factors.data(), &rows, pivots.data(), b.GetData(), &size_, &info);
  return info == 0;
}

}  // namespace titin
