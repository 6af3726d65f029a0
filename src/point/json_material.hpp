/// A material written as JSON: the same keys as [materials.NAME] of a scene; bare numbers are in the key's SI unit.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace titin {

/// Turns such objects into the text of scenes.
class JsonMaterials {
 public:
  JsonMaterials();
  /// The TOML of the table `path` with these keys. Stresses that are bare numbers are in `stress_unit`. Throws
  /// InputError where JSON says what TOML cannot (null).
  std::string toml(const nlohmann::json& keys, const std::string& path, const std::string& stress_unit) const;
  bool is_active(const std::string& law) const;      ///< has it the key `activation`?
  bool has_potential(const std::string& law) const;  ///< has it an energy, at least while its activation is held?

 private:
  using Units = std::map<std::string, std::string>;  // by key, tables before a dot
  struct Law {
    Units units;
    bool has_potential = true;
  };
  const Units& units_of(const nlohmann::json& term) const;

  std::map<std::string, Law> laws_;
  Units material_;
};

}  // namespace titin
