#include "point/json_material.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/words.hpp"
#include "materials/material.hpp"
#include "materials/registry.hpp"

namespace titin {
namespace {

using Json = nlohmann::json;

/// Values of one table, whose keys may have units.
class Writer {
 public:
  Writer(const std::map<std::string, std::string>& units, const std::string& stress_unit)
      : units_(units), stress_unit_(stress_unit) {}

  std::string value(const Json& x, const std::string& key) const { return text(x, key, unit_of(key)); }

 private:
  std::string unit_of(const std::string& key) const {
    const auto found = units_.find(key);
    if (found == units_.end()) return "";
    return found->second == "Pa" ? stress_unit_ : found->second;
  }
  std::string text(const Json& x, const std::string& key, const std::string& unit) const {
    if (x.is_object()) return object(x, key, unit);
    if (x.is_array()) return list(x, key, unit);
    if (x.is_string()) return toml_string(x.get<std::string>());
    if (x.is_boolean()) return x.get<bool>() ? "true" : "false";
    if (!x.is_number()) throw InputError({fmt::format("{}: null is no value; leave the key away", key)});
    return unit.empty() ? x.dump() : fmt::format("\"{} {}\"", x.dump(), unit);
  }
  std::string list(const Json& x, const std::string& key, const std::string& unit) const {
    std::vector<std::string> entries;
    for (const Json& entry : x) entries.push_back(text(entry, key, unit));
    return fmt::format("[{}]", fmt::join(entries, ", "));
  }
  /// A table of keys, or a curve {time, value} whose values have the unit of its key.
  std::string object(const Json& x, const std::string& key, const std::string& unit) const {
    std::vector<std::string> entries;
    for (const auto& [name, entry] : x.items()) {
      const std::string path = key + "." + name;
      const bool of_curve = units_.count(key) > 0;
      const bool scaled = name == "value" && x.contains("scale");
      const std::string its_unit = !of_curve ? unit_of(path) : name == "time" ? "s" : scaled ? "" : unit;
      entries.push_back(fmt::format("{} = {}", toml_string(name), text(entry, path, its_unit)));
    }
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }

  const std::map<std::string, std::string>& units_;
  const std::string& stress_unit_;
};

/// Of the keys below a table.
void add_units(const std::vector<KeyRecord>& keys, const std::string& table,
               std::map<std::string, std::string>& units) {
  for (const KeyRecord& key : keys)
    if (key.type != "table" && key.path.starts_with(table)) units[key.path.substr(table.size())] = key.unit;
}

const Json& table(const Json& parent, const char* name) {
  static const Json none = Json::object();
  const auto found = parent.find(name);
  if (found == parent.end()) return none;
  if (!found->is_object()) throw InputError({fmt::format("{}: no object; write {{ \"...\": ... }}", name)});
  return *found;
}

}  // namespace

JsonMaterials::JsonMaterials() {
  Config material = Config::describing();
  Material::read(material.root());
  add_units(material.keys(), "", material_);
  for (const LawInfo& info : laws()) {
    Law& law = laws_[info.name];
    law.has_potential = info.has_potential;
    add_units(material.keys(), "terms.<NAME>.", law.units);
    add_units(info.parameters, "", law.units);
  }
}

const JsonMaterials::Units& JsonMaterials::units_of(const Json& term) const {
  static const Units none;
  const auto law = term.find("law");
  const auto known = laws_.find(law != term.end() && law->is_string() ? law->get<std::string>() : "");
  return known == laws_.end() ? none : known->second.units;
}

std::string JsonMaterials::toml(const Json& keys, const std::string& path, const std::string& stress_unit) const {
  std::string own = fmt::format("[{}]\n", path), below;
  const auto write = [&](const Json& table_keys, const Units& units, std::string& text) {
    const Writer writer(units, stress_unit);
    for (const auto& [name, x] : table_keys.items())
      text += fmt::format("{} = {}\n", toml_string(name), writer.value(x, name));
  };
  Json plain = keys;
  for (const char* name : {"terms", "volumetric", "mix"}) plain.erase(name);
  write(plain, material_, own);
  if (keys.contains("volumetric")) {
    Json volumetric = table(keys, "volumetric");
    if (!volumetric.contains("law")) volumetric["law"] = "simo";
    below += fmt::format("[{}.volumetric]\n", path);
    write(volumetric, units_of(volumetric), below);
  }
  for (const auto& [name, term] : table(keys, "terms").items()) {
    below += fmt::format("[{}.terms.{}]\n", path, toml_string(name));
    write(table(keys.at("terms"), name.c_str()), units_of(term), below);
  }
  if (keys.contains("mix")) below += toml(table(keys, "mix"), path + ".mix", stress_unit);
  return own + below;
}

bool JsonMaterials::is_active(const std::string& law) const {
  const auto known = laws_.find(law);
  return known != laws_.end() && known->second.units.count("activation");
}

bool JsonMaterials::has_potential(const std::string& law) const {
  const auto known = laws_.find(law);
  return known == laws_.end() || known->second.has_potential;
}

}  // namespace titin
