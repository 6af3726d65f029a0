// A mesh that a scene names: whatever passes our own look at the file must be a mesh to MFEM, or an error of it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "fuzz/targets.hpp"
#include "mesh/mesh.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

struct File {
  fs::path path = fs::temp_directory_path() / ("titin_fuzz_" + std::to_string(std::random_device()()) + ".msh");
  ~File() { fs::remove(path); }
};

struct Scene {
  MeshConfig mesh;
  void bind(Section root) {
    Section section = root.section("mesh");
    mesh.bind(section);
    NamedMesh::read(mesh, section);
  }
};

}  // namespace

void fuzz_mesh(const std::string& bytes) {
  static const File file;
  if (!(std::ofstream(file.path, std::ios::binary) << bytes << std::flush)) std::abort();
  try {
    Config config("mesh.file = '" + file.path.string() + "'", "fuzz.toml");
    Scene().bind(config.root());
    config.finish();
  } catch (const InputError&) {
  }
}

}  // namespace titin
