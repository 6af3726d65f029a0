#include "base/table.hpp"

#include <algorithm>
#include <stdexcept>

namespace titin {

Table::Table(std::vector<double> time, std::vector<double> value) : time_(std::move(time)), value_(std::move(value)) {
  if (time_.empty() || time_.size() != value_.size()) throw std::logic_error("a table needs one value for each time");
}

double Table::operator()(double t) const {
  const auto next = std::upper_bound(time_.begin(), time_.end(), t);
  if (next == time_.begin()) return value_.front();
  if (next == time_.end()) return value_.back();
  const auto i = static_cast<std::size_t>(next - time_.begin());
  const double w = (t - time_[i - 1]) / (time_[i] - time_[i - 1]);
  return (1 - w) * value_[i - 1] + w * value_[i];
}

}  // namespace titin
