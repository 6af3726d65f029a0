// The formulation as a model: what a scene says of it, its quantities, what it keeps, its errors.
#include <gtest/gtest.h>

#include <map>

#include "flows_for_tests.hpp"
#include "fv/lagrange.hpp"
#include "solve/clock.hpp"

namespace titin {
namespace {

using namespace test;

template <int D>
std::unique_ptr<Model> make_model(const std::string& scene, int n) {
  NamedMesh mesh;
  mesh.mesh = unit_box<D>(n);
  mesh.regions = {{"body", 1}};
  if (D == 2)
    mesh.boundaries = {{"y-", 1}, {"x+", 2}, {"y+", 3}, {"x-", 4}};
  else
    mesh.boundaries = {{"z-", 1}, {"y-", 2}, {"x+", 3}, {"y+", 4}, {"x-", 5}, {"z+", 6}};
  Config text(scene, "test.toml");
  Section root = text.root();
  LagrangeConfig config;
  config.bind(root, mesh);
  text.finish();
  return make_lagrange(std::move(mesh), std::move(config));
}

void march(Model& model, double end) {
  while (model.time() < end * (1 - 1e-12)) {
    const Step step = model.advance(std::min(model.largest_dt(), end - model.time()));
    ASSERT_TRUE(step.ok()) << step.failure;
    model.accept();
  }
}

std::map<std::string, double> values(const std::vector<Quantity>& list) {
  std::map<std::string, double> map;
  for (const Quantity& q : list) map[q.name] = q.value;
  return map;
}

constexpr const char* shock_tube = R"(
exact.solution = "riemann"
fv.limiter = "barth_jespersen"
materials.gas.fluid = { law = "perfect_gas", gamma = 1.4 }
boundary.sides = { on = ["x-", "x+", "y-", "y+"], wall = true }
)";

TEST(Lagrange, ShockTubeKeepsWhatItMustAndKnowsItsErrors) {
  const auto model = make_model<2>(shock_tube, 20);
  march(*model, 0.1);
  const auto kept = values(model->conservation());
  EXPECT_LT(kept.at("energy_error"), 1e-12);
  EXPECT_LT(kept.at("momentum_error"), 1e-12);
  EXPECT_EQ(kept.at("mass_error"), 0);
  const auto errors = values(model->errors());
  EXPECT_LT(errors.at("density_L1"), 3e-2);
  EXPECT_GT(errors.at("density_L1"), 1e-4) << "a shock was captured, not none made";
  const auto now = values(model->quantities());
  EXPECT_NEAR(now.at("mass"), 0.5 * (1 + 0.125), 1e-13);
  EXPECT_NEAR(now.at("volume"), 1, 1e-12);
  EXPECT_EQ(now.at("energy_elastic"), 0);
  EXPECT_NEAR(now.at("energy_total"), now.at("energy_kinetic") + now.at("energy_internal"), 1e-13);
}

constexpr const char* pulled_block = R"(
[materials.rubber]
density = "1100 kg/m^3"
volumetric = { law = "quad_log", bulk_modulus = "56.7 MPa" }
terms.base = { law = "neo_hookean", mu = "5.86 MPa" }
[boundary."x-"]
velocity = { x = "0 m/s", y = "0 m/s", z = "0 m/s" }
[boundary."x+"]
traction = ["1 MPa", "0 Pa", "0 Pa"]
traction_scale = { time = "0, 1 ms", value = [0, 1] }
[markers]
end = "1, 0.5, 0.5 m"
)";

TEST(Lagrange, PulledBlockFeelsItsTractionAndMoves) {
  const auto model = make_model<3>(pulled_block, 4);
  march(*model, 2e-3);
  const auto now = values(model->quantities());
  EXPECT_NEAR(now.at("force_x+_x"), 1e6, 1e-3);
  EXPECT_GT(now.at("work_boundary"), 0);
  EXPECT_GT(now.at("energy_elastic"), 0);
  EXPECT_GT(now.at("marker_end_ux"), 1e-4);
  EXPECT_LT(values(model->conservation()).at("energy_error"), 1e-12);
  model->update_fields();
  const auto& fields = model->fields();
  EXPECT_EQ(fields.size(), 7u);
  for (const Field& field : fields)
    for (int k = 0; k < field.values->Size(); ++k) EXPECT_TRUE(std::isfinite((*field.values)(k))) << field.name;
}

// A load that is linear between its knots gives exact momentum when steps end at them, since they take it at their
// middle. It starts, turns and ends here at times that no step would meet.
TEST(Lagrange, StepsLandOnTheKnotsOfLoads) {
  std::string scene = pulled_block;
  scene.erase(scene.find("[boundary.\"x-\"]"), scene.find("[boundary.\"x+\"]") - scene.find("[boundary.\"x-\"]"));
  scene.replace(scene.find("traction_scale"), scene.find("[markers]") - scene.find("traction_scale"),
                "traction_scale = { time = \"0.1, 0.23, 0.31 ms\", value = [0, 1, 0] }\n");
  const auto model = make_model<3>(scene, 3);
  ClockConfig config;
  config.by_stability = true;
  config.end = config.step = 1e-3;
  Clock clock(config, model->largest_dt());
  clock.land_on(model->kinks());
  std::vector<double> times;
  while (!clock.done()) {
    const Step step = model->advance(clock.dt());
    ASSERT_TRUE(step.ok()) << step.failure;
    model->accept();
    clock.accept(step, model->largest_dt());
    times.push_back(clock.time());
  }
  for (double knot : {1e-4, 2.3e-4, 3.1e-4}) EXPECT_EQ(std::count(times.begin(), times.end(), knot), 1) << knot;
  EXPECT_LT(times.size(), 60u) << "steps are as long as before after each";
  EXPECT_NEAR(values(model->quantities()).at("momentum_x"), 0.5 * 1e6 * 0.21e-3, 1e-9);
}

TEST(Lagrange, FibresStiffenAlongThemselves) {
  const std::string with_fibres =
      std::string(pulled_block).replace(std::string(pulled_block).find("[boundary"), 0, "fibre = [1, 0, 0]\n");
  std::string fibrous = with_fibres;
  fibrous.insert(fibrous.find("fibre = "), "terms.fibres = { law = \"linear_fibre\", stiffness = \"200 MPa\" }\n");
  const auto plain = make_model<3>(pulled_block, 3), stiff = make_model<3>(fibrous, 3);
  march(*plain, 1.5e-3);
  march(*stiff, 1.5e-3);
  EXPECT_LT(values(stiff->quantities()).at("marker_end_ux"), 0.8 * values(plain->quantities()).at("marker_end_ux"));
}

/// Gas at rest under a pressure pushes at the middle of every side, be it a wall or a load.
TEST(Lagrange, TorqueOfAPressureActsInTheMiddleOfItsSide) {
  const std::string gas = R"(
materials.gas.fluid = { law = "perfect_gas", gamma = 1.4 }
initial.all = { density = "1 kg/m^3", pressure = "200 Pa" }
boundary."x-" = { wall = true }
boundary."y-" = { wall = true }
boundary."x+" = { pressure = "200 Pa" }
boundary."y+" = { wall = true }
)";
  const auto plane = make_model<2>(gas + "torques.\"x+\" = \"0.2, 0.1 m\"\ntorques.\"y-\" = \"0.2, 0.1 m\"", 5);
  march(*plane, 0.01);
  const auto in_plane = values(plane->quantities());
  EXPECT_NEAR(in_plane.at("torque_x+_z"), 0.4 * 200, 1e-10) << "force -200 N/m in x at (1, 0.5)";
  EXPECT_NEAR(in_plane.at("torque_y-_z"), 0.3 * 200, 1e-10) << "force 200 N/m in y at (0.5, 0)";
  EXPECT_EQ(in_plane.count("torque_x+_x"), 0u);
  const auto space = make_model<3>(gas + "boundary.\"z-\" = { wall = true }\nboundary.\"z+\" = { wall = true }\n" +
                                       "torques.\"x+\" = \"0.2, 0.1, 0.4 m\"\ntorques.\"z+\" = \"0.2, 0.1, 0.4 m\"",
                                   3);
  march(*space, 0.01);
  const auto now = values(space->quantities());
  const auto expect = [&](const std::string& name, double x, double y, double z) {
    EXPECT_NEAR(now.at(name + "_x"), x, 1e-10) << name;
    EXPECT_NEAR(now.at(name + "_y"), y, 1e-10) << name;
    EXPECT_NEAR(now.at(name + "_z"), z, 1e-10) << name;
  };
  expect("torque_x+", 0, -200 * 0.1, 200 * 0.4);
  expect("torque_z+", -200 * 0.4, 200 * 0.3, 0);
}

/// A dead traction goes with its side: a block that flies has it where it has flown to in the middle of the step.
TEST(Lagrange, TorqueOfATractionGoesWithItsSide) {
  const auto model = make_model<3>(R"(
[materials.rubber]
density = "1100 kg/m^3"
volumetric = { law = "quad_log", bulk_modulus = "56.7 MPa" }
terms.base = { law = "neo_hookean", mu = "5.86 MPa" }
[initial.all]
velocity = ["0 m/s", "100 m/s", "0 m/s"]
[boundary."x+"]
traction = ["1 Pa", "0 Pa", "0 Pa"]
[torques]
"x+" = "0, 0, 0 m"
)",
                                   3);
  for (int n = 0; n < 3; ++n) {
    const double t = model->time(), dt = model->largest_dt();
    ASSERT_TRUE(model->advance(dt).ok());
    model->accept();
    const auto now = values(model->quantities());
    EXPECT_NEAR(now.at("torque_x+_x"), 0, 1e-6);
    EXPECT_NEAR(now.at("torque_x+_y"), 0.5, 1e-6) << "the traction hardly deforms it";
    EXPECT_NEAR(now.at("torque_x+_z"), -(0.5 + 100 * (t + 0.5 * dt)), 1e-6);
  }
}

/// A shock tube before the waves meet a box, and a block that flies with one velocity.
TEST(Lagrange, MeansAreThoseOfTheCellsThatABoxHeldAtTheStart) {
  const auto tube = make_model<2>(std::string(shock_tube) + R"(
[averages.left]
lower = "0, 0 m"
upper = "0.1, 1 m"
[averages.middle]
lower = "0.25, 0 m"
upper = "0.75, 1 m"
[averages.all]
lower = "0, 0 m"
upper = "1, 1 m"
)",
                                  20);
  march(*tube, 0.1);
  const auto now = values(tube->quantities());
  EXPECT_NEAR(now.at("mean_density_left"), 1, 1e-6) << "no wave has come";
  EXPECT_NEAR(now.at("mean_pressure_left"), 1, 1e-6);
  EXPECT_NEAR(now.at("mean_velocity_left_x"), 0, 1e-6);
  EXPECT_NEAR(now.at("mean_density_all"), now.at("mass") / now.at("volume"), 1e-13);
  EXPECT_NEAR(now.at("mean_velocity_all_x"), now.at("momentum_x") / now.at("mass"), 1e-13);
  EXPECT_NEAR(now.at("mean_pressure_all"), 0.4 * now.at("energy_internal"), 1e-12) << "(gamma - 1) rho e, volume 1";
  // Nothing passes the box's ends yet but the pressure beside it: 1 on the left, 0.1 on the right, for 0.1 s.
  EXPECT_NEAR(now.at("mean_velocity_middle_x") * 0.5 * 0.5 * 1.125, 0.1 * 0.9, 2e-3);
}

std::string errors_of(const std::string& scene) {
  try {
    make_model<2>(scene, 2);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Lagrange, BadInputIsReported) {
  EXPECT_NE(errors_of("materials.gas.fluid = { law = \"perfect_gas\" }").find("nothing says how dense"),
            std::string::npos);
  EXPECT_NE(errors_of(std::string(shock_tube) + "boundary.top = { wall = true }").find("has no boundary"),
            std::string::npos);
  EXPECT_NE(errors_of(std::string(shock_tube) + "initial.a = { regions = [\"head\"] }").find("has no region"),
            std::string::npos);
  EXPECT_NE(errors_of("exact.solution = \"riemann\"").find("no material"), std::string::npos);
}

}  // namespace
}  // namespace titin
