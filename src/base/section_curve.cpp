// Section::read for a Table: a constant, a curve in the scene, or a curve in a file of two columns.
#include <fmt/format.h>

#include <algorithm>

#include "base/asked_key.hpp"
#include "base/text_file.hpp"
#include "base/units.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

std::string toml_table(const Table& table, std::string_view unit) {
  if (table.is_constant()) return toml_numbers(table.value(), unit, false);
  return fmt::format("{{time = {}, value = {}}}", toml_numbers(table.time(), "s", true),
                     toml_numbers(table.value(), unit, true));
}

/// The curve in a table {time, value} or {file}, both with an optional scale.
class Curve {
 public:
  Curve(const AskedKey& asked, Section section) : asked_(asked), section_(std::move(section)) {}

  std::optional<Table> read() {
    const bool has_file = section_.has("file"), has_points = section_.has("time") || section_.has("value");
    if (has_file == has_points) {
      asked_.complain(has_file ? "has both a file and points" : "has no points", "give either time and value, or file");
      for (const char* name : {"time", "value", "file", "column", "scale"}) asked_.scene.ask(section_.path(), name);
      return std::nullopt;
    }
    const bool has_scale = section_.has("scale");
    double scale = 1;
    section_.read("scale", scale, {.unit = asked_.key.unit});
    std::vector<double> time, value;
    const std::string unit(has_scale ? "" : asked_.key.unit);
    if (!(has_file ? read_file(time, value, unit) : read_points(time, value, unit))) return std::nullopt;
    for (double& v : value) v *= scale;
    if (!in_range(asked_, value)) return std::nullopt;
    return Table(std::move(time), std::move(value));
  }

 private:
  bool read_points(std::vector<double>& time, std::vector<double>& value, const std::string& unit) {
    section_.read("time", time, {.unit = "s", .required = true, .doc = "times of the curve"});
    section_.read("value", value, {.unit = unit, .required = true, .doc = "values at these times"});
    if (time.empty() || value.empty()) return false;
    const auto wrong = std::adjacent_find(time.begin(), time.end(), [](double a, double b) { return b <= a; });
    if (wrong != time.end())
      section_.error("time",
                     fmt::format("does not increase: entry {} ({} s) follows {} s", wrong - time.begin() + 2,
                                 *(wrong + 1), *wrong),
                     "sort the times, each once");
    else if (time.size() != value.size())
      asked_.complain(fmt::format("has {} times and {} values", time.size(), value.size()),
                      "give a value for each time");
    else
      return true;
    return false;
  }

  bool read_file(std::vector<double>& time, std::vector<double>& value, const std::string& unit) {
    std::string file, column;
    section_.read("file", file, {.doc = "columns of time in s and values, or headed by their units: t [ms], u [mm]"});
    section_.read("column", column, {.doc = "name of the values' column where there are more than two"});
    const std::string path = section_.existing_file("file", file);
    if (path.empty()) return false;
    const TextFile text = read_text_file(path);
    Columns columns = parse_columns(text.text, unit, column);
    const std::string problem = text.problem.empty() ? columns.problem : text.problem;
    if (!problem.empty()) section_.error("file", fmt::format("file {}: {}", in_quotes(file), problem), columns.advice);
    time = std::move(columns.time);
    value = std::move(columns.value);
    return problem.empty();
  }

  const AskedKey& asked_;
  Section section_;
};

}  // namespace

void Section::read(std::string_view name, Table& value, Key key) {
  const std::string default_value = value.is_constant() ? units::text(value.value().front(), key.unit) : "a curve";
  const AskedKey asked = ask(*scene_, path_, name, key, "number or curve in time", default_value);
  if (asked.node && asked.node->is_table()) {
    Section curve = section(name);
    if (auto table = Curve(asked, curve).read()) value = std::move(*table);
    scene_->forget(curve.path());
  } else if (asked.node) {
    if (const Numbers x = numbers(asked, 1)) value = Table(x->front());
  }
  asked.keep(asked.can_be_said(value.value()) ? toml_table(value, key.unit) : "");
}

}  // namespace titin
