// The block of Almonacid's thesis (section 6.3): fibres at 30 degrees, both ends held, activation rising to 1 within
// 0.1 s. Its rates there, Q2/P1, at 0.2 s: time O(dt); in L2 the displacement O(h^(3/2)), pressure and dilatation O(h),
// below the h^3 and h^2 of smooth solutions because stresses are singular along the edges of the held ends. Here from
// differences between successive meshes and steps, which need no reference: their ratio is 2^order.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double end = 0.2;  // [s]

/// `cells` across the block, three times as many along it.
std::unique_ptr<Muscle> contract(int cells, int steps) {
  auto model = make_block(R"(
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8660254037844386, 0, 0.5]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
[materials.muscle.terms]
base = { law = "yeoh", c1 = "39.81119150206686 kPa", c2 = "73.24669652938298 kPa" }
passive = { law = "hill_passive", peak_stress = "200 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
activation = { time = "0, 0.1 s", value = [0, 1] }
[boundary.ends]
on = ["x-", "x+"]
clamp = true
[solver]
tolerance = 1e-9
)",
                          false, {fmt::format("mesh.cells=[{}, {}, {}]", 3 * cells, cells, cells)});
  for (const Step& step : march(*model, end, end / steps)) {
    EXPECT_EQ(step.failure, "");
    EXPECT_LE(step.newton, 8);
  }
  model->update_fields();
  return model;
}

const std::array<const char*, 3> names = {"displacement", "pressure", "dilatation"};

mfem::ParGridFunction& field(Muscle& model, const std::string& name) {
  for (const Field& field : model.fields())
    if (field.name == name) return *field.values;
  throw std::out_of_range("no field " + name);
}

/// Of each field, in L2, at the points of the finer mesh.
std::array<double, 3> differences(Muscle& coarse, Muscle& fine) {
  std::array<double, 3> square{};
  const CellTables& tables = fine.system().tables();
  for (int cell = 0; cell < tables.cells(); ++cell) {
    const mfem::IntegrationRule& rule = tables.rule(cell);
    mfem::DenseMatrix places(3, rule.GetNPoints());
    fine.mesh().GetElementTransformation(cell)->Transform(rule, places);
    mfem::Array<int> cells;
    mfem::Array<mfem::IntegrationPoint> points;
    coarse.mesh().FindPoints(places, cells, points, false);
    for (int q = 0; q < rule.GetNPoints(); ++q)
      for (std::size_t f = 0; f < names.size(); ++f) {
        mfem::Vector a, b;
        field(fine, names[f]).GetVectorValue(cell, rule.IntPoint(q), a);
        field(coarse, names[f]).GetVectorValue(cells[q], points[q], b);
        a -= b;
        square[f] += tables.weight(cell, q) * (a * a);
      }
  }
  for (double& s : square) s = std::sqrt(sum(s));
  return square;
}

TEST(FixedEndBlock, ConvergesInSpaceAsFarAsTheEdgesOfItsEndsLetIt) {
  constexpr int steps = 5;  // the same on each mesh
  const auto first = contract(1, steps), second = contract(2, steps), third = contract(4, steps);
  const auto coarse = differences(*first, *second), fine = differences(*second, *third);
  std::array<double, 3> order;
  for (std::size_t f = 0; f < names.size(); ++f) {
    order[f] = std::log2(coarse[f] / fine[f]);
    fmt::print("{}: differences {:.3e}, {:.3e}, order {:.2f}\n", names[f], coarse[f], fine[f], order[f]);
  }
  EXPECT_GT(order[0], 1.5);
  EXPECT_LT(order[0], 2.5) << "smooth solutions have 3";
  for (int f : {1, 2}) {
    EXPECT_GT(order[f], 0.45) << names[f];
    EXPECT_LT(order[f], 1.5) << names[f] << ": smooth solutions have 2";
  }
}

TEST(FixedEndBlock, ConvergesInTimeAtFirstOrder) {
  const auto first = contract(1, 10), second = contract(1, 20), third = contract(1, 40);
  const auto coarse = differences(*first, *second), fine = differences(*second, *third);
  for (std::size_t f = 0; f < names.size(); ++f) {
    const double order = std::log2(coarse[f] / fine[f]);
    fmt::print("{}: differences {:.3e}, {:.3e}, order {:.2f}\n", names[f], coarse[f], fine[f], order);
    EXPECT_NEAR(order, 1, 0.15) << names[f];
  }
}

}  // namespace
}  // namespace titin
