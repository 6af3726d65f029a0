#include "materials/weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text_file.hpp"
#include "base/units.hpp"

namespace titin {
namespace {

using Json = nlohmann::json;

/// Numbers of a JSON value: a text with its unit, or a list of pure numbers.
units::Parsed numbers(const Json& value, std::string_view unit) {
  if (value.is_string()) return units::parse(value.get<std::string>(), std::string(unit));
  units::Parsed parsed;
  if (!unit.empty()) {
    parsed.problem = "has no unit";
    parsed.advice = fmt::format("write it as a text such as \"1, 2 {}\"", unit);
  } else if (!value.is_array() || !std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); }))
    parsed.problem = "is no list of numbers";
  else
    parsed.values = value.get<std::vector<double>>();
  return parsed;
}

}  // namespace

Weights::Weights(Section& s) : section_(s) {
  s.read("file", file_, {.doc = "JSON file with the lists below, instead of the scene"});
  const std::string path = s.existing_file("file", file_);
  if (path.empty()) {
    file_.clear();
    return;
  }
  text_ = read_text_file(path).text;
  if (!Json::accept(text_) || !Json::parse(text_).is_object()) {
    s.error("file", fmt::format("\"{}\" is not a JSON object", file_), "write { \"name of a list\": [numbers], ... }");
    text_ = "{}";
  }
}

void Weights::read(const char* name, std::vector<double>& value, const Key& key) {
  if (file_.empty()) return section_.read(name, value, key);
  if (section_.has(name)) {
    section_.read(name, value, key);
    return section_.error(name, fmt::format("\"{}\" has the lists", file_), "drop this key, or the file");
  }
  read_from_file(name, value, key);
}

void Weights::read_from_file(const char* name, std::vector<double>& value, const Key& key) {
  const Json lists = Json::parse(text_);
  const auto problem = [&](const std::string& what, const std::string& advice) {
    section_.error("file", fmt::format("\"{}\" of \"{}\" {}", name, file_, what), advice);
  };
  if (!lists.contains(name)) {
    if (key.required) problem("is missing", fmt::format("add {}: {}", name, key.doc));
    return;
  }
  const units::Parsed parsed = numbers(lists[name], key.unit);
  if (!parsed.ok()) return problem(parsed.problem, parsed.advice);
  if (key.size >= 0 && static_cast<int>(parsed.values.size()) != key.size)
    return problem(fmt::format("has {} values", parsed.values.size()), fmt::format("give {}", key.size));
  for (double x : parsed.values)
    if (!key.range.contains(x))
      return problem(fmt::format("holds {:g}, out of range", x), "allowed is " + key.range.text());
  value = parsed.values;
}

}  // namespace titin
