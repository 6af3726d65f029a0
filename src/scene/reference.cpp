#include "scene/reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "base/words.hpp"
#include "scene/followed.hpp"

namespace titin {
namespace {

constexpr double same_time = 1e-9;  // of the time reached: round-off, not a time beyond the end

/// Trapezoidal weights of the first n times; one alone weighs 1.
std::vector<double> weights(const std::vector<double>& times, std::size_t n) {
  if (n == 1) return {1};
  std::vector<double> w(n, 0);
  for (std::size_t k = 1; k < n; ++k) {
    const double half = (times[k] - times[k - 1]) / 2;
    w[k - 1] += half;
    w[k] += half;
  }
  return w;
}

}  // namespace

void Reference::bind(Section& s) {
  s.read("history", file_,
         {.doc = "CSV with a column time [s] and others of history.csv, by name: run.json says how far off"});
  s.read("columns", wanted_, {.doc = "names of its columns that are compared (default: all)"});
  const std::string path = s.existing_file("history", file_);
  if (path.empty()) return;
  const TextFile file = read_text_file(path);
  std::string problem = file.problem;
  if (problem.empty()) table_ = parse_numbers(file.text), problem = table_.problem;
  const auto is_time = [](const auto& column) { return column.name == "time"; };
  const auto time = std::find_if(table_.columns.begin(), table_.columns.end(), is_time);
  if (problem.empty() && time == table_.columns.end()) problem = "has no column \"time\"";
  if (problem.empty()) {
    const std::size_t column = time - table_.columns.begin();
    problem = convert_column(table_, column, "s");
    if (problem.empty()) problem = time_problem(table_, column);
    times_ = time->values;
    table_.columns.erase(time);
    if (problem.empty() && table_.columns.empty()) problem = "has no column besides the time";
  }
  if (problem.empty()) keep_wanted(s);
  if (!problem.empty())
    s.error("history", fmt::format("file {}: {}", in_quotes(file_), problem),
            "write a first line of names, such as time [s], volume [m^3], and numbers below it");
}

void Reference::keep_wanted(Section& s) {
  if (wanted_.empty()) return;
  std::vector<std::string> names;
  for (const auto& column : table_.columns) names.push_back(column.name);
  for (const std::string& name : wanted_)
    if (std::find(names.begin(), names.end(), name) == names.end())
      s.error("columns", fmt::format("{} has no column {}", in_quotes(file_), in_quotes(name)),
              fmt::format("it has {}", fmt::join(names, ", ")));
  std::erase_if(table_.columns, [&](const auto& column) {
    return std::find(wanted_.begin(), wanted_.end(), column.name) == wanted_.end();
  });
}

void Reference::match(const std::vector<Quantity>& followed, Section s) {
  for (std::size_t c = 0; c < table_.columns.size(); ++c) {
    const std::string& name = table_.columns[c].name;
    const auto place = place_of(name, followed);
    if (!place) {
      s.error("history", fmt::format("file {}: this run follows no {}", in_quotes(file_), in_quotes(name)),
              meant_instead(name, followed));
      continue;
    }
    const std::size_t quantity = *place;
    const std::string& unit = followed[quantity].unit;
    if (const std::string problem = convert_column(table_, c, unit); !problem.empty())
      s.error("history", fmt::format("file {}: {}", in_quotes(file_), problem),
              fmt::format("this run has it in {}", unit));
    columns_.push_back({name, unit, quantity, table_.columns[c].values, {}});
  }
}

void Reference::add(double time, const std::vector<Quantity>& quantities) {
  if (columns_.empty()) return;
  run_times_.push_back(time);
  for (Column& column : columns_) column.values.push_back(quantities.at(column.quantity).value);
}

void Reference::walk(StateWalk& walk) {
  if (columns_.empty()) return;
  walk.common("reference_times", run_times_);
  for (std::size_t c = 0; c < columns_.size(); ++c)
    walk.common(fmt::format("reference_values_{}", c), columns_[c].values);
}

double Reference::largest(const std::string& unit, std::size_t rows) const {
  double value = 0;
  for (const Column& column : columns_)
    for (std::size_t k = 0; k < rows && column.unit == unit; ++k) value = std::max(value, std::abs(column.wanted[k]));
  return value > 0 ? value : 1;
}

std::map<std::string, double> Reference::errors() const {
  if (columns_.empty()) return {};
  const double end = run_times_.back() * (1 + same_time);
  const std::size_t rows = std::upper_bound(times_.begin(), times_.end(), end) - times_.begin();
  if (rows == 0) {
    logging::warning(fmt::format("{} has no times up to {:g} s: nothing is compared", file_, end));
    return {};
  }
  std::map<std::string, double> errors;
  for (const Column& column : columns_) {
    const Norms norms = compare(column, rows);
    errors[column.name + "_l2"] = norms.l2;
    errors[column.name + "_max"] = norms.max;
  }
  return errors;
}

Reference::Norms Reference::compare(const Column& column, std::size_t rows) const {
  const Table mine(run_times_, column.values);
  const std::vector<double> w = weights(times_, rows);
  double off = 0, size = 0, duration = 0, most_off = 0, most = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const double r = column.wanted[k], difference = mine(times_[k]) - r;
    off += w[k] * difference * difference;
    size += w[k] * r * r;
    duration += w[k];
    most_off = std::max(most_off, std::abs(difference));
    most = std::max(most, std::abs(r));
  }
  const double scale = largest(column.unit, rows);
  return {std::sqrt(off / (size > 0 ? size : duration * scale * scale)), most_off / (most > 0 ? most : scale)};
}

}  // namespace titin
