#include "mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "mesh/cut_box.hpp"
#include "mesh/gmsh.hpp"
#include "mesh/inverted_cells.hpp"

namespace titin {

namespace {

constexpr int max_refinements = 8;
constexpr double same_layer = 1e-6;  // of a cell's length: what is printed with few digits
constexpr double max_cells = 1e8;    // one rank holds the serial mesh while it is partitioned

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

/// Boundaries by MFEM's numbering.
mfem::Mesh make_cells(const MeshConfig& config, NamedMesh& named) {
  using mfem::Element;
  const auto& edge = config.box;
  const auto& n = config.cells;
  const bool tensor = config.kind == BoxCells::tensor;
  if (edge.size() == 2)
    named.boundaries = {{"y-", 1}, {"x+", 2}, {"y+", 3}, {"x-", 4}};
  else
    named.boundaries = {{"z-", 1}, {"y-", 2}, {"x+", 3}, {"y+", 4}, {"x-", 5}, {"z+", 6}};
  if (config.kind == BoxCells::simplices && config.cuts != BoxCuts::same) return make_cut_box(n, edge, config.cuts);
  if (edge.size() == 2) {
    const auto type = tensor ? Element::QUADRILATERAL : Element::TRIANGLE;
    return mfem::Mesh::MakeCartesian2D(n[0], n[1], type, true, edge[0], edge[1]);
  }
  const auto type = tensor                               ? Element::HEXAHEDRON
                    : config.kind == BoxCells::simplices ? Element::TETRAHEDRON
                                                         : Element::WEDGE;
  return mfem::Mesh::MakeCartesian3D(n[0], n[1], n[2], type, edge[0], edge[1], edge[2]);
}

/// One region, or one between two interfaces each.
mfem::Mesh make_box(const MeshConfig& config, NamedMesh& named) {
  mfem::Mesh mesh = make_cells(config, named);
  named.regions = {{"body", 1}};
  if (config.interfaces.empty()) return mesh;
  named.regions.clear();
  for (std::size_t k = 0; k <= config.interfaces.size(); ++k)
    named.regions[fmt::format("part {}", k + 1)] = static_cast<int>(k) + 1;
  mfem::Vector centre;
  for (int cell = 0; cell < mesh.GetNE(); ++cell) {
    mesh.GetElementCenter(cell, centre);
    const auto before = std::lower_bound(config.interfaces.begin(), config.interfaces.end(), centre(0));
    mesh.SetAttribute(cell, static_cast<int>(before - config.interfaces.begin()) + 1);
  }
  mesh.SetAttributes();
  return mesh;
}

void scale(mfem::Mesh& mesh, double factor) {
  if (mesh.GetNodes()) *mesh.GetNodes() *= factor;
  for (int i = 0; i < mesh.GetNV(); ++i)
    for (int d = 0; d < mesh.SpaceDimension(); ++d) mesh.GetVertex(i)[d] *= factor;
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
      if (mesh.SpaceDimension() != mesh.Dimension()) {
        section.error("file", fmt::format("file {} holds a surface in space", in_quotes(config.file)),
                      "put a plane body in the plane z = 0, or mesh the volume");
        return {};
      }
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

/// Do the interfaces lie between layers of cells, one behind the other?
bool has_fit_interfaces(const MeshConfig& config, Section& section) {
  const double layer = config.box[0] / config.cells[0];
  double before = 0;
  for (double x : config.interfaces) {
    if (!(x > before && x < config.box[0]))
      section.error("interfaces", fmt::format("{:g} m does not lie beyond {:g} m and inside the box", x, before),
                    "give increasing places between 0 and the first edge of mesh.box");
    else if (std::abs(x / layer - std::round(x / layer)) > same_layer)
      section.error("interfaces", fmt::format("{:g} m lies inside of cells, which are {:g} m long", x, layer),
                    "take another place, or other mesh.cells");
    else {
      before = x;
      continue;
    }
    return false;
  }
  return true;
}

/// Do edges and cells of a box fit together?
bool is_a_box(const MeshConfig& config, Section& section) {
  if (config.box.size() < 2 || config.box.size() > 3)
    section.error("box", fmt::format("has {}", count(double(config.box.size()), "number")),
                  "give 3, or 2 for a plane body");
  else if (*std::min_element(config.box.begin(), config.box.end()) <= 0)
    section.error("box", "the edges of a box must be longer than 0");
  else if (config.cells.size() != config.box.size())
    section.error("cells",
                  fmt::format("has {} for a box of {}", count(double(config.cells.size()), "number"),
                              count(double(config.box.size()), "edge")),
                  "give one for each edge");
  else if (config.kind == BoxCells::wedges && config.box.size() == 2)
    section.error("kind", "a plane body has no wedges", "take tensor or simplices");
  else if (config.kind != BoxCells::simplices && section.has("cuts"))
    section.error("cuts", "only boxes of simplices are cut", "take kind = \"simplices\", or drop it");
  else
    return has_fit_interfaces(config, section);
  return false;
}

/// Does the scene say one mesh, and not none or two?
bool names_one_mesh(const MeshConfig& config, Section& section) {
  const bool has_box = !config.box.empty(), has_file = !config.file.empty();
  if (!has_box && !has_file && (section.has("box") || section.has("file"))) return false;  // reported already
  if (has_box == has_file)
    section.error("", has_box ? "a mesh is either a box or a file, not both" : "no mesh",
                  "give mesh.box (with mesh.cells) or mesh.file");
  else
    return !has_box || is_a_box(config, section);
  return false;
}

double cells_of_box(const MeshConfig& config) {
  const bool plane = config.box.size() == 2, simplices = config.kind == BoxCells::simplices;
  const int parts = config.kind == BoxCells::tensor       ? 1
                    : !simplices                          ? 2
                    : config.cuts == BoxCuts::crossed     ? (plane ? 4 : 24)
                    : plane                               ? 2
                    : config.cuts == BoxCuts::alternating ? 5
                                                          : 6;
  return std::accumulate(config.cells.begin(), config.cells.end(), double(parts), std::multiplies<>());
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

}  // namespace

void MeshConfig::bind(Section& s) {
  s.read("box", box,
         {.unit = "m",
          .range = non_negative,
          .doc = "edge lengths of a box, two for a plane one; boundaries x-, x+, y-, y+, z-, z+, region body"});
  if (cells.empty()) cells.assign(box.size(), 1);
  s.read("cells", cells, {.range = {.min = 1, .max = 1e4}, .doc = "cells of the box along x, y, z (default: one)"});
  s.choose(
      "kind", kind, {{"tensor", BoxCells::tensor}, {"simplices", BoxCells::simplices}, {"wedges", BoxCells::wedges}},
      {.doc = "cells of the box: hexahedra or quadrilaterals; each cut into tetrahedra or triangles (cuts); or into "
              "2 wedges"});
  s.choose(
      "cuts", cuts, {{"same", BoxCuts::same}, {"alternating", BoxCuts::alternating}, {"crossed", BoxCuts::crossed}},
      {.doc =
           "of a box into simplices: along one diagonal and the other in turn (2 triangles, 5 tetrahedra), each around "
           "its middle, alike in all directions (4, 24), or all along the same diagonal (2, 6), where finite volumes "
           "lock"});
  s.read("interfaces", interfaces,
         {.unit = "m",
          .range = positive,
          .doc = "planes across x that part the box into regions: \"part 1\", \"part 2\", ... instead of body"});
  s.read("file", file, {.doc = "Gmsh 2.2 mesh; its physical names name regions and boundaries"});
  s.read("unit", unit, {.unit = "m", .range = positive, .doc = "what a length of 1 in the file is"});
  s.read("thickness", thickness,
         {.unit = "m", .range = positive, .doc = "of a plane body, which keeps it (plane strain)"});
  s.read("refine", refine,
         {.range = {.min = 0, .max = max_refinements},
          .doc = "uniform refinements (each 8 times the cells, 4 times in the plane)"});
}

NamedMesh NamedMesh::read(const MeshConfig& config, Section section) {
  NamedMesh named;
  if (!names_one_mesh(config, section)) return named;
  const bool has_box = config.file.empty();
  const auto growth = [&](std::size_t dimension) { return std::pow(2.0, dimension * config.refine); };
  if (has_box && !has_fit_size(cells_of_box(config), growth(config.box.size()), "cells", section)) return named;
  mfem::Mesh serial = has_box ? make_box(config, named) : load(config, section, named);
  if (serial.GetNE() == 0) return named;
  if (!has_box && !has_fit_size(serial.GetNE(), growth(serial.Dimension()), "file", section)) return named;
  if (serial.Dimension() == 2) named.thickness = config.thickness;
  for (int i = 0; i < config.refine; ++i) serial.UniformRefinement();
  const std::unique_ptr<int[]> rank_of(serial.GeneratePartitioning(ranks()));
  auto mesh = std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial, rank_of.get());
  named.numbers = MeshNumbers(serial, rank_of.get());
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
