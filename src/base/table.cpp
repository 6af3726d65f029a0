#include "base/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace titin {
namespace {

constexpr double same_slope = 1e-9;  // of the steepest: round-off of values that were printed with ten digits

}  // namespace

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

std::vector<double> Table::kinks() const {
  std::vector<double> kinks;
  const auto slope = [&](std::size_t i) { return (value_[i] - value_[i - 1]) / (time_[i] - time_[i - 1]); };
  double before = 0, steepest = 0;
  for (std::size_t i = 1; i < time_.size(); ++i) steepest = std::max(steepest, std::abs(slope(i)));
  for (std::size_t i = 0; i < time_.size(); ++i) {
    const double after = i + 1 < time_.size() ? slope(i + 1) : 0.0;
    if (std::abs(after - before) > same_slope * steepest) kinks.push_back(time_[i]);
    before = after;
  }
  return kinks;
}

double Table::slope_before(double t) const {
  const auto next = std::lower_bound(time_.begin(), time_.end(), t);
  if (next == time_.begin() || next == time_.end()) return 0;
  const auto i = static_cast<std::size_t>(next - time_.begin());
  return (value_[i] - value_[i - 1]) / (time_[i] - time_[i - 1]);
}

}  // namespace titin
