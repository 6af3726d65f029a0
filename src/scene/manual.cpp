#include "scene/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/log.hpp"
#include "base/words.hpp"
#include "io/run_contents.hpp"
#include "materials/registry.hpp"
#include "scene/scene.hpp"

namespace titin {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void print(std::string_view line) { logging::write(logging::Level::quiet, line); }

/// Columns as wide as their longest entry; the last one is free.
void print_table(const Rows& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
    print(trim(line + row.back()).empty() ? "" : line + row.back());
  }
}

std::string type_of(const KeyRecord& key) {
  if (!key.choices.empty()) return fmt::format("{}", fmt::join(key.choices, " | "));
  return key.unit.empty() ? key.type : fmt::format("{} [{}]", key.type, key.unit);
}

Rows table_of(const std::vector<KeyRecord>& keys) {
  Rows rows = {{"key", "type [unit]", "default", "range", "meaning"}};
  for (const KeyRecord& key : keys) {
    if (key.type == "table")
      rows.push_back({fmt::format("[{}]", key.path), "", "", "", key.doc});
    else
      rows.push_back({key.path, type_of(key), key.required ? "required" : key.default_value, key.range, key.doc});
  }
  return rows;
}

nlohmann::ordered_json json_of(const KeyRecord& key) {
  return {{"path", key.path},   {"type", key.type},         {"unit", key.unit},       {"default", key.default_value},
          {"range", key.range}, {"required", key.required}, {"choices", key.choices}, {"doc", key.doc}};
}

void print_law(const LawInfo& law) {
  print(fmt::format("{} ({})", law.name, law.kind));
  print(fmt::format("  {}", law.formula));
  print(fmt::format("  {}", law.source));
  if (!law.parameters.empty()) print_table(table_of(law.parameters));
  for (const ParameterSet& set : law.published)
    print(fmt::format("  {}: {} ({})", set.tissue, set.parameters, set.source));
  if (!law.unpublished.empty()) print(fmt::format("  no published set: {}", law.unpublished));
}

nlohmann::ordered_json json_of(const LawInfo& law) {
  nlohmann::ordered_json entry = {
      {"name", law.name}, {"kind", law.kind}, {"formula", law.formula}, {"source", law.source}};
  entry["parameters"] = entry["published"] = nlohmann::ordered_json::array();
  for (const KeyRecord& key : law.parameters) entry["parameters"].push_back(json_of(key));
  for (const ParameterSet& set : law.published)
    entry["published"].push_back({{"tissue", set.tissue}, {"parameters", set.parameters}, {"source", set.source}});
  entry["unpublished"] = law.unpublished;
  return entry;
}

}  // namespace

void print_keys(const std::string& prefix, bool json) {
  std::vector<KeyRecord> keys = scene_keys();
  std::erase_if(keys, [&](const KeyRecord& key) { return key.path.rfind(prefix, 0) != 0; });
  if (keys.empty()) throw InputError({fmt::format("no key begins with {}; titin keys lists all", in_quotes(prefix))});
  if (!json) return print_table(table_of(keys));
  auto list = nlohmann::ordered_json::array();
  for (const KeyRecord& key : keys) list.push_back(json_of(key));
  print(list.dump(2));
}

void print_materials(const std::string& name, bool json) {
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const LawInfo& law : laws())
      if (name.empty() || law.name == name) list.push_back(json_of(law));
    if (!list.empty()) return print(list.dump(2));
  }
  Rows rows = {{"law", "kind", "formula"}};
  std::vector<std::string> names;
  for (const LawInfo& law : laws()) {
    if (law.name == name) return print_law(law);
    rows.push_back({law.name, law.kind, law.formula});
    names.push_back(law.name);
  }
  if (name.empty()) return print_table(rows);
  const std::string meant = nearest(name, names);
  throw InputError({fmt::format("there is no law {}; {}", in_quotes(name),
                                meant.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                                              : fmt::format("did you mean \"{}\"?", meant))});
}

void print_run(const std::string& folder) {
  const RunContents contents = read_run_contents(folder);
  Rows rows;
  for (const auto& [what, text] : contents.facts) rows.push_back({what, text});
  print(fmt::format("{}: a run of Titin", printable(folder)));
  print_table(rows);
  if (contents.history.rows == 0) return;
  rows = {{"column of history.csv", "first", "last", "least", "largest"}};
  for (const HistoryColumn& c : contents.history.columns)
    rows.push_back({c.name, fmt::format("{:.6g}", c.first), fmt::format("{:.6g}", c.last),
                    fmt::format("{:.6g}", c.least), fmt::format("{:.6g}", c.largest)});
  print("");
  print_table(rows);
}

}  // namespace titin
