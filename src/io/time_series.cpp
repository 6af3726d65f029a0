#include "io/time_series.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <filesystem>
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

std::string head_of(const std::vector<Column>& columns) {
  std::vector<std::string> header;
  for (const Column& c : columns) header.push_back(csv_field(c.unit.empty() ? c.name : c.name + " [" + c.unit + "]"));
  return fmt::format("{}", fmt::join(header, ","));
}

/// Leaves `rows` rows below the head of a file, or says why that is impossible.
std::string cut_off(const std::string& path, const std::string& head, long rows) {
  std::ifstream in(path);
  std::string line;
  std::uintmax_t size = 0;
  if (!std::getline(in, line)) return "is not there, or empty";
  if (line != head) return "has other columns than this scene gives";
  size += line.size() + 1;
  for (long row = 0; row < rows; ++row) {
    if (!std::getline(in, line) || in.eof())
      return fmt::format("has {} rows, and the checkpoint was written after {}", row, rows);
    size += line.size() + 1;
  }
  std::error_code error;
  std::filesystem::resize_file(path, size, error);
  return error ? "cannot be written: " + error.message() : "";
}

}  // namespace

TimeSeries::TimeSeries(const std::string& path, const std::vector<Column>& columns)
    : path_(path), columns_(columns.size()) {
  if (!is_root()) return;
  out_.open(path);
  out_ << head_of(columns) << '\n' << std::flush;
  if (!out_) throw OutputError(path);
}

TimeSeries::TimeSeries(const std::string& path, const std::vector<Column>& columns, long rows)
    : path_(path), columns_(columns.size()), rows_(rows) {
  const std::string problem = broadcast(is_root() ? cut_off(path, head_of(columns), rows) : "");
  if (!problem.empty()) throw std::runtime_error(fmt::format("{} {}", path, problem));
  if (is_root()) out_.open(path, std::ios::app);
  if (is_root() && !out_) throw OutputError(path);
}

void TimeSeries::sync() const {
  if (!is_root()) return;
  const int file = ::open(path_.c_str(), O_RDONLY);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  if (file >= 0) ::close(file);
  if (!synced) throw OutputError(path_);
}

void TimeSeries::add(const std::vector<double>& row) {
  ++rows_;
  if (!is_root()) return;
  if (row.size() != columns_)
    throw std::logic_error(fmt::format("{}: {} values for {} columns", path_, row.size(), columns_));
  out_ << fmt::format("{}\n", fmt::join(row, ",")) << std::flush;
  if (!out_) throw OutputError(path_);
}

}  // namespace titin
