/// The map of ellipticity: what it is a map of. The values themselves: tests/materials/test_ellipticity.cpp.
#include "point/ellipticity_map.hpp"

#include "points_for_tests.hpp"

namespace titin::testing {
namespace {

Curves map(const Words& overrides) {
  static const std::string muscle = R"(
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "neo_hookean", mu = "20 kPa" }
terms.active = { law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.3, curve = "degroote" }
[point.map]
stretch = [0.9, 1.3]
stretch_points = 3
activation_points = 5
)";
  return {ellipticity_map({muscle, "test.toml", overrides})};
}

TEST(EllipticityMap, LosesMoreWithMoreActivationOnTheDescendingLimb) {
  const Curves m = map({});
  const auto stretch = m["stretch"], activation = m["activation"], value = m["legendre_hadamard"], angle = m["angle"];
  ASSERT_EQ(value.size(), 15u);
  EXPECT_DOUBLE_EQ(stretch[2], 1.3);
  EXPECT_DOUBLE_EQ(activation[14], 1);
  for (std::size_t row = 1; row < 5; ++row) EXPECT_LT(value[3 * row + 2], value[3 * row - 1]);
  EXPECT_GT(value[2], 0);
  EXPECT_LT(value[14], 0);
  EXPECT_GT(angle[14], 20);  // the band is neither along the fibres nor across
  EXPECT_LT(angle[14], 70);
}

TEST(EllipticityMap, OfAPassiveMaterialHasOneRow) {
  EXPECT_EQ(map({"materials.muscle.terms.active={ law = \"neo_hookean\", mu = \"1 kPa\" }"}).table.rows.size(), 3u);
}

TEST(EllipticityMap, FollowsTheLoading) {
  const Curves m = map({"point.loading=simple_shear", "point.map.stretch=[0, 0.4]"});
  EXPECT_EQ(m["stretch"].front(), 0);
  const Curves again = map({"point.loading=planar"});
  EXPECT_NE(again["legendre_hadamard"].back(), map({})["legendre_hadamard"].back());
}

}  // namespace
}  // namespace titin::testing
