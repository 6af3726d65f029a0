#include "base/text_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/digest.hpp"
#include "base/parallel.hpp"
#include "base/units.hpp"
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

/// A piece of the head: name, or name [unit]; maybe in quotation marks.
NumberTable::Column heading(std::string_view piece) {
  std::string text(trim(piece));
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
    for (std::size_t at = 0; (at = text.find("\"\"", at)) != std::string::npos; ++at) text.erase(at, 1);
  }
  const auto open = text.rfind('[');
  if (open == std::string::npos || text.back() != ']') return {text, "", {}};
  return {std::string(trim(text.substr(0, open))), text.substr(open + 1, text.size() - open - 2), {}};
}

/// The head's pieces: parted by commas, or if there is none by white space outside of brackets.
std::vector<NumberTable::Column> headings(std::string_view line) {
  const bool by_commas = line.find(',') != std::string_view::npos;
  std::vector<NumberTable::Column> columns;
  std::string piece;
  char inside = 0;  // of quotation marks or brackets
  const auto add = [&] {
    const std::string text(trim(piece));
    if (!by_commas && !columns.empty() && text.starts_with('['))
      columns.back() = heading(columns.back().name + " " + text);  // "t [ms]": the gap parts no columns
    else if (by_commas || !text.empty())
      columns.push_back(heading(text));
    piece.clear();
  };
  for (const char c : line) {
    const bool gap = by_commas ? c == ',' : c == ' ' || c == '\t' || c == '\r';
    if (c == inside)
      inside = 0;
    else if (inside == 0 && (c == '"' || c == '['))
      inside = c == '[' ? ']' : c;
    if (gap && inside == 0)
      add();
    else
      piece += c;
  }
  add();
  return columns;
}

bool names_units(const std::vector<NumberTable::Column>& columns) {
  return std::any_of(columns.begin(), columns.end(), [](const auto& column) { return !column.unit.empty(); });
}

/// Adds one line; says what is wrong with it.
std::string add_row(const std::vector<std::string_view>& words, NumberTable& table, int line) {
  if (words.size() != table.columns.size())
    return fmt::format("line {}: has {}, not {} as line {}", line, count(words.size(), "number"), table.columns.size(),
                       table.lines.front());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = number(words[i]);
    if (!value || !std::isfinite(*value))
      return fmt::format("line {}: {} is not a finite number", line, in_quotes(words[i]));
    table.columns[i].values.push_back(*value);
  }
  return "";
}

/// Lines of the preface of a storage or motion file, "endheader" included; 0 for other files.
int skip_preface(const std::vector<std::string_view>& rows, bool& in_degrees) {
  const auto end = std::find_if(rows.begin(), rows.end(), [](auto row) { return trim(row) == "endheader"; });
  if (end == rows.end()) return 0;
  in_degrees = std::any_of(rows.begin(), end, [](auto row) { return trim(row) == "inDegrees=yes"; });
  return static_cast<int>(end - rows.begin()) + 1;
}

/// The first row: as many columns as it has numbers, named by the head if that has as many.
std::string begin(NumberTable& table, std::vector<NumberTable::Column> head, std::size_t columns) {
  if (head.size() != columns && names_units(head) && table.head > 0)
    return fmt::format("line {}: heads {}, and {} follow", table.head, count(head.size(), "column"), columns);
  if (head.size() != columns) head.assign(columns, {});
  table.columns = std::move(head);
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

std::string file_digest(const std::string& path) {
  Digest digest;
  std::ifstream in(is_root() ? path : "", std::ios::binary);
  std::vector<char> part(1 << 16);
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0)
    digest.add(std::string_view(part.data(), in.gcount()));
  return broadcast(fmt::format("file {:016x}", digest.value()));
}

std::string file_problem(const std::string& path) { return broadcast(is_root() ? problem_here(path) : ""); }

NumberTable parse_numbers(const std::string& text) {
  NumberTable table;
  std::vector<NumberTable::Column> head;
  const auto rows = split(text, '\n');
  const int begin_of_table = skip_preface(rows, table.in_degrees);
  for (int line = begin_of_table + 1; line <= static_cast<int>(rows.size()); ++line) {
    const std::string_view row = rows[line - 1];
    const auto words = columns_of(row);
    const bool is_comment = words.empty() && row.find('#') != std::string_view::npos;
    if (table.columns.empty() && is_comment && table.head == 0) {
      auto said = headings(row.substr(row.find('#') + 1));
      if (names_units(said)) head = std::move(said);
    }
    if (words.empty()) continue;
    if (table.columns.empty() && table.head == 0 && !number(words.front())) {
      head = headings(row.substr(0, row.find('#')));
      table.head = line;
      continue;
    }
    if (table.lines.empty()) table.problem = begin(table, std::move(head), words.size());
    table.lines.push_back(line);
    if (table.problem.empty()) table.problem = add_row(words, table, line);
    if (!table.problem.empty()) return table;
  }
  if (table.lines.empty()) table.problem = "holds no numbers";
  return table;
}

std::string convert_column(NumberTable& table, std::size_t column, const std::string& si) {
  auto& [name, unit, values] = table.columns[column];
  if (unit.empty() || unit == "-") return "";
  const std::string problem = units::convert(values, unit, si);
  return problem.empty() ? "" : fmt::format("column {}: {}", in_quotes(name), problem);
}

std::string time_problem(const NumberTable& table, std::size_t column) {
  const std::vector<double>& time = table.columns[column].values;
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] <= time[i - 1])
      return fmt::format("line {}: time {} s does not come after {} s of line {}", table.lines[i], time[i], time[i - 1],
                         table.lines[i - 1]);
  return "";
}

int find_column(const NumberTable& table, std::string_view name) {
  const auto named = [&](const auto& column) { return column.name == name; };
  const auto it = std::find_if(table.columns.begin(), table.columns.end(), named);
  return it == table.columns.end() ? -1 : static_cast<int>(it - table.columns.begin());
}

std::string column_advice(const NumberTable& table, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& column : table.columns)
    if (!column.name.empty()) names.push_back(column.name);
  if (names.empty()) return "head the columns with their names";
  const std::string meant = nearest(name, names);
  const std::string has = "it has: " + printable(fmt::format("{}", fmt::join(names, ", ")));
  return meant.empty() ? has : fmt::format("did you mean \"{}\"? {}", meant, has);
}

namespace {

/// Columns of the times and of the values; says what is wrong.
std::array<int, 2> choose_columns(const NumberTable& table, const std::string& name, Columns& columns) {
  int time = std::max({find_column(table, "time"), find_column(table, "t"), 0}), value = time == 0 ? 1 : 0;
  if (name.empty()) {
    if (table.columns.size() == 2) return {time, value};
    columns.problem = fmt::format("line {}: has {}, not two (time, value)", table.lines.front(),
                                  count(table.columns.size(), "column"));
    if (table.columns.size() > 2) columns.advice = "name the values: column = \"...\"; " + column_advice(table, "");
    return {};
  }
  value = find_column(table, name);
  if (value >= 0 && value != time) return {time, value};
  columns.problem = value == time ? fmt::format("column {} is that of the times", in_quotes(name))
                                  : fmt::format("no column {}", in_quotes(name));
  columns.advice = column_advice(table, name);
  return {};
}

}  // namespace

Columns parse_columns(const std::string& text, const std::string& value_unit, const std::string& column) {
  NumberTable table = parse_numbers(text);
  Columns columns{{}, {}, table.problem, "write two columns: time in s, increasing, and value"};
  if (!columns.problem.empty()) return columns;
  const auto chosen = choose_columns(table, column, columns);
  const std::string wanted[] = {"s", value_unit};
  for (int i = 0; i < 2 && columns.problem.empty(); ++i) {
    auto& unit = table.columns[chosen[i]].unit;
    if (i == 1 && unit.empty() && table.in_degrees && value_unit == "rad") unit = "degree";
    columns.problem = convert_column(table, chosen[i], wanted[i]);
    if (!columns.problem.empty())
      columns.advice =
          fmt::format("name the unit of {}, such as [{}]", units::noun(wanted[i]), wanted[i].empty() ? "%" : wanted[i]);
  }
  if (columns.problem.empty()) columns.problem = time_problem(table, chosen[0]);
  if (!columns.problem.empty()) return columns;
  columns.time = std::move(table.columns[chosen[0]].values);
  columns.value = std::move(table.columns[chosen[1]].values);
  return columns;
}

}  // namespace titin
