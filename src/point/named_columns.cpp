#include "point/named_columns.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/units.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

NamedColumn named(std::string_view head) {
  const auto open = head.find('[');
  if (open == std::string_view::npos || head.back() != ']') return {std::string(trim(head)), "", {}};
  const std::string_view unit = head.substr(open + 1, head.size() - open - 2);
  return {std::string(trim(head.substr(0, open))), std::string(trim(unit)), {}};
}

bool add_row(std::string_view line, std::vector<NamedColumn>& columns) {
  const auto fields = split(line, ',');
  if (fields.size() != columns.size()) return false;
  for (std::size_t c = 0; c < fields.size(); ++c) {
    const std::string_view field = trim(fields[c]);
    double x = 0;
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), x);
    if (status != std::errc() || end != field.data() + field.size() || !std::isfinite(x)) return false;
    columns[c].values.push_back(x);
  }
  return true;
}

}  // namespace

const NamedColumn* NamedColumns::find(const std::string& name) const {
  for (const NamedColumn& c : columns)
    if (c.name == name) return &c;
  return nullptr;
}

NamedColumns parse_named_columns(const std::string& text) {
  NamedColumns table;
  int number = 0;
  for (std::string_view line : split(text, '\n')) {
    ++number;
    line = trim(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    if (table.columns.empty()) {
      for (std::string_view head : split(line, ',')) table.columns.push_back(named(trim(head)));
    } else if (!add_row(line, table.columns)) {
      table.problem = fmt::format("line {} is no row of {} numbers", number, table.columns.size());
      return table;
    }
  }
  if (table.columns.empty() || table.columns.front().values.empty()) table.problem = "holds no rows of numbers";
  return table;
}

std::vector<double> in_si(const NamedColumn& column, const std::string& si, std::string& problem) {
  const units::Parsed unit = column.unit.empty() ? units::Parsed{} : units::parse("1 " + column.unit, si);
  if (column.unit.empty() != si.empty())
    problem = fmt::format("column {} needs {}", column.name,
                          si.empty() ? "no unit" : fmt::format("its unit, such as \"{} [{}]\"", column.name, si));
  else if (!unit.ok())
    problem = fmt::format("column {}: {}", column.name, unit.problem);
  std::vector<double> values = column.values;
  if (problem.empty() && !si.empty())
    for (double& x : values) x *= unit.values.front();
  return values;
}

}  // namespace titin
