#include "mesh/averages.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/parallel.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {
namespace {

/// A cell's centre on the border of a box counts as inside: this part of the box's size is round-off of the mesh.
constexpr double border = 1e-9;
constexpr const char* axes[] = {"x", "y", "z"};

bool inside(const AverageConfig& box, const mfem::Vector& x) {
  for (int d = 0; d < x.Size(); ++d) {
    const double margin = border * (box.upper[d] - box.lower[d]);
    if (x(d) < box.lower[d] - margin || x(d) > box.upper[d] + margin) return false;
  }
  return true;
}

/// False when the box is turned around.
bool has_corners(const AverageConfig& box, Section& section) {
  for (int d = 0; d < 3; ++d) {
    if (box.lower[d] <= box.upper[d]) continue;
    section.error("upper", fmt::format("is below lower in {}", axes[d]), "exchange the two");
    return false;
  }
  return true;
}

void find_cells(AverageConfig& box, mfem::ParMesh& mesh, Section& section) {
  mfem::Vector centre(mesh.Dimension());
  for (int cell = 0; cell < mesh.GetNE(); ++cell) {
    const auto& middle = mfem::Geometries.GetCenter(mesh.GetElementGeometry(cell));
    mesh.GetElementTransformation(cell)->Transform(middle, centre);
    if (inside(box, centre)) box.cells.push_back(cell);
  }
  if (!any_of(!box.cells.empty()))
    section.error("", "the box holds the centre of no cell", "make it larger, or refine the mesh: " + bounds_of(mesh));
}

}  // namespace

std::vector<AverageConfig> read_averages(Section& root, const NamedMesh& mesh) {
  std::vector<AverageConfig> averages;
  root.each("averages", "means over the cells whose centre lies in a box", [&](const std::string& name, Section s) {
    AverageConfig average{name, {}, {}, {}};
    if (!s.describing()) average.lower.fill(unread), average.upper.fill(unread);
    read_vector(s, "lower", average.lower, {.unit = "m", .required = true, .doc = "lower corner of the box"}, mesh);
    read_vector(s, "upper", average.upper, {.unit = "m", .required = true, .doc = "upper corner of the box"}, mesh);
    const bool complete = was_read(average.lower) && was_read(average.upper);
    if (mesh.mesh && complete && has_corners(average, s)) find_cells(average, *mesh.mesh, s);
    averages.push_back(average);
  });
  return averages;
}

}  // namespace titin
