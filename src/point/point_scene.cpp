#include "point/point_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text_file.hpp"
#include "base/words.hpp"
#include "materials/registry.hpp"

namespace titin {
namespace {

/// Tables of whole scenes that say nothing about a point.
constexpr const char* of_scenes[] = {"title", "model",   "mesh",     "time",   "output", "muscle",   "lagrange",
                                     "body",  "markers", "averages", "solver", "test",   "boundary", "torques"};
const std::string the_material = "materials.material";

std::string first_word(const std::string& key) { return key.substr(0, key.find_first_of(".=[ ")); }

std::string choose_material(Section& point, const std::vector<std::string>& names) {
  std::string chosen = names.size() == 1 ? names.front() : "";
  point.read("material", chosen, {.doc = "name of the material, where the scene has several"});
  if (point.describing() || std::count(names.begin(), names.end(), chosen)) return chosen;
  point.error(point.has("material") ? "material" : "",
              chosen.empty() ? "which material?" : fmt::format("no material is called {}", in_quotes(chosen)),
              names.empty() ? "add a table [materials.NAME]"
                            : fmt::format("write material = \"NAME\" with one of: {}", fmt::join(names, ", ")));
  return "";
}

/// Names of the keys that the laws of this name understand, and those that go with any term.
std::set<std::string> keys_of_law(const std::string& law) {
  std::set<std::string> words;
  for (const LawInfo& info : laws())
    if (info.name == law)
      for (const KeyRecord& key : info.parameters) words.insert(first_word(key.path));
  return words;
}

/// Where an override belongs whose key is written without its table.
class Places {
 public:
  explicit Places(const std::vector<std::string>& laws) {
    for (const std::string& law : laws) laws_[law] = keys_of_law(law);
    Config described = Config::describing();
    Material::read(described.root());
    const std::string of_terms = "terms.<NAME>.";
    for (const KeyRecord& key : described.keys()) {
      material_.insert(first_word(key.path));
      if (key.path.starts_with(of_terms)) any_term_.insert(first_word(key.path.substr(of_terms.size())));
    }
  }

  std::string full(const std::string& override_text) const {
    const std::string word = first_word(override_text);
    const bool whole =
        word == "materials" || word == "point" || std::count(std::begin(of_scenes), std::end(of_scenes), word);
    if (whole) return override_text;
    std::vector<std::string> owners;
    for (const auto& [law, keys] : laws_)
      if (keys.count(word)) owners.push_back(law);
    if (owners.empty() && laws_.size() == 1 && any_term_.count(word)) owners.push_back(laws_.begin()->first);
    if (owners.size() > 1)
      throw InputError({fmt::format("{}: {} have this key; write {}.{} or the like", in_quotes(override_text),
                                    fmt::join(owners, " and "), owners.front(), word)});
    if (owners.size() == 1) return fmt::format("{}.terms.{}.{}", the_material, owners.front(), override_text);
    if (laws_.count(word)) return fmt::format("{}.terms.{}", the_material, override_text);
    if (!laws_.empty() && material_.count(word)) return fmt::format("{}.{}", the_material, override_text);
    return "point." + override_text;  // where reading says so if nobody knows it
  }

 private:
  std::map<std::string, std::set<std::string>> laws_;
  std::set<std::string> material_, any_term_;
};

void bind_map(Section& point, MapConfig& map) {
  Section s = point.section("map", "--map: the box of stretch and activation");
  map.bind(s);
}

}  // namespace

PointText point_text_of_file(const std::string& file, const std::vector<std::string>& overrides) {
  const TextFile text = read_text_file(file);
  if (!text.problem.empty())
    throw InputError({fmt::format("{}: the file {}; give the path of a TOML file", file, text.problem)});
  PointText point{text.text, file, {}};
  const Places places({});
  for (const std::string& given : overrides) point.overrides.push_back(places.full(given));
  return point;
}

PointText point_text_of_laws(const std::vector<std::string>& names, const std::vector<std::string>& overrides) {
  const Places places(names);
  PointText point{fmt::format("[{}]\ndensity = \"1000 kg/m^3\"\n", the_material), "command line", {}};
  for (const std::string& given : overrides) point.overrides.push_back(places.full(given));
  bool fibre = false, second_fibre = false, resists = false;
  for (const LawInfo& law : laws()) {
    if (!std::count(names.begin(), names.end(), law.name)) continue;
    fibre |= law.needs_fibre, second_fibre |= law.needs_second_fibre;
    resists |= !law.needs_volumetric;
  }
  if (fibre) point.text += "fibre = [1, 0, 0]\n";
  if (second_fibre) point.text += "second_fibre = [0, 1, 0]\n";
  const bool has_volumetric = std::any_of(point.overrides.begin(), point.overrides.end(), [](const std::string& text) {
    return text.starts_with(the_material + ".volumetric");
  });
  if (!resists && !has_volumetric)  // this modulus is never looked at
    point.text += "volumetric = { law = \"simo\", bulk_modulus = \"1 MPa\" }\n[point]\nvolume = \"incompressible\"\n";
  for (const std::string& law : names)
    point.text += fmt::format("[{}.terms.{}]\nlaw = {}\n", the_material, law, toml_string(law));
  return point;
}

PointScene PointScene::read(const PointText& text, PointTask task) {
  Config config = text.config();
  Section root = config.root();
  for (const char* name : of_scenes) root.leave(name);
  Section materials = root.section("materials"), point = root.section("point");
  PointScene scene;
  scene.material_name = choose_material(point, materials.names());
  for (const std::string& name : materials.names()) {
    Section s = materials.section(name);
    s.leave("regions");
    const auto material = Material::read(s);
    if (name == scene.material_name) scene.material = material;
  }
  scene.loading.needs_drive = task == PointTask::experiment;
  scene.loading.bind(point);
  if (task == PointTask::map || point.has("map")) bind_map(point, scene.map);
  config.finish();
  scene.keys = config.keys();
  return scene;
}

std::vector<KeyRecord> point_keys() {
  Config config = Config::describing();
  Section point = config.root().section("point", "what is done to a material point");
  choose_material(point, {});
  LoadingConfig loading;
  loading.bind(point);
  MapConfig map;
  bind_map(point, map);
  return config.keys();
}

}  // namespace titin
