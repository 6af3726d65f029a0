#include "mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>

#include "base/parallel.hpp"

namespace titin {

namespace {

constexpr int max_refinements = 8;
constexpr double max_cells = 1e8;  // one rank holds the serial mesh while it is partitioned

/// What $PhysicalNames of a Gmsh 2.2 file says; MFEM 4.6 reads the numbers and drops the names.
struct GmshNames {
  std::map<std::string, int> volumes, surfaces;
  std::string error;
};

GmshNames read_gmsh_names(const std::string& file) {
  GmshNames names;
  std::ifstream in(file, std::ios::binary);
  std::string word, version;
  if (!(in >> word >> version) || word != "$MeshFormat") {
    names.error = "is not a Gmsh mesh (it does not begin with $MeshFormat)";
    return names;
  }
  if (version.rfind("2.2", 0) != 0) {
    names.error =
        fmt::format("is a Gmsh mesh of format {}; only 2.2 is read (save it with Mesh.MshFileVersion = 2.2)", version);
    return names;
  }
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("$Nodes", 0) == 0) break;  // names come before nodes
    if (line.rfind("$PhysicalNames", 0) != 0) continue;
    int count = 0;
    in >> count;
    for (int i = 0, dimension, tag; i < count && in >> dimension >> tag; ++i) {
      std::string name;
      std::getline(in, name);
      const auto first = name.find('"'), last = name.rfind('"');
      if (first == std::string::npos || last <= first) continue;
      name = name.substr(first + 1, last - first - 1);
      if (dimension == 3) names.volumes[name] = tag;
      if (dimension == 2) names.surfaces[name] = tag;
    }
  }
  return names;
}

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

mfem::Mesh load(const std::string& file, NamedMesh& named, std::string& error) {
  GmshNames names = read_gmsh_names(file);
  error = names.error;
  if (!error.empty()) return {};
  try {
    mfem::Mesh mesh(file.c_str(), 1, 1, true);
    name_the_rest(mesh.attributes, "region", names.volumes);
    name_the_rest(mesh.bdr_attributes, "boundary", names.surfaces);
    named.regions = names.volumes;
    named.boundaries = names.surfaces;
    return mesh;
  } catch (const mfem::ErrorException& e) {
    error = fmt::format("cannot be read as a Gmsh mesh: {}", e.what());
    return {};
  }
}

std::string unsuitable(const mfem::Mesh& mesh) {
  if (mesh.Dimension() != 3) return "is not three-dimensional";
  mfem::Array<mfem::Geometry::Type> geometries;
  mesh.GetGeometries(3, geometries);
  if (geometries.Size() != 1 || geometries[0] != mfem::Geometry::CUBE) return "has cells that are not hexahedra";
  return "";
}

}  // namespace

void MeshConfig::bind(Section& s) {
  s.read("box", box,
         {.unit = "m",
          .range = non_negative,
          .doc = "edge lengths of a box; boundaries x-, x+, y-, y+, z-, z+, region body"});
  s.read("cells", cells, {.range = {.min = 1, .max = 1e4}, .doc = "hexahedra of the box along x, y, z"});
  s.read("file", file,
         {.doc = "Gmsh 2.2 mesh of hexahedra, in metres; its physical names name regions and boundaries"});
  s.read("refine", refine,
         {.range = {.min = 0, .max = max_refinements}, .doc = "uniform refinements (each 8 times the cells)"});
}

NamedMesh NamedMesh::read(const MeshConfig& config, Section section) {
  NamedMesh named;
  const bool has_box = config.box != std::array<double, 3>{0, 0, 0};
  if (!has_box && config.file.empty() && (section.has("box") || section.has("file"))) return named;  // reported already
  if (has_box == !config.file.empty()) {
    section.error("", has_box ? "a mesh is either a box or a file, not both" : "no mesh",
                  "give mesh.box (with mesh.cells) or mesh.file");
    return named;
  }
  if (has_box && (config.box[0] <= 0 || config.box[1] <= 0 || config.box[2] <= 0)) {
    section.error("box", "the edges of a box must be longer than 0");
    return named;
  }
  const std::string file = has_box ? "" : section.existing_file("file", config.file);
  if (!has_box && file.empty()) return named;

  const double cells = 1.0 * config.cells[0] * config.cells[1] * config.cells[2] * std::pow(8.0, config.refine);
  if (has_box && (cells > max_cells || cells < ranks())) {
    section.error(
        "cells", fmt::format("{:.0f} cells for {} ranks", cells, ranks()),
        cells > max_cells ? "take fewer cells" : "every rank needs at least one cell: take more cells or fewer ranks");
    return named;
  }
  std::string error;
  mfem::Mesh serial = has_box ? make_box(config, named) : load(file, named, error);
  if (error.empty()) error = unsuitable(serial);
  if (!error.empty()) {
    section.error("file", fmt::format("{} {}", file, error));
    return named;
  }
  for (int i = 0; i < config.refine; ++i) serial.UniformRefinement();
  if (serial.GetNE() < ranks()) {
    section.error("", fmt::format("{} cells for {} ranks", serial.GetNE(), ranks()),
                  "every rank needs at least one cell: take more cells or fewer ranks");
    return named;
  }
  named.mesh = std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial);
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
