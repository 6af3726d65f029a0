#include "base/scene_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "base/scene_override.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

bool is_bare(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
  });
}

bool is_below(const std::string& path, const std::string& table) {
  return path.size() > table.size() && path.compare(0, table.size(), table) == 0 && path[table.size()] == '.';
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::size_t most_messages = 50;

std::string place_text(const std::string& file, const Place& place) {
  if (place.command_line) return "command line";
  return place.line == 0 ? file : fmt::format("{}:{}:{}", file, place.line, place.column);
}

Place place_of(const toml::source_region& source) { return {false, source.begin.line, source.begin.column}; }

std::string message(const std::string& file, const Place& place, const std::string& path, const std::string& text) {
  return fmt::format("{}: {}{}{}", place_text(file, place), path, path.empty() ? "" : ": ", text);
}

}  // namespace

std::string join_path(const std::string& table, std::string_view name) {
  const bool placeholder = !name.empty() && name.front() == '<' && name.back() == '>';  // of titin keys
  return fmt::format("{}{}{}", table, table.empty() ? "" : ".",
                     is_bare(name) || placeholder ? std::string(name) : toml_string(name));
}

void SceneText::parse(const std::string& text, const std::vector<std::string>& overrides) {
  if (const int line = line_of_deep_key(text))
    throw InputError(
        {fmt::format("{}:{}: a key with more than {} dots; name tables less deeply", file, line, deepest_key)});
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError({message(file, place_of(error.source()), "",
                              fmt::format("not valid TOML: {}; correct this line", error.description()))});
  }
  std::vector<std::string> problems;
  for (const std::string& setting : overrides) try {
      if (const std::string path = override_with(root, setting); !path.empty()) overridden.insert(path);
    } catch (const InputError& error) {
      problems.push_back(error.messages().front());
    }
  if (!problems.empty()) throw InputError(problems);
  walk("", &root);
}

const toml::node* SceneText::find(const std::string& table, std::string_view name) const {
  const auto it = tables.find(table);
  return it == tables.end() ? nullptr : it->second->get(name);
}

bool SceneText::from_command_line(const std::string& path) const {
  return std::any_of(overridden.begin(), overridden.end(),
                     [&](const std::string& set) { return path == set || is_below(path, set); });
}

Place SceneText::place(const std::string& table, std::string_view name) const {
  std::string path = name.empty() ? table : join_path(table, name);
  if (from_command_line(path)) return {true, 0, 0};
  const toml::node* node = name.empty() ? nullptr : find(table, name);
  if (const auto it = tables.find(table); !node && it != tables.end() && !table.empty()) {
    node = it->second;
    path = table;
  }
  if (!node) return {};
  const Place place = place_of(node->source());
  const auto is_inside = [&](const std::string& set) { return is_below(set, path); };
  const bool made_by_override = place.line == 0 && std::any_of(overridden.begin(), overridden.end(), is_inside);
  return {made_by_override, place.line, place.column};
}

void SceneText::complain(const std::string& table, std::string_view name, const std::string& problem,
                         const std::string& advice) {
  if (describing) return;
  complaints.push_back({place(table, name), name.empty() ? table : join_path(table, name),
                        advice.empty() ? problem : fmt::format("{}; {}", problem, advice),
                        name.empty() ? Complaint::Of::table : Complaint::Of::key});
}

void SceneText::complain_missing(const std::string& table, std::string_view name, const std::string& text) {
  const std::string path = join_path(table, name);
  if (describing || std::any_of(not_tables.begin(), not_tables.end(), [&](auto& t) { return is_below(path, t); }))
    return;
  complaints.push_back({place(table, name), path, text, Complaint::Of::missing_key});
}

void SceneText::walk(const std::string& table, const toml::table* node) {
  if (!contains(walked, table)) walked.push_back(table);
  known[table];
  if (node) tables[table] = node;
}

void SceneText::ask(const std::string& table, std::string_view name) {
  auto& names = known[table];
  if (!contains(names, name)) names.emplace_back(name);
}

void SceneText::record(KeyRecord record) {
  const auto same = [&](const KeyRecord& r) {  // a key and a table may have one name: wall = true, [wall]
    return r.path == record.path && (r.type == "table") == (record.type == "table");
  };
  if (std::none_of(records.begin(), records.end(), same)) records.push_back(std::move(record));
}

void SceneText::keep(ResolvedKey key) {
  const auto same = [&](const ResolvedKey& k) { return k.table == key.table && k.name == key.name; };
  const auto it = std::find_if(resolved.begin(), resolved.end(), same);
  if (it == resolved.end())
    resolved.push_back(std::move(key));
  else
    *it = std::move(key);
}

void SceneText::forget(const std::string& table) {
  std::erase(walked, table);
  std::erase_if(resolved, [&](const ResolvedKey& key) { return key.table == table; });
  std::erase_if(records, [&](const KeyRecord& record) { return is_below(record.path, table); });
}

void SceneText::unknown(const std::string& table, const toml::key& key) {
  const std::string path = join_path(table, key.str());
  std::string meant = nearest(key.str(), known[table]), elsewhere, advice;
  if (!meant.empty()) {  // then that one is misspelt, not missing
    const std::string right = join_path(table, meant);
    std::erase_if(complaints, [&](const Complaint& c) {
      return c.what == Complaint::Of::missing_key && (c.path == right || is_below(c.path, right));
    });
  }
  for (const auto& [other, names] : known)
    if (contains(names, key.str())) elsewhere = join_path(other, key.str());
  if (!meant.empty())
    advice = fmt::format("did you mean \"{}\"?", meant);
  else if (!elsewhere.empty())
    advice = fmt::format("did you mean {}?", elsewhere);
  else if (!known[table].empty())
    advice = fmt::format("known here: {}", fmt::join(known[table], ", "));
  else
    advice = "remove it";
  const Place where = from_command_line(path) ? Place{true, 0, 0} : place_of(key.source());
  complaints.push_back({where, path, "unknown key; " + advice});
}

void SceneText::find_unknown(const std::string& table) {
  const auto it = tables.find(table);
  if (it == tables.end()) return;
  const std::vector<std::string> names = known[table];
  for (const auto& [key, node] : *it->second) {
    const std::string path = join_path(table, key.str());
    if (contains(names, key.str()))
      find_unknown(path);
    else if (!undecided.count(table))
      unknown(table, key);
  }
}

std::vector<std::string> SceneText::messages() const {
  auto sorted = complaints;
  // What a table lacks as a whole often only follows from a key in it that is wrong.
  std::erase_if(sorted, [&](const Complaint& table) {
    return table.what == Complaint::Of::table && std::any_of(complaints.begin(), complaints.end(), [&](auto& c) {
             return c.what == Complaint::Of::key && is_below(c.path, table.path) &&
                    c.path.find('.', table.path.size() + 1) == std::string::npos;
           });
  });
  std::stable_sort(sorted.begin(), sorted.end(), [](const Complaint& a, const Complaint& b) {
    return std::tie(a.place.command_line, a.place.line, a.place.column) <
           std::tie(b.place.command_line, b.place.line, b.place.column);
  });
  std::vector<std::string> texts;
  for (const Complaint& c : sorted) {
    if (texts.size() == most_messages) {
      texts.push_back(fmt::format("and {} more; correct these first", sorted.size() - most_messages));
      break;
    }
    std::string text = message(file, c.place, c.path, c.text);
    if (!contains(texts, text)) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace titin
