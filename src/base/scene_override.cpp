#include "base/scene_override.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/scene_text.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

[[noreturn]] void fail_override(const std::string& text, const std::string& problem, const std::string& advice) {
  throw InputError({fmt::format("command line: {}: {}; {}", in_quotes(text), problem, advice)});
}

/// "a.\"x+\".b" to its names. Dots part them; a quoted name may hold any character.
std::vector<std::string> names_of(std::string_view key, const std::string& whole) {
  std::vector<std::string> names;
  std::string name;
  char quote = 0;
  for (const char c : key) {
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? 0 : c;
    else if (c == '.' && !quote)
      names.push_back(std::move(name)), name.clear();
    else
      name += c;
  }
  names.push_back(std::move(name));
  if (quote || std::find(names.begin(), names.end(), "") != names.end() || names.size() > deepest_key)
    fail_override(whole, "is no key=value", "write for example time.step=\"25 ms\"");
  return names;
}

constexpr char removal = '~';  ///< "~time.scheme": as if the scene did not say it

std::size_t first_equal_sign(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? 0 : c;
    else if (c == '=' && !quote)
      return i;
  }
  return std::string_view::npos;
}

/// The right side of an override as {v = ...}: TOML if it is, else a string, which saves the user the quotation marks.
toml::table value_of(std::string_view value, const std::string& whole) {
  try {
    if (line_of_deep_key(value)) fail_override(whole, "nests too deeply", "write plain keys and values");
    toml::table parsed = toml::parse(fmt::format("v = {}", value));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error& error) {
    if (std::string_view("[{\"'").find(value.front()) != std::string_view::npos)
      fail_override(whole, fmt::format("its right side is not valid TOML ({})", error.description()),
                    "mind the quotation marks that the shell takes away");
  }
  return toml::table{{"v", std::string(value)}};
}

void remove(toml::table& scene, const std::string& text) {
  const auto names = names_of(trim(std::string_view(text).substr(1)), text);
  toml::table* table = &scene;
  for (std::size_t i = 0; i + 1 < names.size() && table; ++i) table = table->get_as<toml::table>(names[i]);
  if (!table || table->erase(names.back()) == 0)
    fail_override(text, "the scene does not say this", "drop the removal, or name a key or a table that it has");
}

}  // namespace

std::string override_with(toml::table& scene, const std::string& text) {
  if (text.starts_with(removal)) {
    remove(scene, text);
    return "";
  }
  const auto equal = first_equal_sign(text);
  if (equal == std::string::npos) fail_override(text, "is no key=value", "write for example time.step=\"25 ms\"");
  const auto names = names_of(trim(std::string_view(text).substr(0, equal)), text);
  const auto value = trim(std::string_view(text).substr(equal + 1));
  if (value.empty()) fail_override(text, "has no value", "write key=value");
  toml::table parsed = value_of(value, text);
  toml::table* table = &scene;
  std::string path;
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    path = join_path(path, names[i]);
    auto [it, inserted] = table->insert(names[i], toml::table{});
    if (!it->second.is_table()) fail_override(text, fmt::format("{} is not a table", path), "override it as a whole");
    table = it->second.as_table();
  }
  table->erase(names.back());
  parsed.get("v")->visit([&](auto& node) { table->insert(names.back(), std::move(node)); });
  return join_path(path, names.back());
}

int line_of_deep_key(std::string_view text) {
  int line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '"' || c == '\'') {
      for (++i; i < text.size() && text[i] != c && text[i] != '\n'; ++i)
        if (text[i] == '\\' && c == '"') ++i;
      line += i < text.size() && text[i] == '\n';
    } else if (c == '\n') {
      ++line, dots = 0;
    } else if (std::string_view(",=[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    } else if (c == '.' && ++dots > deepest_key) {
      return line;
    }
  }
  return 0;
}

}  // namespace titin
