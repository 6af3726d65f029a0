/// Piecewise linear function of time, held constant outside its points.
#pragma once

#include <vector>

namespace titin {

class Table {
 public:
  Table(double constant = 0) : time_{0}, value_{constant} {}
  /// `time` [s] strictly increasing, same length as `value` (not empty); checked where tables are read.
  Table(std::vector<double> time, std::vector<double> value);

  double operator()(double t) const;
  double slope_before(double t) const;  ///< of the piece that t ends or lies in; 0 outside the points
  std::vector<double> kinks() const;    ///< times at which the slope changes
  bool is_constant() const { return value_.size() == 1; }
  const std::vector<double>& time() const { return time_; }
  const std::vector<double>& value() const { return value_; }

 private:
  std::vector<double> time_, value_;
};

}  // namespace titin
