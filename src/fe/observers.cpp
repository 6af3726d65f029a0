#include "fe/observers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace titin {
namespace {

/// A cell's centre on the border of a box counts as inside: this part of the box's size is round-off of the mesh.
constexpr double border = 1e-9;
constexpr const char* axes[] = {"x", "y", "z"};
constexpr double unread = std::numeric_limits<double>::quiet_NaN();  // what is wrong already is not judged once more

bool was_read(const std::array<double, 3>& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

bool inside(const AverageConfig& box, const mfem::Vector& x) {
  for (int d = 0; d < x.Size(); ++d) {
    const double margin = border * (box.upper[d] - box.lower[d]);
    if (x(d) < box.lower[d] - margin || x(d) > box.upper[d] + margin) return false;
  }
  return true;
}

std::string bounds(mfem::ParMesh& mesh) {
  mfem::Vector lower, upper;
  mesh.GetBoundingBox(lower, upper);
  return fmt::format("the mesh lies between ({:.4g}) and ({:.4g}) m", fmt::join(lower, ", "), fmt::join(upper, ", "));
}

void find_markers(std::vector<MarkerConfig>& markers, mfem::ParMesh& mesh, Section& section) {
  mfem::DenseMatrix points(mesh.Dimension(), static_cast<int>(markers.size()));
  for (std::size_t m = 0; m < markers.size(); ++m)
    for (int d = 0; d < mesh.Dimension(); ++d)
      points(d, m) = was_read(markers[m].position) ? markers[m].position[d] : 0.0;
  mfem::Array<int> cells;
  mfem::Array<mfem::IntegrationPoint> places;
  mesh.FindPoints(points, cells, places, false);  // on the lowest rank of those that share it
  for (std::size_t m = 0; m < markers.size(); ++m) {
    if (cells[m] >= 0) {
      markers[m].cell = cells[m];
      markers[m].place = places[m];
    }
    if (!any_of(cells[m] >= 0) && was_read(markers[m].position))
      section.error(markers[m].name,
                    fmt::format("the point ({:.4g}) m is not in the mesh", fmt::join(markers[m].position, ", ")),
                    "move it inside: " + bounds(mesh));
  }
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
    section.error("", "the box holds the centre of no cell", "make it larger, or refine the mesh: " + bounds(mesh));
}

}  // namespace

std::vector<MarkerConfig> read_markers(Section& root, const NamedMesh& mesh) {
  Section points = root.section("markers", "points whose displacement is followed: NAME = \"x, y, z mm\", undeformed");
  std::vector<MarkerConfig> markers;
  for (const std::string& name : points.names()) {
    MarkerConfig marker{name, {}, -1, {}};
    if (!points.describing()) marker.position.fill(unread);
    points.read(name, marker.position, {.unit = "m", .doc = "position in the undeformed body"});
    markers.push_back(marker);
  }
  if (mesh.mesh && !markers.empty()) find_markers(markers, *mesh.mesh, points);
  return markers;
}

std::vector<AverageConfig> read_averages(Section& root, const NamedMesh& mesh) {
  std::vector<AverageConfig> averages;
  root.each("averages", "means over the cells whose centre lies in a box", [&](const std::string& name, Section s) {
    AverageConfig average{name, {}, {}, {}};
    if (!s.describing()) average.lower.fill(unread), average.upper.fill(unread);
    s.read("lower", average.lower, {.unit = "m", .required = true, .doc = "lower corner of the box"});
    s.read("upper", average.upper, {.unit = "m", .required = true, .doc = "upper corner of the box"});
    const bool complete = was_read(average.lower) && was_read(average.upper);
    if (mesh.mesh && complete && has_corners(average, s)) find_cells(average, *mesh.mesh, s);
    averages.push_back(average);
  });
  return averages;
}

}  // namespace titin
