#include "scene/scene_facts.hpp"

#include <cstdlib>
#include <limits>

#include "scene/scene.hpp"

namespace titin {

SceneFacts::SceneFacts(const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const auto equal = setting.find(" = ");
    if (equal != std::string::npos) values_[setting.substr(0, equal)] = setting.substr(equal + 3);
  }
}

std::string SceneFacts::text(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return "";
  const std::string& value = found->second;
  return value.size() > 1 && value.front() == '"' ? value.substr(1, value.size() - 2) : value;
}

std::vector<double> SceneFacts::numbers(const std::string& key) const {
  const std::string value = text(key);
  std::vector<double> list;
  for (const char* c = value.c_str(); *c;) {
    char* end = nullptr;
    const double x = std::strtod(c, &end);
    if (end == c) {
      ++c;
      continue;
    }
    list.push_back(x);
    c = end;
  }
  return list;
}

double SceneFacts::number(const std::string& key) const {
  const auto list = numbers(key);
  return list.empty() ? std::numeric_limits<double>::quiet_NaN() : list[0];
}

int SceneFacts::whole(const std::string& key) const {
  if (has(key)) return static_cast<int>(number(key));
  for (const KeyRecord& record : scene_keys())
    if (record.path == key && !record.default_value.empty()) return std::stoi(record.default_value);
  return 1;
}

std::vector<std::string> SceneFacts::below(const std::string& prefix) const {
  std::vector<std::string> keys;
  for (auto it = values_.lower_bound(prefix); it != values_.end() && it->first.starts_with(prefix); ++it)
    keys.push_back(it->first);
  return keys;
}

}  // namespace titin
