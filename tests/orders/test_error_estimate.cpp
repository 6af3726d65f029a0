// The estimated error of the stress against the difference from a solution on cells of a third the size, in a block
// that is held at one end and sheared at the other: bent, nearly incompressible, and singular at the held corners.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"
#include "fe/stress_recovery.hpp"
#include "materials/compressible.hpp"

namespace titin {
namespace {

using namespace test;

constexpr int finer = 3;  // cells of the reference along an edge, for each of the tested mesh
constexpr double least_effectivity = 0.5, most_effectivity = 2;  // estimated over true error

struct Case {
  const char* name;
  int dimension;
  const char *kind, *element;
  int order, cells;  // along the height
  int finer = 3;     // cells of the reference along an edge, for each of the tested mesh
};

std::unique_ptr<Muscle> solve(const Case& c, int cells) {
  const bool solid = c.dimension == 3;
  auto model = make_block(
      R"(
[muscle]
inertia = "quasi-static"
error_estimate = true
[materials.soft]
density = "1 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "100 Pa" }
terms.base = { law = "neo_hookean", mu = "1 Pa" }
[boundary."x-"]
clamp = true
[boundary."x+"]
)" + std::string(solid ? "traction = \"0, 0.02, 0 Pa\"\n" : "traction = \"0, 0.02 Pa\"\n"),
      false,
      {solid ? "mesh.box=\"1, 1, 1 m\"" : "mesh.box=\"2, 1 m\"",
       solid ? fmt::format("mesh.cells=[{0}, {0}, {0}]", cells) : fmt::format("mesh.cells=[{}, {}]", 2 * cells, cells),
       fmt::format("mesh.kind=\"{}\"", c.kind), fmt::format("muscle.element=\"{}\"", c.element),
       fmt::format("muscle.order={}", c.order)});
  const Step step = model->advance(1);
  EXPECT_EQ(step.failure, "");
  model->accept();
  model->update_fields();
  return model;
}

mfem::ParGridFunction displacement(Muscle& model) {
  mfem::ParGridFunction u(&model.system().space());
  u.SetFromTrueDofs(model.displacement());
  return u;
}

/// First Piola stress at a point of a cell.
Mat3 stress(Muscle& model, const mfem::ParGridFunction& u, const Case& c, int cell,
            const mfem::IntegrationPoint& point) {
  mfem::ElementTransformation& map = *model.mesh().GetElementTransformation(cell);
  map.SetIntPoint(&point);
  mfem::DenseMatrix slope;
  u.GetVectorGradient(map, slope);
  Mat3 F = identity, P;
  for (int i = 0; i < c.dimension; ++i)
    for (int J = 0; J < c.dimension; ++J) F[3 * i + J] += slope(i, J);
  PointInput in;
  in.n = 1;
  in.F = &F;
  if (c.element == std::string("displacement")) {
    whole_stress(model.system().material(cell), in, &P, nullptr);
    return P;
  }
  model.system().material(cell).stress(in, &P, nullptr);
  for (const Field& field : model.fields())
    if (field.name == "pressure") add(P, field.values->GetValue(cell, point), cofactor(F));
  return P;
}

/// L2 norm of the difference of the stresses of two solutions, at the points of the first.
double difference(Muscle& model, Muscle& reference, const Case& c) {
  const CellTables& tables = model.system().tables();
  const mfem::ParGridFunction u = displacement(model), u_fine = displacement(reference);
  double square = 0;
  for (int cell = 0; cell < tables.cells(); ++cell) {
    const mfem::IntegrationRule& rule = tables.rule(cell);
    mfem::DenseMatrix places(c.dimension, rule.GetNPoints());
    model.mesh().GetElementTransformation(cell)->Transform(rule, places);
    mfem::Array<int> cells;
    mfem::Array<mfem::IntegrationPoint> points;
    reference.mesh().FindPoints(places, cells, points, false);
    for (int q = 0; q < rule.GetNPoints(); ++q) {
      const Mat3 coarse = stress(model, u, c, cell, rule.IntPoint(q)),
                 fine = stress(reference, u_fine, c, cells[q], points[q]);
      for (int i = 0; i < 9; ++i) square += tables.weight(cell, q) * (coarse[i] - fine[i]) * (coarse[i] - fine[i]);
    }
  }
  return std::sqrt(square);
}

class ErrorEstimate : public testing::TestWithParam<Case> {};

TEST_P(ErrorEstimate, IsNearTheDifferenceFromAFinerSolution) {
  const Case& c = GetParam();
  const auto model = solve(c, c.cells), reference = solve(c, c.finer * c.cells);
  const double volume = c.dimension == 3 ? 1 : 2;  // [m^3]
  const double estimate = quantity(*model, "stress_error") * std::sqrt(volume);
  const double error = difference(*model, *reference, c);
  fmt::print("{}: stress off by {:.2e}, relative {:.1e}, effectivity {:.2f}\n", c.name, error,
             quantity(*model, "stress_error_relative"), estimate / error);
  EXPECT_GT(estimate / error, least_effectivity);
  EXPECT_LT(estimate / error, most_effectivity);
  EXPECT_LT(quantity(*reference, "stress_error"), quantity(*model, "stress_error"));
}

INSTANTIATE_TEST_SUITE_P(Elements, ErrorEstimate,
                         testing::Values(Case{"quadrilateral_1", 2, "tensor", "three_field", 1, 6},
                                         Case{"quadrilateral_2", 2, "tensor", "three_field", 2, 4},
                                         Case{"quadrilateral_3", 2, "tensor", "three_field", 3, 4},
                                         Case{"triangle_1", 2, "simplices", "three_field", 1, 6},
                                         Case{"triangle_2", 2, "simplices", "three_field", 2, 4},
                                         Case{"hexahedron_1", 3, "tensor", "three_field", 1, 3},
                                         Case{"hexahedron_2", 3, "tensor", "three_field", 2, 2},
                                         Case{"hexahedron_3", 3, "tensor", "three_field", 3, 2, 2},
                                         Case{"tetrahedron_1", 3, "simplices", "three_field", 1, 2},
                                         Case{"tetrahedron_2", 3, "simplices", "three_field", 2, 2, 2},
                                         Case{"wedge_2", 3, "wedges", "three_field", 2, 2},
                                         Case{"quadrilateral_displacement_2", 2, "tensor", "displacement", 2, 6}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace titin
