/// One key while it is read: from a TOML node to checked SI numbers. Private to base.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/scene_text.hpp"

namespace titin {

using Numbers = std::optional<std::vector<double>>;

struct AskedKey {
  SceneText& scene;
  std::string table, name;
  Key key;
  const toml::node* node = nullptr;  // null when the scene does not say it

  void complain(const std::string& problem, const std::string& advice = "") const;
  /// For resolved.toml, as TOML; "" leaves it out.
  void keep(const std::string& value) const;
  void keep_numbers(const std::vector<double>& values, bool list) const;
  /// A default that its own range excludes means "none": no scene can say it.
  bool can_be_said(const std::vector<double>& values) const;
};

/// Registers the key, and misses it if it is required and not there.
AskedKey ask(SceneText& scene, const std::string& table, std::string_view name, const Key& key, const std::string& type,
             const std::string& default_value, const std::vector<std::string>& choices = {});

/// One number, or several: a list, or text with commas. `size` -1: any number of them. Complains of what is wrong.
Numbers numbers(const AskedKey& asked, int size);
std::vector<int> whole_numbers(const AskedKey& asked, int size);  ///< empty when something is wrong
bool in_range(const AskedKey& asked, const std::vector<double>& values);

std::string shown(const toml::node& node);  ///< in a message
/// As a scene says it: pure numbers bare, others with their unit; "" (left out) for what no scene can say.
std::string toml_numbers(const std::vector<double>& values, std::string_view unit, bool list);

}  // namespace titin
