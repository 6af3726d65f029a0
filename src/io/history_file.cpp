#include "io/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "base/words.hpp"

namespace titin {
namespace {

/// The fields of one line of CSV: quotation marks hold commas together and are doubled inside.
std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

/// False unless all of it is one number; "nan" and "inf" are.
bool read_number(const std::string& text, double& value) {
  const std::string_view trimmed = trim(text);
  const auto [end, status] = std::from_chars(trimmed.data(), trimmed.data() + trimmed.size(), value);
  return status == std::errc() && end == trimmed.data() + trimmed.size();
}

std::string add_row(HistoryFile& history, const std::string& line) {
  const std::vector<std::string> fields = csv_fields(line);
  if (fields.size() != history.columns.size())
    return fmt::format("{} for {}", count(static_cast<double>(fields.size()), "value"),
                       count(static_cast<double>(history.columns.size()), "column"));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    double value = 0;
    if (!read_number(fields[k], value)) return fmt::format("{} is no number", in_quotes(fields[k]));
    HistoryColumn& column = history.columns[k];
    if (history.rows == 0) column.first = column.least = column.largest = value;
    column.last = value;
    column.least = std::min(column.least, value);
    column.largest = std::max(column.largest, value);
  }
  ++history.rows;
  return "";
}

}  // namespace

HistoryFile read_history_file(const std::string& path) {
  HistoryFile history;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) {
    history.problem = "is empty, or cannot be read";
    return history;
  }
  for (const std::string& name : csv_fields(line)) history.columns.push_back({printable(name)});
  for (long number = 2; std::getline(file, line); ++number) {
    const std::string problem = add_row(history, line);
    if (problem.empty()) continue;
    history.problem = fmt::format("line {}: {}", number, problem);
    break;
  }
  return history;
}

}  // namespace titin
