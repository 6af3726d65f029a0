#include "base/text_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/parallel.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

constexpr std::uintmax_t largest_file = 16u << 20;  // bytes: a scene is some kilobytes; larger is another kind of file

namespace fs = std::filesystem;

std::string problem_here(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) return "is not there";
  if (fs::is_directory(status)) return "is a folder, not a file";
  if (!fs::is_regular_file(status)) return "is not a regular file";
  return "";
}

TextFile read_here(const std::string& path) {
  if (const std::string problem = problem_here(path); !problem.empty()) return {"", problem};
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) return {"", "cannot be read: " + error.message()};
  if (size > largest_file) return {"", fmt::format("has {} MB; more than 16 MB is no such text", size >> 20)};
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || (size > 0 && !(text << in.rdbuf()))) return {"", "cannot be read; look at its permissions"};
  return {text.str(), ""};
}

std::vector<std::string_view> columns_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  constexpr std::string_view gaps = " \t\r,";
  std::vector<std::string_view> columns;
  for (auto start = line.find_first_not_of(gaps); start != std::string_view::npos;) {
    const auto end = line.find_first_of(gaps, start);
    columns.push_back(line.substr(start, end - start));
    start = end == std::string_view::npos ? end : line.find_first_not_of(gaps, end);
  }
  return columns;
}

std::optional<double> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double x = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), x);
  if (status != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return x;
}

/// Adds one line; says what is wrong with it.
std::string add_line(const std::vector<std::string_view>& columns, Columns& table, int& last_line, int line) {
  if (columns.size() != 2)
    return fmt::format("has {} column{}, not two (time, value)", columns.size(), columns.size() == 1 ? "" : "s");
  double x[2];
  for (int i = 0; i < 2; ++i) {
    const auto value = number(columns[i]);
    if (!value || !std::isfinite(*value)) return fmt::format("{} is not a finite number", in_quotes(columns[i]));
    x[i] = *value;
  }
  if (!table.time.empty() && x[0] <= table.time.back())
    return fmt::format("time {} s does not come after {} s of line {}", x[0], table.time.back(), last_line);
  table.time.push_back(x[0]);
  table.value.push_back(x[1]);
  last_line = line;
  return "";
}

}  // namespace

TextFile read_text_file(const std::string& path) {
  TextFile file;
  if (is_root()) file = read_here(path);
  file.problem = broadcast(file.problem);
  file.text = broadcast(file.text);
  return file;
}

std::string file_problem(const std::string& path) { return broadcast(is_root() ? problem_here(path) : ""); }

Columns parse_columns(const std::string& text) {
  Columns table;
  int line = 0, last_line = 0;
  bool may_be_names = true;
  for (const std::string_view row : split(text, '\n')) {
    ++line;
    const auto columns = columns_of(row);
    if (columns.empty()) continue;
    const bool names = may_be_names && !number(columns.front());
    may_be_names = false;
    if (names) continue;
    const std::string problem = add_line(columns, table, last_line, line);
    if (!problem.empty()) return {{}, {}, fmt::format("line {}: {}", line, problem)};
  }
  if (table.time.empty()) table.problem = "holds no numbers";
  return table;
}

}  // namespace titin
