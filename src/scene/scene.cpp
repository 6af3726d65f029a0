#include "scene/scene.hpp"

#include "fe/muscle.hpp"
#include "mesh/mesh.hpp"

namespace titin {

namespace {

enum class Formulation { muscle };

/// The walk through all keys: the same for a scene and for the list of keys.
struct SceneConfig {
  std::string title;
  Formulation formulation = Formulation::muscle;
  MeshConfig mesh;
  ClockConfig clock;
  OutputConfig output;
  Reference reference;
  MuscleConfig muscle;
  PetscOptionsConfig petsc;

  NamedMesh bind(Section root) {
    root.read("title", title, {.doc = "one line that says what happens"});
    root.choose("model", formulation, {{"muscle", Formulation::muscle}}, {.required = true, .doc = "the formulation"});
    Section mesh_section = root.section("mesh", "a box, or a file");
    mesh.bind(mesh_section);
    NamedMesh named = root.describing() ? NamedMesh{} : NamedMesh::read(mesh, mesh_section);
    Section time = root.section("time", "from 0 to the end by steps");
    clock.bind(time);
    Section out = root.section("output", "what is written, and when");
    output.bind(out);
    muscle.bind(root, named);
    Section options = root.section("petsc", "options of PETSc and hypre, for those who know them");
    petsc.bind(options);
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
  Scene scene{config.title,   config.clock, config.output, nullptr, nullptr, std::move(config.reference),
              text.resolved()};
  scene.petsc = std::make_unique<PetscOptionsInForce>(std::move(config.petsc));
  scene.model = std::make_unique<Muscle>(std::move(mesh), std::move(config.muscle));
  scene.reference.match(scene.model->quantities(), text.root().section("reference"));
  text.finish();
  return scene;
}

std::vector<KeyRecord> scene_keys() {
  Config keys = Config::describing();
  SceneConfig config;
  config.bind(keys.root());
  return keys.keys();
}

}  // namespace titin
