// SpatialField from a scene: { field = "file.csv", column = "mu" }.
#include <fmt/format.h>

#include <algorithm>

#include "base/text_file.hpp"
#include "base/words.hpp"
#include "materials/spatial_field.hpp"

namespace titin {
namespace {

const std::vector<std::string> axes{"x", "y", "z"};

std::string columns_of_values(std::size_t n) { return count(static_cast<double>(n), "column") + " of values"; }

/// One table {field, ...} while it is read.
class FieldTable {
 public:
  explicit FieldTable(Section table) : table_(std::move(table)) {
    table_.read("field", file_,
                {.required = true, .doc = "columns x, y, z (in m, or headed by their unit) and values"});
  }

  std::shared_ptr<const SpatialField> number(const Key& key) {
    std::string column;
    table_.read("column", column, {.doc = "name of the values' column where there are more than four"});
    read_options();
    data_.range = key.range;
    if (!read_file()) return nullptr;
    const std::vector<int> chosen = columns("column", column.empty() ? names() : std::vector<std::string>{column}, 1);
    return chosen.empty() ? nullptr : finish(chosen, std::string(key.unit));
  }

  std::shared_ptr<const SpatialField> directions() {
    std::vector<std::string> wanted;
    table_.read("columns", wanted, {.doc = "names of the three columns of directions where there are more than six"});
    read_options();
    data_.directions = true;
    if (!read_file()) return nullptr;
    const std::vector<int> chosen = columns("columns", wanted.empty() ? names() : wanted, 3);
    return chosen.empty() ? nullptr : finish(chosen, "");
  }

 private:
  using Between = SpatialField::Between;
  using At = SpatialField::At;

  void read_options() {
    table_.choose("between", data_.between, {{"linear", Between::linear}, {"nearest", Between::nearest}},
                  {.doc = "between the places: a plane through the nearest ones, or the nearest one's value"});
    table_.choose("at", data_.at, {{"points", At::points}, {"cells", At::cells}},
                  {.doc = "evaluated at every quadrature point, or once for a cell at its centre"});
    table_.read("reach", data_.reach,
                {.unit = "m",
                 .range = non_negative,
                 .doc = "farther from all places nothing is known; 0 takes three times the places' spacing"});
  }

  bool read_file() {
    const std::string path = table_.existing_file("field", file_);
    if (path.empty()) return false;
    const TextFile text = read_text_file(path);
    numbers_ = parse_numbers(text.text);
    const std::string problem = text.problem.empty() ? numbers_.problem : text.problem;
    if (!problem.empty()) complain("field", problem, "write columns x, y, z and values under their names");
    return problem.empty() && read_places();
  }

  bool read_places() {
    data_.places.resize(numbers_.lines.size());
    for (int d = 0; d < 3; ++d) {
      const int column = find_column(numbers_, axes[d]);
      if (column < 0) {
        complain("field", "no column " + in_quotes(axes[d]), "head the places' columns x, y, z; " + has());
        return false;
      }
      if (!to_si(column, "m")) return false;
      for (std::size_t i = 0; i < data_.places.size(); ++i) data_.places[i][d] = numbers_.columns[column].values[i];
    }
    return true;
  }

  /// Of the columns that are not the places'.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& column : numbers_.columns)
      if (!std::count(axes.begin(), axes.end(), column.name)) names.push_back(column.name);
    return names;
  }

  std::vector<int> columns(const char* key, const std::vector<std::string>& wanted, std::size_t size) {
    std::vector<int> chosen;
    if (wanted.size() != size)
      complain(table_.has(key) ? key : "field", fmt::format("has {}, not {}", columns_of_values(wanted.size()), size),
               fmt::format("name {}: {} = {}; {}", size == 1 ? "it" : "them", key,
                           size == 1 ? "\"...\"" : "[\"...\", \"...\", \"...\"]", has()));
    else
      for (const std::string& name : wanted) {
        chosen.push_back(find_column(numbers_, name));
        if (chosen.back() >= 0) continue;
        complain(key, "no column " + in_quotes(name), column_advice(numbers_, name));
        return {};
      }
    return chosen;
  }

  bool to_si(int column, const std::string& unit) {
    const std::string problem = convert_column(numbers_, column, unit);
    if (!problem.empty()) complain("field", problem, "correct the unit in the head of the column");
    return problem.empty();
  }

  std::shared_ptr<const SpatialField> finish(const std::vector<int>& chosen, const std::string& unit) {
    data_.values.assign(data_.places.size(), Vec3{});
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      if (!to_si(chosen[c], unit)) return nullptr;
      for (std::size_t i = 0; i < data_.values.size(); ++i) data_.values[i][c] = numbers_.columns[chosen[c]].values[i];
    }
    for (std::size_t i = 0; i < data_.values.size() && data_.directions; ++i)
      if (!(norm(data_.values[i]) > 0)) {
        complain("field", fmt::format("line {}: a fibre of zero length has no direction", numbers_.lines[i]),
                 "drop the line, or give the direction; any length but zero will do");
        return nullptr;
      }
    if (data_.places.size() == 1 && data_.reach == 0) {
      table_.error("reach", "one place has no spacing", "say how far from it the value holds, reach = \"1 m\", say");
      return nullptr;
    }
    auto field = std::make_shared<SpatialField>(std::move(data_));
    field->stands_in(table_, unit);
    return field;
  }

  std::string has() const { return column_advice(numbers_, ""); }
  void complain(const char* key, const std::string& problem, const std::string& advice) {
    table_.error(key, fmt::format("file {}: {}", in_quotes(file_), problem), advice);
  }

  Section table_;
  std::string file_;
  NumberTable numbers_;
  SpatialField::Data data_;
};

}  // namespace

std::shared_ptr<const SpatialField> SpatialField::read_number(Section table, const Key& key) {
  return FieldTable(std::move(table)).number(key);
}

std::shared_ptr<const SpatialField> SpatialField::read_directions(Section table) {
  return FieldTable(std::move(table)).directions();
}

}  // namespace titin
