// Gmsh files of every kind of cell, alone and mixed: a bar of 2 x 1 x 1 m (plane: 2 x 1 m) is pulled by a dead traction
// or by a following pressure on its plane end, and must have the one stress that balances it at every point.
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double load = 0.3;        // [Pa] beside a shear modulus of 1 Pa
constexpr double round_off = 1e-9;  // of stresses, after Newton's method to 1e-12

struct Case {
  const char* file;
  int dimension, order, cells;
};

class Meshes : public testing::TestWithParam<Case> {};

std::unique_ptr<Muscle> bar(const Case& c, const std::string& end) {
  const std::string plane = c.dimension == 2 ? "" : "[boundary.\"z-\"]\ndisplacement.z = \"0 m\"\n";
  const std::string text = std::string("[mesh]\nfile = \"") + TITIN_TEST_DATA + "/mesh/" + c.file + ".msh\"\n" + R"(
[materials.soft]
density = "1 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "20 Pa" }
terms.base = { law = "neo_hookean", mu = "1 Pa" }
[boundary."x-"]
displacement.x = "0 m"
[boundary."y-"]
displacement.y = "0 m"
)" + plane + "[boundary.\"x+\"]\n" +
                           end + "\n[muscle]\ninertia = \"quasi-static\"\norder = " + std::to_string(c.order) +
                           "\n[solver]\ntolerance = 1e-12\n";
  Config config(text, "test");
  Section root = config.root();
  MeshConfig mesh;
  MuscleConfig muscle;
  Section section = root.section("mesh");
  mesh.bind(section);
  NamedMesh named = NamedMesh::read(mesh, section);
  muscle.bind(root, named);
  config.finish();
  return std::make_unique<Muscle>(std::move(named), std::move(muscle));
}

/// Calls check(P, F) at every point once the load is on.
template <class Check>
void pull(const Case& c, const std::string& end, Check check) {
  const auto model = bar(c, end);
  EXPECT_EQ(model->mesh().GetGlobalNE(), c.cells);
  const Step step = model->advance(1);
  ASSERT_EQ(step.failure, "");
  EXPECT_LE(step.newton, 8);
  model->accept();
  int points = 0;
  model->system().for_each_cell(model->displacement(),
                                [&](int cell, const Material& material, const ThreeField& kernel) {
                                  std::vector<Mat3> P(kernel.F().size());
                                  const PointInput in = kernel.points(model->system().point_input(cell));
                                  material.stress(in, P.data(), nullptr);
                                  for (int q = 0; q < in.n; ++q, ++points) {
                                    add(P[q], kernel.pressure()[q], cofactor(kernel.F()[q]));
                                    check(P[q], kernel.F()[q]);
                                  }
                                });
  EXPECT_TRUE(any_of(points > 0));
}

TEST_P(Meshes, CarryADeadTraction) {
  const Case& c = GetParam();
  pull(c, c.dimension == 2 ? "traction = \"0.3, 0 Pa\"" : "traction = \"0.3, 0, 0 Pa\"",
       [&](const Mat3& P, const Mat3& F) {
         const int entries = c.dimension == 3 ? 9 : 8;  // a plane body is held in z
         for (int i = 0; i < entries; ++i) EXPECT_NEAR(P[i], i == 0 ? load : 0.0, round_off) << i;
         EXPECT_GT(F[0], 1.05);
       });
}

TEST_P(Meshes, CarryAFollowingPressure) {
  pull(GetParam(), "pressure = \"0.3 Pa\"", [&](const Mat3& P, const Mat3& F) {
    EXPECT_NEAR(P[0], -load * F[4] * F[8], round_off) << "the end's area grows";
    EXPECT_NEAR(P[4], 0, round_off);
    EXPECT_LT(F[0], 0.95);
  });
}

TEST_P(Meshes, NameTheirParts) {
  const Case& c = GetParam();
  const auto model = bar(c, "pressure = \"0 Pa\"");
  double volume[3] = {};
  for (int cell = 0; cell < model->mesh().GetNE(); ++cell)
    volume[model->mesh().GetAttribute(cell) - 10 + 1] += model->mesh().GetElementVolume(cell);
  EXPECT_NEAR(sum(volume[1]), 1, round_off);
  EXPECT_NEAR(sum(volume[2]), 1, round_off);
}

TEST(PlaneBody, SaysWhereAScenesVectorsHaveAThirdComponent) {
  try {
    bar({"square_and_triangles", 2, 2, 3}, "traction = \"0.3, 0, 0 Pa\"\ndisplacement.z = \"0 m\"\n");
    FAIL() << "it was taken";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("traction: has 3 numbers, and the body is plane; give two, x and y"), std::string::npos)
        << text;
    EXPECT_NE(text.find("displacement.z: the body is plane; drop it: nothing moves in z"), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Gmsh, Meshes,
                         testing::Values(Case{"tetrahedra", 3, 1, 12}, Case{"tetrahedra", 3, 2, 12},
                                         Case{"wedges", 3, 2, 4}, Case{"hexahedron_and_wedges", 3, 2, 3},
                                         Case{"square_and_triangles", 2, 2, 3}),
                         [](const auto& info) {
                           return info.param.file + std::string("_") + std::to_string(info.param.order);
                         });

}  // namespace
}  // namespace titin
