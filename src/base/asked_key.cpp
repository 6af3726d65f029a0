#include "base/asked_key.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

/// What a line with this key may look like.
std::string sample(const std::string& type, const Key& key, const std::vector<std::string>& choices) {
  if (!choices.empty()) return in_quotes(choices.front());
  if (type == "true or false") return "true";
  if (type == "text") return "\"...\"";
  if (type == "list of text") return "[\"...\"]";
  const std::string one = type.find("whole") != std::string::npos ? "1" : units::example(key.unit);
  const auto gap = std::min(one.find(' '), one.size());
  std::string all = one.substr(0, gap);
  for (int i = 1; i < key.size; ++i) all += ", " + one.substr(0, gap);
  if (!key.unit.empty()) return '"' + all + one.substr(gap) + '"';
  return key.size < 0 ? all : '[' + all + ']';
}

std::string allowed(const Key& key) {
  return fmt::format("allowed: {}{}{}", key.range.text(), key.unit.empty() ? "" : " ", key.unit);
}

/// A bare TOML number; only a pure number may be one.
Numbers bare_number(const AskedKey& asked, const toml::node& node) {
  const double x = node.value<double>().value_or(0);
  const std::string unit(asked.key.unit);
  if (!std::isfinite(x))
    asked.complain(fmt::format("{} is not a finite number", shown(node)),
                   fmt::format("write {}, such as {}", units::noun(unit), sample("number", {.unit = unit}, {})));
  else if (!unit.empty())
    asked.complain(fmt::format("{} has no unit", shown(node)),
                   fmt::format("write {} with its unit, such as \"{}\"", units::noun(unit), units::example(unit)));
  else
    return {{x}};
  return std::nullopt;
}

Numbers numbers_of(const AskedKey& asked, const toml::node& node) {
  if (node.is_number()) return bare_number(asked, node);
  if (const auto* text = node.as_string()) {
    units::Parsed parsed = units::parse(text->get(), std::string(asked.key.unit));
    if (parsed.ok()) return std::move(parsed.values);
    asked.complain(parsed.problem, parsed.advice);
    return std::nullopt;
  }
  asked.complain(fmt::format("{} is no number", shown(node)),
                 fmt::format("write {}, such as {}", units::noun(asked.key.unit), sample("number", asked.key, {})));
  return std::nullopt;
}

}  // namespace

void AskedKey::complain(const std::string& problem, const std::string& advice) const {
  scene.complain(table, name, problem, advice);
}

void AskedKey::keep(const std::string& value) const { scene.keep({table, name, value, node != nullptr}); }

std::string shown(const toml::node& node) {
  if (const auto* s = node.as_string()) return in_quotes(s->get());
  if (const auto* i = node.as_integer()) return fmt::format("{}", i->get());
  if (const auto* x = node.as_floating_point()) return fmt::format("{}", x->get());
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  return node.is_table() ? "a table" : node.is_array() ? "a list" : "a date or time of day";
}

bool AskedKey::can_be_said(const std::vector<double>& values) const {
  return node || std::all_of(values.begin(), values.end(), [&](double x) { return key.range.contains(x); });
}

void AskedKey::keep_numbers(const std::vector<double>& values, bool list) const {
  const bool is_no_list = !node && values.empty();  // none by default: not what a scene may say
  keep(can_be_said(values) && !is_no_list ? toml_numbers(values, key.unit, list) : "");
}

AskedKey ask(SceneText& scene, const std::string& table, std::string_view name, const Key& key, const std::string& type,
             const std::string& default_value, const std::vector<std::string>& choices) {
  scene.ask(table, name);
  AskedKey asked{scene, table, std::string(name), key, scene.find(table, name)};
  const std::string path = join_path(table, name);
  scene.record({path, type, std::string(key.unit), key.required ? "" : default_value, key.range.text(),
                std::string(key.doc), key.required, choices});
  if (!asked.node && key.required) {
    std::string text = "missing";
    if (!key.doc.empty()) text += fmt::format(" ({})", key.doc);
    text += fmt::format("; add for example {} = {}", join_path("", name), sample(type, key, choices));
    if (!table.empty()) text += fmt::format(" to [{}]", table);
    scene.complain_missing(table, name, text);
  }
  return asked;
}

bool in_range(const AskedKey& asked, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (asked.key.range.contains(values[i])) continue;
    const std::string which = values.size() == 1
                                  ? shown(*asked.node)
                                  : fmt::format("entry {} ({})", i + 1, units::text(values[i], asked.key.unit));
    asked.complain(which + " is out of range", allowed(asked.key));
    return false;
  }
  return true;
}

Numbers numbers(const AskedKey& asked, int size) {
  Numbers all;
  if (const auto* list = asked.node->as_array(); list && size != 1) {
    all.emplace();
    for (const toml::node& entry : *list) {
      const Numbers some = numbers_of(asked, entry);
      if (!some) return std::nullopt;
      all->insert(all->end(), some->begin(), some->end());
    }
  } else {
    all = numbers_of(asked, *asked.node);
  }
  if (!all) return std::nullopt;
  if (size >= 0 && static_cast<int>(all->size()) != size) {
    asked.complain("has " + count(all->size(), "number"), fmt::format("give {}", size));
    return std::nullopt;
  }
  if (!in_range(asked, *all)) return std::nullopt;
  return all;
}

std::vector<int> whole_numbers(const AskedKey& asked, int size) {
  const Numbers all = numbers(asked, size);
  std::vector<int> whole;
  if (!all) return whole;
  if (all->empty()) asked.complain("has no number", "give some, or drop the key");
  for (const double x : *all) {
    if (x != std::floor(x) || std::abs(x) > std::numeric_limits<int>::max()) {
      asked.complain(fmt::format("{} is not a whole number", x), fmt::format("write one, such as {}", std::round(x)));
      return {};
    }
    whole.push_back(static_cast<int>(x));
  }
  return whole;
}

std::string toml_numbers(const std::vector<double>& values, std::string_view unit, bool list) {
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) return "";
  if (!unit.empty() && !values.empty()) return '"' + units::text(values, unit) + '"';
  return list ? fmt::format("[{}]", fmt::join(values, ", ")) : units::text(values, "");
}

}  // namespace titin
