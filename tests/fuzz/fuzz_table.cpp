// A table that is accepted has columns of one length, all of them finite.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/text_file.hpp"
#include "fuzz/targets.hpp"

namespace titin {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

void try_columns(NumberTable table) {
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const auto& values = table.columns[k].values;
    if (values.size() != table.lines.size() || !all_finite(values)) std::abort();
    time_problem(table, k);
    convert_column(table, k, "Pa");
    column_advice(table, table.columns[k].name + "x");
  }
}

void try_two(const std::string& bytes, const std::string& column) {
  const Columns two = parse_columns(bytes, "Pa", column);
  if (!two.problem.empty()) return;
  if (two.time.empty() || two.time.size() != two.value.size()) std::abort();
  if (!all_finite(two.time) || !all_finite(two.value)) std::abort();
  if (std::adjacent_find(two.time.begin(), two.time.end(), std::greater_equal<>()) != two.time.end()) std::abort();
}

}  // namespace

void fuzz_table(const std::string& bytes) {
  const NumberTable table = parse_numbers(bytes);
  if (table.problem.empty()) try_columns(table);
  try_two(bytes, "");
  try_two(bytes, "stress");
}

}  // namespace titin
