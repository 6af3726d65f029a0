/// What a scene says, by key: the settings of its resolved text.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace titin {

class SceneFacts {
 public:
  explicit SceneFacts(const std::vector<std::string>& settings);  ///< "key = value" each, as Scene::settings
  bool has(const std::string& key) const { return values_.count(key) != 0; }
  std::string text(const std::string& key) const;  ///< without quotation marks; "" where there is none
  double number(const std::string& key) const;     ///< the first one in it, in SI; NaN where there is none
  /// Of a key that is a whole number: what the scene says, else its default (settings leave out defaults of keys that a
  /// formulation only asks about); 1 where it has none.
  int whole(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;  ///< all of a list, or of "1, 2 m"
  /// Keys that begin with this.
  std::vector<std::string> below(const std::string& prefix) const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace titin
