#include "mesh/inverted_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

constexpr int inner_points = 5;  // order of the rule: three a direction

/// The first of these points where the cell is inside out, or none.
const mfem::IntegrationPoint* inverted_point(mfem::ElementTransformation& map, const mfem::IntegrationRule& points) {
  for (int k = 0; k < points.GetNPoints(); ++k) {
    map.SetIntPoint(&points.IntPoint(k));
    if (!(map.Weight() > 0)) return &points.IntPoint(k);
  }
  return nullptr;
}

}  // namespace

int inverted_cells(mfem::ParMesh& mesh) {
  int inverted = 0;
  for (int cell = 0; cell < mesh.GetNE(); ++cell)
    inverted += inverted_point(*mesh.GetElementTransformation(cell),
                               mfem::IntRules.Get(mesh.GetElementGeometry(cell), inner_points)) != nullptr;
  return inverted;
}

void warn_of_inverted_corners(const NamedMesh& named) {
  mfem::ParMesh& mesh = *named.mesh;
  long inverted = 0;
  double first = std::numeric_limits<double>::max();  // number of a cell in the whole mesh
  std::vector<double> x(mesh.SpaceDimension(), 0.0);
  for (int cell = 0; cell < mesh.GetNE(); ++cell) {  // in the order of the whole mesh
    auto& map = *mesh.GetElementTransformation(cell);
    const auto* corner = inverted_point(map, *mfem::Geometries.GetVertices(map.GetGeometryType()));
    if (!corner || inverted++ > 0) continue;
    first = static_cast<double>(named.numbers.cell[cell]);
    mfem::Vector place(x.data(), mesh.SpaceDimension());
    map.Transform(*corner, place);
  }
  const long all = sum(inverted);
  if (all == 0) return;
  if (first != min(first)) std::fill(x.begin(), x.end(), 0.0);
  sum(x);
  logging::warning(fmt::format(
      "mesh: {} of {} turned inside out at a corner, the first at ({:.4g}) m: such cells may run on, and are "
      "wrong; move the nodes there until all corners are convex",
      all, count(static_cast<double>(mesh.GetGlobalNE()), "cell"), fmt::join(x, ", ")));
}

}  // namespace titin
