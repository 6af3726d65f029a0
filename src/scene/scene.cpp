#include "scene/scene.hpp"

#include <set>

#include "fe/muscle.hpp"
#include "fv/lagrange.hpp"
#include "mesh/mesh.hpp"

namespace titin {

namespace {

enum class Formulation { muscle, lagrange };

/// The walk through all keys: the same for a scene and for the list of keys.
struct SceneConfig {
  std::string title;
  Formulation formulation = Formulation::muscle;
  MeshConfig mesh;
  ClockConfig clock;
  OutputConfig output;
  Reference reference;
  MuscleConfig muscle;
  LagrangeConfig lagrange;

  NamedMesh bind(Section root) {
    root.read("title", title, {.doc = "one line that says what happens"});
    root.choose("model", formulation, {{"muscle", Formulation::muscle}, {"lagrange", Formulation::lagrange}},
                {.required = true, .doc = "the formulation"});
    Section mesh_section = root.section("mesh", "a box, or a file");
    mesh.bind(mesh_section);
    NamedMesh named = root.describing() ? NamedMesh{} : NamedMesh::read(mesh, mesh_section);
    Section time = root.section("time", "from 0 to the end by steps");
    clock.bind(time);
    Section out = root.section("output", "what is written, and when");
    output.bind(out);
    if (root.describing() || formulation == Formulation::muscle) muscle.bind(root, named);
    if (root.describing() || formulation == Formulation::lagrange) lagrange.bind(root, named);
    Section other = root.section("reference", "a history to compare with");
    reference.bind(other);
    root.leave("test");
    return named;
  }
};

}  // namespace

Scene Scene::read(const std::string& file, const std::vector<std::string>& overrides) {
  Config text = Config::read_file(file, overrides);
  SceneConfig config;
  NamedMesh mesh = config.bind(text.root());
  text.finish();
  Scene scene{config.title, config.clock, config.output, nullptr, std::move(config.reference), text.resolved()};
  if (config.formulation == Formulation::muscle)
    scene.model = std::make_unique<Muscle>(std::move(mesh), std::move(config.muscle));
  else
    scene.model = make_lagrange(std::move(mesh), std::move(config.lagrange));
  scene.reference.match(scene.model->quantities(), text.root().section("reference"));
  text.finish();
  return scene;
}

std::vector<KeyRecord> scene_keys() {
  Config keys = Config::describing();
  SceneConfig config;
  config.bind(keys.root());
  std::vector<KeyRecord> list = keys.keys();
  std::set<std::string> seen;  // formulations share keys
  std::erase_if(list, [&](const KeyRecord& key) { return !seen.insert(key.path).second; });
  return list;
}

}  // namespace titin
