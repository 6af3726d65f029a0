#include "mesh/markers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {

bool was_read(const std::array<double, 3>& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

std::string bounds_of(mfem::ParMesh& mesh) {
  mfem::Vector lower, upper;
  mesh.GetBoundingBox(lower, upper);
  return fmt::format("the mesh lies between ({:.4g}) and ({:.4g}) m", fmt::join(lower, ", "), fmt::join(upper, ", "));
}

namespace {

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
                    "move it inside: " + bounds_of(mesh));
  }
}

}  // namespace

std::vector<MarkerConfig> read_markers(Section& root, const NamedMesh& mesh) {
  Section points = root.section("markers",
                                "points whose displacement is followed: NAME = \"x, y, z mm\" (of a plane body \"x, y "
                                "mm\", of a rod \"x mm\"), undeformed");
  std::vector<MarkerConfig> markers;
  for (const std::string& name : points.names()) {
    MarkerConfig marker{name, {}, -1, {}};
    if (!points.describing()) marker.position.fill(unread);
    read_vector(points, name, marker.position, {.unit = "m", .doc = "position in the undeformed body"}, mesh);
    markers.push_back(marker);
  }
  if (mesh.mesh && !markers.empty()) find_markers(markers, *mesh.mesh, points);
  return markers;
}

}  // namespace titin
