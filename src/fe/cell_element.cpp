#include "fe/cell_element.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace titin {
namespace {

using mfem::Geometry;

constexpr int max_order = 3;
constexpr CellElement three_field[] = {
    {Geometry::SQUARE, 1, 1, 0, {}, 0},
    {Geometry::SQUARE, 2, 2, 1, {}, 0},
    {Geometry::SQUARE, 3, 3, 2, {}, 0},
    {Geometry::CUBE, 1, 1, 0, {}, 0},
    {Geometry::CUBE, 2, 2, 1, {}, 0},
    {Geometry::CUBE, 3, 3, 2, {}, 0},
    {Geometry::TRIANGLE, 1, 2, 0, {}, 4},
    {Geometry::TRIANGLE, 2, 2, 1, {.edges = true, .faces = true}, 6},
    {Geometry::TETRAHEDRON, 1, 1, 0, {.faces = true}, 5},
    {Geometry::TETRAHEDRON, 2, 2, 1, {.edges = true, .faces = true, .cells = true}, 6},
    {Geometry::PRISM, 2, 2, 0, {}, 4},
};

/// What MFEM calls a geometry, in words.
struct Name {
  Geometry::Type geometry;
  const char* plural;
};
constexpr Name names[] = {{Geometry::TRIANGLE, "triangles"},
                          {Geometry::SQUARE, "quadrilaterals"},
                          {Geometry::TETRAHEDRON, "tetrahedra"},
                          {Geometry::CUBE, "hexahedra"},
                          {Geometry::PRISM, "wedges"}};

const char* plural(Geometry::Type geometry) {
  return std::find_if(std::begin(names), std::end(names), [&](const Name& n) { return n.geometry == geometry; })
      ->plural;
}

bool is_tensor_product(Geometry::Type geometry) {
  return geometry == Geometry::SEGMENT || geometry == Geometry::SQUARE || geometry == Geometry::CUBE;
}

/// Of all ranks: MFEM keeps them as bits (1 simplices, 2 tensor products, 4 wedges).
std::vector<Geometry::Type> geometries_of(const mfem::ParMesh& mesh) {
  const int bits = const_cast<mfem::ParMesh&>(mesh).MeshGenerator();
  const bool solid = mesh.Dimension() == 3;
  std::vector<Geometry::Type> list;
  if (bits & 1) list.push_back(solid ? Geometry::TETRAHEDRON : Geometry::TRIANGLE);
  if (bits & 2) list.push_back(solid ? Geometry::CUBE : Geometry::SQUARE);
  if (bits & 4) list.push_back(Geometry::PRISM);
  return list;
}

/// "orders 1 and 2", of the three-field elements of a geometry.
std::string orders_of(Geometry::Type geometry) {
  std::string list;
  for (const CellElement& element : three_field)
    if (element.geometry == geometry) list += fmt::format("{}{}", list.empty() ? "" : ", ", element.order);
  return list;
}

}  // namespace

const mfem::IntegrationRule& positive_rule(Geometry::Type geometry, int degree) {
  for (;; ++degree) {
    const mfem::IntegrationRule& rule = mfem::IntRules.Get(geometry, degree);
    if (std::all_of(rule.begin(), rule.end(), [](const auto& point) { return point.weight > 0; })) return rule;
  }
}

CellElements::CellElements(Formulation formulation, int order, const mfem::ParMesh& mesh) {
  for (Geometry::Type geometry : geometries_of(mesh)) {
    const auto fits = [&](const CellElement& e) { return e.geometry == geometry && e.order == order; };
    const auto* found = std::find_if(std::begin(three_field), std::end(three_field), fits);
    if (formulation == Formulation::displacement) {
      list_.push_back({geometry, order, order, -1, {}, 2 * order});
    } else if (found != std::end(three_field)) {
      list_.push_back(*found);
    } else {
      problem_ = fmt::format("there is no element of three fields for {} of order {}", plural(geometry), order);
      advice_ = fmt::format("they have order {}", orders_of(geometry));
      return;
    }
  }
  check_that_they_fit();
}

/// Do the displacements of neighbours agree on the sides that they share?
void CellElements::check_that_they_fit() {
  const CellElement& first = list_.front();
  for (const CellElement& element : list_) {
    const bool solid = Geometry::Dimension[element.geometry] == 3;
    if (element.nodal_order == first.nodal_order && !(solid && element.bubbles.faces != first.bubbles.faces)) continue;
    problem_ = fmt::format("{} and {} of order {} do not fit together", plural(first.geometry),
                           plural(element.geometry), element.order);
    advice_ = "mesh with one kind of cells, or take another order";
  }
}

const CellElement& CellElements::of(Geometry::Type geometry) const {
  return *std::find_if(list_.begin(), list_.end(), [&](const CellElement& e) { return e.geometry == geometry; });
}

std::unique_ptr<mfem::FiniteElementCollection> CellElements::collection(int dimension) const {
  for (const CellElement& element : list_)
    if (element.has_bubbles()) return std::make_unique<BubbleCollection>(dimension, element.bubbles);
  return std::make_unique<mfem::H1_FECollection>(list_.front().nodal_order, dimension);
}

const mfem::IntegrationRule& CellElements::rule(Geometry::Type geometry, int points) const {
  return face_rule(geometry, geometry, points);
}

const mfem::IntegrationRule& CellElements::face_rule(Geometry::Type face, Geometry::Type cell, int points) const {
  if (is_tensor_product(face)) return mfem::IntRules.Get(face, 2 * points - 1);
  return positive_rule(face, std::max(2 * (points - 1), of(cell).least_degree));
}

}  // namespace titin
