// Parameters and fibres that vary in space, and parameters that change in time, in whole bodies with exact answers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double newton_accuracy = 1e-8;  // relative: what solver.tolerance = 1e-10 leaves

const std::string tight = "[solver]\ntolerance = 1e-10\n";
const std::string folder = std::string(TITIN_TEST_DATA) + "/fields/";
/// Nothing moves across the sides of the box.
std::string rollers(bool solid) {
  std::string all;
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
    if (solid || side[0] != 'z') all += fmt::format("[boundary.\"{}\"]\ndisplacement.{} = \"0 mm\"\n", side, side[0]);
  return all;
}

std::unique_ptr<Muscle> make(const std::string& text) {
  Config config(text, "test");
  Section root = config.root(), mesh = root.section("mesh");
  MeshConfig mesh_config;
  mesh_config.bind(mesh);
  NamedMesh named = NamedMesh::read(mesh_config, mesh);
  MuscleConfig muscle;
  muscle.bind(root, named);
  config.finish();
  return std::make_unique<Muscle>(std::move(named), std::move(muscle));
}

/// pk1 pulls along x alone: a stress that changes across the fibres only is in equilibrium with F = I, and the reaction
/// is its integral over the end: 100 kPa + 200 kPa y / 10 mm over 10 x 10 mm.
struct Body {
  const char* name;
  std::string mesh;
  int order = 2;
  bool solid = true;
};

class FieldOfPeakStress : public testing::TestWithParam<Body> {};

TEST_P(FieldOfPeakStress, GivesItsIntegralAsReaction) {
  const Body& body = GetParam();
  const auto model = make(body.mesh + "[muscle]\ninertia = \"quasi-static\"\norder = " + std::to_string(body.order) +
                          "\n" + tight + rollers(body.solid) + R"(
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "1 MPa" }
[materials.muscle.terms]
base = { law = "neo_hookean", mu = "10 kPa" }
[materials.muscle.terms.active]
law = "active_stress"
measure = "pk1"
activation = 1
)" + "peak_stress = { field = \"" +
                          folder + "muscle.csv\", column = \"peak_stress\" }\n");
  const Step step = model->advance(1);
  ASSERT_TRUE(step.ok()) << step.failure;
  EXPECT_LE(step.newton, 1) << "the start is the solution";
  model->accept();
  EXPECT_NEAR(quantity(*model, "reaction_x+_x"), 200e3 * 1e-4, newton_accuracy * 20);
  EXPECT_NEAR(quantity(*model, "reaction_x-_x"), -200e3 * 1e-4, newton_accuracy * 20);
}

const std::string solid_box = "[mesh]\nbox = \"30, 10, 10 mm\"\ncells = [2, 2, 2]\n",
                  plane_box = "[mesh]\nbox = \"30, 10 mm\"\ncells = [2, 2]\nthickness = \"10 mm\"\n";
INSTANTIATE_TEST_SUITE_P(Elements, FieldOfPeakStress,
                         testing::Values(Body{"hexahedra", solid_box},
                                         Body{"tetrahedra", solid_box + "kind = \"simplices\"\n"},
                                         Body{"linear_tetrahedra", solid_box + "kind = \"simplices\"\n", 1},
                                         Body{"wedges", solid_box + "kind = \"wedges\"\n"},
                                         Body{"quadrilaterals", plane_box, 3, false},
                                         Body{"triangles", plane_box + "kind = \"simplices\"\n", 2, false},
                                         Body{"quadrilaterals_and_triangles",
                                              "[mesh]\nfile = \"" + std::string(TITIN_TEST_DATA) +
                                                  "/mesh/mixed_plane.msh\"\nunit = \"1 mm\"\nthickness = \"10 mm\"\n",
                                              2, false}),
                         [](const auto& info) { return info.param.name; });

/// The solver that works on cells sees the same tangent: the same Newton iterations, the same forces.
TEST(Field, IsSeenByTheBlockSolver) {
  const std::string text = "[muscle]\ninertia = \"quasi-static\"\n[boundary.\"x-\"]\nclamp = true\n" +
                           std::string("[boundary.\"x+\"]\ndisplacement.x = \"1 mm\"\n") + muscle_material;
  const Overrides fields = {
      "materials.muscle.volumetric.bulk_modulus=1 MPa", "materials.muscle.terms.active.activation=0.1",
      "materials.muscle.terms.active.peak_stress={field=\"" + folder + "muscle.csv\",column=\"peak_stress\"}",
      "materials.muscle.fibre={field=\"" + folder + "muscle.csv\",columns=[\"ax\",\"ay\",\"az\"]}"};
  std::vector<int> newton;
  std::vector<double> force;
  for (const char* method : {"direct", "block"}) {
    Overrides set = fields;
    set.push_back(std::string("solver.linear=") + method);
    const auto model = make_block(text, false, set);
    const Step step = model->advance(1);
    ASSERT_TRUE(step.ok()) << method << ": " << step.failure;
    model->accept();
    newton.push_back(step.newton);
    force.push_back(quantity(*model, "reaction_x+_x"));
  }
  EXPECT_EQ(newton[1], newton[0]);
  EXPECT_LE(newton[0], 12) << "the turned fibres bend it in one step";
  EXPECT_NEAR(force[1], force[0], 1e-5 * std::abs(force[0]));
}

std::string two_bricks(const std::string& materials) {
  return "[mesh]\nfile = \"" + std::string(TITIN_TEST_DATA) +
         "/mesh/two_bricks.msh\"\nrefine = 1\n[muscle]\ninertia = \"quasi-static\"\n" + tight +
         "[boundary.\"held end\"]\nclamp = true\n[boundary.pulled]\ndisplacement.x = \"0.5 mm\"\n[markers]\np = \"20, "
         "5, "
         "5 "
         "mm\"\n" +
         materials;
}

std::string active(const std::string& name, const std::string& more) {
  return "[materials." + name +
         "]\ndensity = \"1060 kg/m^3\"\nvolumetric = { law = \"simo\", bulk_modulus = \"1 MPa\" }\n" + more +
         "[materials." + name +
         ".terms]\nbase = { law = \"neo_hookean\", mu = \"20 kPa\" }\nactive = { law = "
         "\"hill_active\", activation = 1, peak_stress = \"10 kPa\", max_strain_rate = \"5 1/s\" }\n";
}

TEST(Field, OfFibresIsWhatTwoMaterialsWouldBe) {
  const auto field = make(two_bricks(active(
      "all", "fibre = { field = \"" + folder +
                 "muscle.csv\", columns = [\"ax\", \"ay\", \"az\"], between = \"nearest\", at = \"cells\" }\n")));
  const auto two = make(two_bricks(active("muscle", "regions = [\"muscle\"]\nfibre = [1, 0, 0]\n") +
                                   active("tendon", "regions = [\"tendon\"]\nfibre = [1.7320508075688772, 0, 1]\n")));
  for (Muscle* model : {field.get(), two.get()}) {
    const Step step = model->advance(1);
    ASSERT_TRUE(step.ok()) << step.failure;
    EXPECT_LE(step.newton, 8);
    model->accept();
  }
  const double force = quantity(*two, "reaction_pulled_x");
  EXPECT_GT(std::abs(force), 0.1);
  EXPECT_NEAR(quantity(*field, "reaction_pulled_x"), force, newton_accuracy * std::abs(force));
  EXPECT_NEAR(quantity(*field, "marker_p_uz"), quantity(*two, "marker_p_uz"), newton_accuracy * 1e-3);
  EXPECT_GT(std::abs(quantity(*two, "marker_p_uz")), 1e-5) << "or the turned fibres do nothing";
}

TEST(Field, ThatDoesNotReachEveryPointIsAnError) {
  const std::string text =
      active("muscle", "fibre = { field = \"" + folder +
                           "muscle.csv\", columns = [\"ax\", \"ay\", \"az\"], reach = \"2 mm\" }\n");
  try {
    make_block(text);
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("materials.muscle.fibre.field: the undeformed point ("), std::string::npos) << message;
    EXPECT_NE(message.find("whose places are 0.005 m apart; give values there, or raise reach"), std::string::npos)
        << message;
  }
}

/// Stiffening tissue takes energy from whatever stiffens it: with that, the balance closes at the order of the scheme.
TEST(Curve, OfAModulusBringsTheEnergyItNeeds) {
  const auto loaded = [](double dt) {
    auto model = make_block(
        "[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 1 s\", "
        "value = \"0, 6 mm\" }\n[muscle]\ninertia = \"quasi-static\"\n" +
        tight +
        "[materials.soft]\ndensity = \"1000 kg/m^3\"\nvolumetric = { law = \"simo\", bulk_modulus = "
        "\"500 kPa\" }\n[materials.soft.terms]\nbase = { law = \"neo_hookean\", mu = { time = \"0, 1 "
        "s\", value = \"20, 60 kPa\" } }\n");
    for (const Step& step : march(*model, 1, dt)) {
      EXPECT_TRUE(step.ok()) << step.failure;
      EXPECT_LE(step.newton, 6);
    }
    return model;
  };
  const auto coarse = loaded(0.1), fine = loaded(0.05);
  const double brought = quantity(*fine, "work_parameters_base");
  EXPECT_GT(brought, 0.2 * quantity(*fine, "energy_base"));
  const double error = quantity(*fine, "energy_balance_error");
  EXPECT_NEAR(quantity(*coarse, "energy_balance_error") / error, 2, 0.15) << "first order";
}

}  // namespace
}  // namespace titin
