/// What the points of cells remember: a row of doubles for each point, at t_n and at t_n+1.
#pragma once

#include <algorithm>
#include <vector>

namespace titin {

class History {
 public:
  History() = default;
  /// `row_size` [cells]: doubles that a point of each cell needs; `points` [cells]: how many it has.
  History(const std::vector<int>& row_size, const std::vector<int>& points) : first_(1, 0) {
    for (std::size_t cell = 0; cell < points.size(); ++cell)
      first_.push_back(first_.back() + std::size_t(row_size[cell]) * points[cell]);
    old_.resize(first_.back());
    now_.resize(first_.back());
  }
  double* old(int cell) { return old_.data() + first_[cell]; }
  double* now(int cell) { return now_.data() + first_[cell]; }
  const double* old(int cell) const { return old_.data() + first_[cell]; }
  std::vector<double>& all_old() { return old_; }
  std::vector<double>& all_now() { return now_; }
  /// Makes t_n+1 the past: when a step is accepted, and once after the rows at rest were written.
  void commit() { std::copy(now_.begin(), now_.end(), old_.begin()); }

 private:
  std::vector<std::size_t> first_;
  std::vector<double> old_, now_;
};

}  // namespace titin
