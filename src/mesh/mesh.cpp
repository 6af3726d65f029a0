#include "mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "mesh/gmsh.hpp"

namespace titin {

namespace {

constexpr int max_refinements = 8;
constexpr double max_cells = 1e8;  // one rank holds the serial mesh while it is partitioned

/// MFEM prints its errors before it throws them; ours are printed once, by rank 0.
class Silence {
 public:
  Silence() : was_on_(mfem::err.IsEnabled()) { mfem::err.Disable(); }
  ~Silence() {
    if (was_on_) mfem::err.Enable();
  }
  Silence(const Silence&) = delete;

 private:
  bool was_on_;
};

/// Tags without a name get one: "region 3", "boundary 7".
void name_the_rest(const mfem::Array<int>& attributes, const std::string& kind, std::map<std::string, int>& names) {
  for (int attribute : attributes) {
    bool named = false;
    for (const auto& [name, tag] : names) named = named || tag == attribute;
    if (!named) names[fmt::format("{} {}", kind, attribute)] = attribute;
  }
  std::erase_if(names, [&](const auto& entry) { return attributes.Find(entry.second) < 0; });
}

mfem::Mesh make_box(const MeshConfig& config, NamedMesh& named) {
  const auto& [a, b, c] = config.box;
  const auto& [nx, ny, nz] = config.cells;
  named.regions = {{"body", 1}};
  named.boundaries = {{"z-", 1}, {"y-", 2}, {"x+", 3}, {"y+", 4}, {"x-", 5}, {"z+", 6}};  // MFEM's numbering
  return mfem::Mesh::MakeCartesian3D(nx, ny, nz, mfem::Element::HEXAHEDRON, a, b, c, true);
}

void scale(mfem::Mesh& mesh, double factor) {
  if (mesh.GetNodes()) *mesh.GetNodes() *= factor;
  for (int i = 0; i < mesh.GetNV(); ++i)
    for (int d = 0; d < 3; ++d) mesh.GetVertex(i)[d] *= factor;
}

/// An empty mesh when the file is no good, which is then reported.
mfem::Mesh load(const MeshConfig& config, Section& section, NamedMesh& named) {
  const std::string path = section.existing_file("file", config.file);
  if (path.empty()) return {};
  std::ifstream in(path);
  GmshFile file = scan_gmsh(in);
  if (file.problem.empty()) try {
      const Silence silence;
      mfem::Mesh mesh(path.c_str(), 1, 1, true);
      scale(mesh, config.unit);
      name_the_rest(mesh.attributes, "region", file.volumes);
      name_the_rest(mesh.bdr_attributes, "boundary", file.surfaces);
      named.regions = file.volumes;
      named.boundaries = file.surfaces;
      return mesh;
    } catch (const mfem::ErrorException& error) {
      const std::string text = error.what();
      file.problem = fmt::format("cannot be read ({})", printable(text.substr(0, text.find('\n'))));
      file.advice = "save it again";
    }
  section.error("file", fmt::format("file {} {}", in_quotes(config.file), file.problem), file.advice);
  return {};
}

/// Does the scene say one mesh, and not none or two?
bool names_one_mesh(const MeshConfig& config, Section& section) {
  const bool has_box = config.box != std::array<double, 3>{0, 0, 0}, has_file = !config.file.empty();
  if (!has_box && !has_file && (section.has("box") || section.has("file"))) return false;  // reported already
  if (has_box == has_file)
    section.error("", has_box ? "a mesh is either a box or a file, not both" : "no mesh",
                  "give mesh.box (with mesh.cells) or mesh.file");
  else if (has_box && *std::min_element(config.box.begin(), config.box.end()) <= 0)
    section.error("box", "the edges of a box must be longer than 0");
  else
    return true;
  return false;
}

/// Are there neither too many cells, after `growth` times as many come of refinement, nor too few?
bool has_fit_size(double cells, double growth, std::string_view key, Section& section) {
  if (cells * growth > max_cells)
    section.error(growth > 1 ? "refine" : key, count(cells * growth, "cell"),
                  fmt::format("take at most {:.0f}: one rank holds them all while they are shared out", max_cells));
  else if (cells * growth < ranks())
    section.error(key, fmt::format("{} for {}", count(cells * growth, "cell"), count(ranks(), "rank")),
                  "every rank needs at least one cell: take more cells or fewer ranks");
  else
    return true;
  return false;
}

/// Cells of this rank that have no positive volume somewhere.
int inverted_cells(mfem::ParMesh& mesh) {
  const auto& rule = mfem::IntRules.Get(mfem::Geometry::CUBE, 5);
  int inverted = 0;
  for (int cell = 0; cell < mesh.GetNE(); ++cell) {
    auto* map = mesh.GetElementTransformation(cell);
    bool positive = true;
    for (int q = 0; q < rule.GetNPoints(); ++q) {
      map->SetIntPoint(&rule.IntPoint(q));
      positive = positive && map->Weight() > 0;
    }
    inverted += !positive;
  }
  return inverted;
}

}  // namespace

void MeshConfig::bind(Section& s) {
  s.read("box", box,
         {.unit = "m",
          .range = non_negative,
          .doc = "edge lengths of a box; boundaries x-, x+, y-, y+, z-, z+, region body"});
  s.read("cells", cells, {.range = {.min = 1, .max = 1e4}, .doc = "hexahedra of the box along x, y, z"});
  s.read("file", file, {.doc = "Gmsh 2.2 mesh of hexahedra; its physical names name regions and boundaries"});
  s.read("unit", unit, {.unit = "m", .range = positive, .doc = "what a length of 1 in the file is"});
  s.read("refine", refine,
         {.range = {.min = 0, .max = max_refinements}, .doc = "uniform refinements (each 8 times the cells)"});
}

NamedMesh NamedMesh::read(const MeshConfig& config, Section section) {
  NamedMesh named;
  if (!names_one_mesh(config, section)) return named;
  const bool has_box = config.file.empty();
  const double growth = std::pow(8.0, config.refine);
  const double in_box = 1.0 * config.cells[0] * config.cells[1] * config.cells[2];
  if (has_box && !has_fit_size(in_box, growth, "cells", section)) return named;
  mfem::Mesh serial = has_box ? make_box(config, named) : load(config, section, named);
  if (serial.GetNE() == 0 || (!has_box && !has_fit_size(serial.GetNE(), growth, "file", section))) return named;
  for (int i = 0; i < config.refine; ++i) serial.UniformRefinement();
  auto mesh = std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial);
  if (const long inverted = sum(static_cast<long>(inverted_cells(*mesh))); inverted > 0)
    section.error("file", fmt::format("{} of {} are inside out", inverted, count(mesh->GetGlobalNE(), "cell")),
                  "number the nodes of a cell as Gmsh does, and move those that make cells too slanted");
  else
    named.mesh = std::move(mesh);
  return named;
}

mfem::Array<int> NamedMesh::boundary_marker(const std::vector<std::string>& names) const {
  mfem::Array<int> marker(mesh->bdr_attributes.Size() ? mesh->bdr_attributes.Max() : 0);
  marker = 0;
  for (const auto& name : names) marker[boundaries.at(name) - 1] = 1;
  return marker;
}

std::string names_of(const std::map<std::string, int>& names) {
  std::vector<std::string> words;
  for (const auto& [name, attribute] : names) words.push_back(name);
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace titin
