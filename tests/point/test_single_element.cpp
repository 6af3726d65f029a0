/// One-element problems of FEBio's test suite (decks ma05, ma20 to ma25, mi43 to mi45, mu02, mu03), which are
/// homogeneous: each is one point. Its answers are norms of the free nodal displacements of a unit cube (of two in a
/// row in mu02).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "points_for_tests.hpp"

namespace titin::testing {
namespace {

// Newton's residual is round-off beside the stiffness; bulk moduli of 1e3 to 1e4 times mu take three or four digits.
constexpr double solved = 1e-10;

double reference(const char* name) {
  const auto all = nlohmann::json::parse(std::ifstream(TITIN_TEST_DATA "/materials/single_element.json"));
  return all.at(name).at("independent");
}

Vec3 sides(const Curves& c) { return {c["F_xx"].back(), c["F_yy"].back(), c["F_zz"].back()}; }

/// Four nodes of a cube move with each of its sides.
double norm_of_free_cube(const Vec3& sides) {
  double sum = 0;
  for (double side : sides) sum += 4 * (side - 1) * (side - 1);
  return std::sqrt(sum);
}

/// A cube that an active second Piola stress of 0.5 contracts, free on all sides.
double contracted(const std::string& matrix, double along, double across) {
  return norm_of_free_cube(sides(run_scene(fmt::format(R"(
[materials.cube]
density = "1 kg/m^3"
fibre = [1, 0, 0]
{}
[materials.cube.terms.active]
law = "active_stress"
peak_stress = "0.5 Pa"
measure = "pk2"
activation = {{ time = "0, 1 s", value = [0, 1] }}
along = {}
across = {}
[point]
loading = "uniaxial"
stress = "0 Pa"
rise = "1 s"
steps = 10
)",
                                                       matrix, along, across))));
}

const std::string neo_hookean =
    "terms.matrix = { law = \"compressible_neo_hookean\", mu = \"0.38461538461538464 Pa\", lambda = "
    "\"0.57692307692307698 Pa\" }";  // E = 1, nu = 0.3
std::string mooney_rivlin(const char* bulk_modulus) {
  return fmt::format(
      "volumetric = {{ law = \"log\", bulk_modulus = \"{} Pa\" }}\n"
      "terms.matrix = {{ law = \"mooney_rivlin\", c1 = \"1 Pa\", c2 = \"0 Pa\" }}",
      bulk_modulus);
}

TEST(SingleElement, ContractsInAllDirections) {
  EXPECT_NEAR(contracted(neo_hookean, 1, 1), reference("ma20_iso_active_NH"), solved);
  EXPECT_NEAR(contracted(mooney_rivlin("5000"), 1, 1), reference("ma21_iso_active_MR"), solved);
}

TEST(SingleElement, ContractsAcrossTheFibre) {
  EXPECT_NEAR(contracted(neo_hookean, 0, 1), reference("ma22_transiso_active_NH(S=T0(I-a0a0))"), solved);
  EXPECT_NEAR(contracted(mooney_rivlin("1000"), 0, 1), reference("ma23_transiso_active_MR"), solved);
}

TEST(SingleElement, ContractsAlongTheFibre) {
  EXPECT_NEAR(contracted(neo_hookean, 1, 0), reference("ma24_uniaxial_active_NH"), solved);
  EXPECT_NEAR(contracted(mooney_rivlin("1000"), 1, 0), reference("ma25_uniaxial_active_MR"), solved);
}

Curves muscle(const char* stretch, const char* optimal_stretch) {
  return run_scene(fmt::format(R"(
[materials.muscle]
density = "1 kg/m^3"
fibre = [1, 0, 0]
volumetric = {{ law = "log", bulk_modulus = "10 MPa" }}
[materials.muscle.terms]
shear = {{ law = "blemker_shear", g1 = "500 Pa", g2 = "500 Pa" }}
fibres = {{ law = "blemker_passive", peak_stress = "300 kPa", optimal_stretch = {}, p1 = 0.05, p2 = 6.6, lambda_straight = 1.4 }}
[point]
loading = "uniaxial"
stretch = {}
steps = 10
)",
                               optimal_stretch, stretch));
}

TEST(SingleElement, MuscleIsStretched) {
  const Curves c = muscle("1.2", "1");
  const double side = sides(c)[1], sigma = c["sigma_xx"].back();
  EXPECT_NEAR(side, reference("mu03_lateral_stretch"), solved);
  EXPECT_NEAR(std::sqrt(8) * (1 - side), reference("mu03_muscle_uniax_1.2"), solved);
  EXPECT_NEAR(sigma / reference("mu03_sigma11_Pa"), 1, solved);
}

TEST(SingleElement, MuscleIsPressed) {
  const double side = sides(muscle("0.995", "1.4"))[1],
               middle = 0.995 - 1;  // of two cubes, whose far end is prescribed
  EXPECT_NEAR(std::sqrt(4 * middle * middle + 12 * (side - 1) * (side - 1)), reference("mu02_muscle_uniax_0.995"),
              solved);
}

TEST(SingleElement, ViscoelasticCubeCreepsToItsEnd) {
  const Curves c = run_scene(R"(
[materials.cube]
density = "1 kg/m^3"
terms.m = { law = "compressible_neo_hookean", mu = "0.5 Pa", lambda = "0 Pa", prony = { strength = [0.95], time = "0.01 s" } }
[point]
loading = "uniaxial"
stress = "0.002 Pa"
program = "hold"
rise = "0.001 s"
end = "1 s"
steps = 100
)");
  EXPECT_NEAR(norm_of_free_cube(sides(c)), reference("ma05_visco_creep_equilibrium"), solved);
}

double grown(const char* growth) {
  return norm_of_free_cube(sides(run_scene(fmt::format(R"(
[materials.cube]
density = "1 kg/m^3"
growth = {{ {} }}
terms.m = {{ law = "compressible_neo_hookean", mu = "0.5 Pa", lambda = "0 Pa" }}
[point]
loading = "uniaxial"
stress = "0 Pa"
steps = 1
)",
                                                       growth))));
}

TEST(SingleElement, GrowsFreely) {
  EXPECT_NEAR(grown(R"(law = "isotropic", stretch = 5)"), reference("mi43_volume_growth"), solved);
  EXPECT_NEAR(grown(R"(law = "area", stretch = 5, normal = [1, 0, 0])"), reference("mi44_area_growth"), solved);
  EXPECT_NEAR(grown(R"(law = "fibre", stretch = 5, direction = [1, 0, 0])"), reference("mi45_fibre_growth"), solved);
}

/// Newton's steps cross the switch of fibres that only pull: back and forth through rest under a prescribed stress.
TEST(TensionOnlyFibres, SwitchWithinNewtonsLoop) {
  const std::pair<const char*, const char*> laws[] = {
      {"goh", R"(k1 = "200 kPa", k2 = 20, kappa = 0.1)"},
      {"goh", R"(k1 = "200 kPa", k2 = 20, kappa = 0.1, switch_width = 1e-4)"},
      {"linear_fibre", R"(stiffness = "10 MPa")"},
      {"weiss_fibre", R"(c3 = "0.57 MPa", c4 = 48, c5 = "467.1 MPa", lambda_straight = 1.062)"},
      {"holzapfel_ogden",
       R"(a = "59 Pa", b = 8.023, af = "18.472 kPa", bf = 16.026, as = "2.481 kPa", bs = 11.12, afs = "216 Pa", bfs = 11.436)"}};
  for (const auto& [law, parameters] : laws) {
    SCOPED_TRACE(law);
    const Curves c = run_scene(fmt::format(R"(
[materials.m]
density = "1000 kg/m^3"
fibre = [1, 0, 0]
second_fibre = [0, 1, 0]
fibre_invariants = "full"
volumetric = {{ law = "simo", bulk_modulus = "1 MPa" }}
[materials.m.terms]
matrix = {{ law = "neo_hookean", mu = "10 kPa" }}
fibres = {{ law = "{}", {} }}
[point]
loading = "uniaxial"
stress = {{ time = "0, 1, 2, 3, 4 s", value = "0, 4, -4, 4, 0 kPa" }}
end = "4 s"
steps = 12
)",
                                           law, parameters));
    EXPECT_EQ(c.table.rows.size(), 49u);
    const std::vector<double> stretch = c["F_xx"];
    for (double iterations : c["newton"]) EXPECT_LE(iterations, 12);
    EXPECT_LT(*std::min_element(stretch.begin(), stretch.end()), 0.95);
    EXPECT_NEAR(stretch.back(), 1, 1e-4);  // the rounded switch pulls a little at rest
  }
}

}  // namespace
}  // namespace titin::testing
