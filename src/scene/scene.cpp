#include "scene/scene.hpp"

#include <set>

#include "fe/muscle.hpp"
#include "fv/lagrange.hpp"
#include "mesh/box_shape.hpp"
#include "mesh/inverted_cells.hpp"
#include "mesh/mesh.hpp"
#include "rod/rod.hpp"

namespace titin {

namespace {

enum class ModelName { muscle, lagrange, rod };

/// The walk through all keys: the same for a scene and for the list of keys.
struct SceneConfig {
  std::string title;
  FidelityConfig fidelity;
  ModelName model = ModelName::muscle;
  MeshConfig mesh;
  ClockConfig clock;
  OutputConfig output;
  SavingConfig saving;
  Reference reference;
  MuscleConfig muscle;
  PetscOptionsConfig petsc;
  LagrangeConfig lagrange;
  RodConfig rod;

  NamedMesh bind(Section root) {
    root.read("title", title, {.doc = "one line that says what happens"});
    root.choose("model", model,
                {{"muscle", ModelName::muscle}, {"lagrange", ModelName::lagrange}, {"rod", ModelName::rod}},
                {.required = true, .doc = "the formulation"});
    fidelity.bind(root);
    NamedMesh named;
    if (root.describing() || model != ModelName::rod) named = bind_mesh(root);
    Section time = root.section("time", "from 0 to the end by steps");
    clock.by_stability = model == ModelName::lagrange;
    clock.bind(time);
    Section out = root.section("output", "what is written, and when");
    output.bind(out);
    saving.bind(out);
    if (root.describing() || model == ModelName::muscle) {
      muscle.bind(root, named);
      Section options = root.section("petsc", "options of PETSc and hypre, for those who know them");
      petsc.bind(options);
    }
    if (root.describing() || model == ModelName::lagrange) lagrange.bind(root, named);
    if (root.describing() || model == ModelName::rod) named = rod.bind(root);
    Section other = root.section("reference", "a history to compare with");
    reference.bind(other);
    root.leave("test");
    return named;
  }

 private:
  NamedMesh bind_mesh(Section root) {
    Section mesh_section = root.section("mesh", "a box, or a file");
    mesh.bind(mesh_section);
    NamedMesh named = root.describing() ? NamedMesh{} : NamedMesh::read(mesh, mesh_section);
    BoxShape shape;
    Section shape_section = mesh_section.section("shape", "where a box lies, and how it is bent");
    shape.bind(shape_section);
    if (named.mesh && !mesh.box.empty() && mesh_section.has("shape")) shape.apply(*named.mesh);
    if (named.mesh) warn_of_inverted_corners(named);
    return named;
  }
};

Scene scene_of(Config text) {
  SceneConfig config;
  NamedMesh mesh = config.bind(text.root());
  text.finish();
  Scene scene;
  scene.title = config.title;
  scene.fidelity = config.fidelity;
  scene.clock = config.clock;
  scene.output = config.output;
  scene.reference = std::move(config.reference);
  scene.saving = config.saving;
  scene.settings = text.settings();
  scene.mesh_identity = mesh.numbers.identity;
  scene.resolved = text.resolved();
  scene.petsc = std::make_unique<PetscOptionsInForce>(std::move(config.petsc));
  if (config.model == ModelName::muscle)
    scene.model = std::make_unique<Muscle>(std::move(mesh), std::move(config.muscle));
  else if (config.model == ModelName::rod)
    scene.model = std::make_unique<Rod>(std::move(mesh), std::move(config.rod));
  else
    scene.model = make_lagrange(std::move(mesh), std::move(config.lagrange));
  const std::vector<Quantity> followed = scene.model->quantities();
  scene.reference.match(followed, text.root().section("reference"));
  scene.fidelity.match(followed, text.root());
  text.finish();
  return scene;
}

}  // namespace

Scene Scene::read(const std::string& file, const std::vector<std::string>& overrides) {
  return scene_of(Config::read_file(file, overrides));
}

Scene Scene::of_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  return scene_of(Config(text, file, overrides));
}

std::vector<KeyRecord> scene_keys() {
  Config keys = Config::describing();
  SceneConfig config;
  config.bind(keys.root());
  std::vector<KeyRecord> list = keys.keys();
  std::set<std::pair<std::string, bool>>
      seen;  // formulations share keys; wall is a key of one and a table of the other
  std::erase_if(list, [&](const KeyRecord& key) { return !seen.insert({key.path, key.type == "table"}).second; });
  return list;
}

}  // namespace titin
