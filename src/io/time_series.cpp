#include "io/time_series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "base/parallel.hpp"
#include "io/output_error.hpp"

namespace titin {
namespace {

/// CSV quotes a field that holds a comma, a quotation mark or a line break, and doubles the quotation marks in it.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

}  // namespace

TimeSeries::TimeSeries(const std::string& path, const std::vector<Column>& columns)
    : path_(path), columns_(columns.size()) {
  if (!is_root()) return;
  out_.open(path);
  std::vector<std::string> header;
  for (const Column& c : columns) header.push_back(csv_field(c.unit.empty() ? c.name : c.name + " [" + c.unit + "]"));
  out_ << fmt::format("{}\n", fmt::join(header, ",")) << std::flush;
  if (!out_) throw OutputError(path);
}

void TimeSeries::add(const std::vector<double>& row) {
  if (!is_root()) return;
  if (row.size() != columns_)
    throw std::logic_error(fmt::format("{}: {} values for {} columns", path_, row.size(), columns_));
  out_ << fmt::format("{}\n", fmt::join(row, ",")) << std::flush;
  if (!out_) throw OutputError(path_);
}

}  // namespace titin
