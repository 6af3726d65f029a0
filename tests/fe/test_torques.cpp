// Moments of reactions about points against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

const std::string quasi_static = "[muscle]\ninertia = \"quasi-static\"\n[solver]\ntolerance = 1e-10\n";

std::array<double, 3> triple(Model& model, const std::string& name) {
  return {quantity(model, name + "_x"), quantity(model, name + "_y"), quantity(model, name + "_z")};
}

/// Pulled between planes of symmetry the end has one force, in the middle of the face that has become smaller.
TEST(Torque, OfAPulledBlockActsInTheMiddleOfItsDeformedEnd) {
  const auto model = make_block(quasi_static + R"(
[boundary."x-"]
displacement.x = "0 mm"
[boundary."y-"]
displacement.y = "0 mm"
[boundary."z-"]
displacement.z = "0 mm"
[boundary."x+"]
displacement.x = "9 mm"
[markers]
corner = "30, 10, 10 mm"
[torques]
"x+" = "1, -2, 3 mm"
)" + soft_material);
  ASSERT_TRUE(march(*model, 1, 1).back().ok());
  const double F = quantity(*model, "reaction_x+_x"), side = 0.01 + quantity(*model, "marker_corner_uy");
  ASSERT_LT(side, 0.0095);
  const auto M = triple(*model, "torque_x+");
  constexpr double accuracy = 1e-7;
  EXPECT_NEAR(M[0], 0, accuracy * F * side);
  EXPECT_NEAR(M[1], (side / 2 - 0.003) * F, accuracy * F * side);
  EXPECT_NEAR(M[2], -(side / 2 + 0.002) * F, accuracy * F * side);
}

/// A clamped block that is bent, sheared and pulled at its other end, in equilibrium: forces and moments of both ends
/// cancel, though each is large. The ends' points differ, which r x F makes up for.
TEST(Torque, OfBothEndsBalancesInEquilibriumOfAnyMesh) {
  for (const std::string cells : {"tensor", "simplices"}) {
    const auto model = make_block(quasi_static + R"(
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = { x = "2 mm", y = "8 mm", z = "-5 mm" }
[torques]
"x-" = "0, 0, 0 mm"
"x+" = "7, -4, 11 mm"
)" + soft_material,
                                  false, {"mesh.kind=" + cells});
    ASSERT_TRUE(march(*model, 1, 0.5).back().ok());
    const auto F = triple(*model, "reaction_x+"), held = triple(*model, "torque_x-"), M = triple(*model, "torque_x+");
    const double r[3] = {0.007, -0.004, 0.011};
    const double size = 0.03 * std::hypot(F[0], F[1], F[2]);
    ASSERT_GT(std::abs(held[2]), 0.01 * size) << "the end is bent";
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      EXPECT_NEAR(M[i] + r[j] * F[k] - r[k] * F[j] + held[i], 0, 1e-7 * size) << cells;
    }
  }
}

TEST(Torque, OfAPlaneBodyIsAboutZOnly) {
  const auto model = make_block(quasi_static + R"(
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement = { x = "0 mm", y = "3 mm" }
[torques]
"x+" = "30, 0 mm"
"x-" = "30, 0 mm"
)" + soft_material,
                                false, {"mesh.box=\"30, 10 mm\"", "mesh.cells=[3, 2]"});
  ASSERT_TRUE(march(*model, 1, 0.5).back().ok());
  EXPECT_THROW(quantity(*model, "torque_x+_x"), std::out_of_range);
  const double M = quantity(*model, "torque_x+_z"), F = quantity(*model, "reaction_x+_y");
  EXPECT_GT(std::abs(M), 0.001 * F);
  EXPECT_NEAR(M + quantity(*model, "torque_x-_z"), 0, 1e-7 * 0.03 * F);
}

}  // namespace
}  // namespace titin
