#include "fe/bubble_element.hpp"

#include <algorithm>
#include <numeric>

namespace titin {
namespace {

using mfem::Geometry;

constexpr int most_corners = 4;

/// Corners of the edges and faces as MFEM numbers them, then of the cell.
template <class Constants>
std::vector<std::vector<int>> edges_of() {
  std::vector<std::vector<int>> list;
  for (int e = 0; e < Constants::NumEdges; ++e) list.push_back({Constants::Edges[e][0], Constants::Edges[e][1]});
  return list;
}

std::vector<std::vector<int>> faces_of_tetrahedron() {
  using Constants = Geometry::Constants<Geometry::TETRAHEDRON>;
  std::vector<std::vector<int>> list;
  for (const auto& face : Constants::FaceVert) list.push_back({face[0], face[1], face[2]});
  return list;
}

/// l_0 = 1 - x - y - z, l_1 = x, ...
void barycentric(const mfem::IntegrationPoint& point, int dimension, double* l) {
  const double x[] = {point.x, point.y, point.z};
  std::copy_n(x, dimension, l + 1);
  l[0] = std::accumulate(x, x + dimension, 1.0, std::minus<>());
}

double slope_of_barycentric(int i, int d) { return i == 0 ? -1.0 : i == d + 1 ? 1.0 : 0.0; }

int degree(Geometry::Type geometry, BubbleSet bubbles) {
  for (int d = Geometry::Dimension[geometry]; d > 0; --d)
    if (bubbles.has(d)) return d + 1;
  return 1;
}

}  // namespace

/// In MFEM's order of dofs: vertices, edges, faces, inside.
std::vector<BubbleElement::Corners> BubbleElement::functions(Geometry::Type geometry, BubbleSet bubbles) {
  const int corners = Geometry::Dimension[geometry] + 1;
  std::vector<Corners> list;
  for (int i = 0; i < corners; ++i) list.push_back({i});
  const auto append = [&](const std::vector<Corners>& more) { list.insert(list.end(), more.begin(), more.end()); };
  if (bubbles.edges && geometry == Geometry::TRIANGLE) append(edges_of<Geometry::Constants<Geometry::TRIANGLE>>());
  if (bubbles.edges && geometry == Geometry::TETRAHEDRON)
    append(edges_of<Geometry::Constants<Geometry::TETRAHEDRON>>());
  if (bubbles.faces && geometry == Geometry::TETRAHEDRON) append(faces_of_tetrahedron());
  Corners all(corners);
  std::iota(all.begin(), all.end(), 0);
  if (bubbles.has(corners - 1)) list.push_back(all);
  return list;
}

BubbleElement::BubbleElement(Geometry::Type geometry, BubbleSet bubbles)
    : NodalFiniteElement(Geometry::Dimension[geometry], geometry, static_cast<int>(functions(geometry, bubbles).size()),
                         degree(geometry, bubbles)),
      functions_(functions(geometry, bubbles)),
      to_nodal_(dof) {
  mfem::DenseMatrix at_nodes(dof);  // product f at node n
  for (int n = 0; n < dof; ++n) {
    double l[most_corners] = {};
    for (int corner : functions_[n]) l[corner] = 1.0 / static_cast<double>(functions_[n].size());
    Nodes.IntPoint(n).Set3(l[1], l[2], l[3]);
    for (int f = 0; f < dof; ++f) at_nodes(f, n) = product(functions_[f], l);
  }
  to_nodal_ = at_nodes;
  to_nodal_.Invert();
}

double BubbleElement::product(const Corners& corners, const double* l, int without) const {
  double value = 1;
  for (int corner : corners)
    if (corner != without) value *= l[corner];
  return value;
}

void BubbleElement::CalcShape(const mfem::IntegrationPoint& point, mfem::Vector& shape) const {
  double l[most_corners];
  barycentric(point, dim, l);
  mfem::Vector products(dof);
  for (int f = 0; f < dof; ++f) products(f) = product(functions_[f], l);
  shape.SetSize(dof);
  to_nodal_.Mult(products, shape);
}

void BubbleElement::CalcDShape(const mfem::IntegrationPoint& point, mfem::DenseMatrix& slope) const {
  double l[most_corners];
  barycentric(point, dim, l);
  mfem::DenseMatrix products(dof, dim);
  products = 0.0;
  for (int f = 0; f < dof; ++f)
    for (int corner : functions_[f])
      for (int d = 0; d < dim; ++d)
        products(f, d) += slope_of_barycentric(corner, d) * product(functions_[f], l, corner);
  slope.SetSize(dof, dim);
  mfem::Mult(to_nodal_, products, slope);
}

BubbleCollection::BubbleCollection(int dimension, BubbleSet bubbles)
    : FiniteElementCollection(degree(dimension == 2 ? Geometry::TRIANGLE : Geometry::TETRAHEDRON, bubbles)),
      bubbles_(bubbles),
      rest_(bubbles.edges ? 2 : 1, dimension) {
  if (bubbles.faces) triangle_ = std::make_unique<BubbleElement>(Geometry::TRIANGLE, bubbles);
  if (dimension == 3) tetrahedron_ = std::make_unique<BubbleElement>(Geometry::TETRAHEDRON, bubbles);
}

const mfem::FiniteElement* BubbleCollection::FiniteElementForGeometry(Geometry::Type geometry) const {
  if (geometry == Geometry::TRIANGLE && triangle_) return triangle_.get();
  if (geometry == Geometry::TETRAHEDRON && tetrahedron_) return tetrahedron_.get();
  return rest_.FiniteElementForGeometry(geometry);
}

int BubbleCollection::DofForGeometry(Geometry::Type geometry) const {
  if (geometry == Geometry::TRIANGLE && triangle_) return 1;
  if (geometry == Geometry::TETRAHEDRON) return bubbles_.cells ? 1 : 0;
  return rest_.DofForGeometry(geometry);
}

const int* BubbleCollection::DofOrderForOrientation(Geometry::Type geometry, int orientation) const {
  static constexpr int alone[] = {0};
  if (geometry == Geometry::TRIANGLE && triangle_) return alone;
  return rest_.DofOrderForOrientation(geometry, orientation);
}

}  // namespace titin
