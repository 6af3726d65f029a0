// What advise is made of: probes, the facts of a scene, and proposals whose answer is known.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "scene/advise.hpp"
#include "scene/probe.hpp"
#include "scene/scene_facts.hpp"
#include "uniform_block.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

/// Held between z- and z+ as well: plane.
const std::string plane_block = std::string(uniform_block) + R"([boundary."z+"]
displacement.z = "0 mm"
)";

/// A rod of rubber, its end moved by `table`.
std::string rod(const std::string& time, const std::string& table) {
  return R"(model = "rod"
[rod]
length = "100 mm"
area = "1 cm^2"
cells = 20
[materials.base]
density = "1060 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "1 MPa"}
terms.base = {law = "neo_hookean", mu = "200 kPa"}
[boundary."x-"]
displacement.x = "0 mm"
[markers]
middle = "50 mm"
[time]
)" + time +
         "[boundary.\"x+\"]\ndisplacement.x = " + table;
}

/// A plate of rubber that swings between slippery walls.
const std::string explicit_plate = R"(model = "lagrange"
[mesh]
box = "2, 2 m"
cells = [64, 64]
kind = "simplices"
cuts = "crossed"
[time]
end = "10 ms"
[materials.rubber]
density = "1100 kg/m^3"
volumetric = {law = "quad_log", bulk_modulus = "56.67 MPa"}
terms.base = {law = "neo_hookean", mu = "5.862 MPa"}
[initial.swing]
motion = "swing"
rate = 0.081
length = "2 m"
[boundary.walls]
on = ["x-", "x+", "y-", "y+"]
wall = true
)";

class Advice : public testing::Test {
 protected:
  fs::path folder;
  std::string scene;
  void SetUp() override {
    logging::set_level(logging::Level::quiet);
    folder = fs::path(testing::TempDir()) / ("titin_advise_np" + std::to_string(ranks()));
    scene = (folder / "block.toml").string();
    if (is_root()) {
      fs::remove_all(folder);
      fs::create_directories(folder);
      std::ofstream(scene) << plane_block;
    }
    any_of(false);
  }
  void TearDown() override {
    any_of(false);
    if (is_root()) fs::remove_all(folder);
  }
  void rewrite(const std::string& text) const {
    any_of(false);
    if (is_root()) std::ofstream(scene) << text;
    any_of(false);
  }
  std::string proposed(AdviseOptions options) const {
    options.scene_file = scene;
    options.apply = (folder / "proposed.toml").string();
    advise(options);
    any_of(false);
    std::stringstream text;
    text << std::ifstream(options.apply).rdbuf();
    return text.str();
  }
};

TEST_F(Advice, ProbesFollowAQuantity) {
  const Probe fine = probe(scene, {"time.step=10 ms"}, "reaction_x+_x");
  const Probe coarse = probe(scene, {"time.step=0.1 s"}, "reaction_x+_x");
  EXPECT_EQ(fine.times.size(), 101u);
  EXPECT_EQ(fine.steps, 100);
  EXPECT_EQ(fine.order, 2);
  EXPECT_EQ(difference(fine, fine), 0);
  EXPECT_LT(difference(coarse, fine), 1e-2) << "slow: inertia hardly matters";
  EXPECT_NEAR(fine.values.back(), fine.largest, 1e-12 * fine.largest);
}

TEST_F(Advice, SaysWhichQuantitiesThereAre) {
  try {
    probe(scene, {}, "reaction_x+_q");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().front(), "this run follows no \"reaction_x+_q\"; did you mean \"reaction_x+_x\"?");
  }
  EXPECT_THROW(advise({.scene_file = scene,
                       .overrides = {"muscle.inertia=quasi-static", "~time.scheme"},
                       .quantity = "reaction_x+_y"}),
               InputError)
      << "zero: free to slide";
}

TEST_F(Advice, ProposesWhatAUniformStateNeeds) {
  const std::string text = proposed({.quantity = "reaction_x+_x", .tolerance = 0.05});
  EXPECT_NE(text.find("inertia = \"quasi-static\""), std::string::npos) << text;
  EXPECT_NE(text.find("box = \"0.02, 0.01 m\""), std::string::npos) << "plane\n" << text;
  EXPECT_NE(text.find("cells = [2, 1]"), std::string::npos) << text;
  const Probe truth = probe(scene, {"time.step=10 ms"}, "reaction_x+_x");
  const Probe cheap = probe((folder / "proposed.toml").string(), {}, "reaction_x+_x");
  EXPECT_LT(difference(cheap, truth), 0.05);
  EXPECT_LT(cheap.unknowns * cheap.steps, truth.unknowns * truth.steps / 20);
}

TEST_F(Advice, KeepsInertiaWhereItMatters) {
  const std::string text = proposed({.overrides = {"time.end=1 ms", "time.step=20 us",
                                                   "boundary.\"x+\".displacement.x={time "
                                                   "= \"0, 1 ms\", value = \"0, 3 mm\"}"},
                                     .quantity = "reaction_x-_x",
                                     .tolerance = 0.1});
  EXPECT_NE(text.find("inertia = \"dynamic\""), std::string::npos) << "a wave takes 0.9 ms along it\n" << text;
}

/// Backward Euler with 1 ms leaves no waves, the step that is proposed does: 10 cells are not enough for them.
TEST_F(Advice, MeasuresTheMeshWithTheStepThatItProposes) {
  rewrite(rod("end = \"30 ms\"\nstep = \"1 ms\"\nscheme = \"backward_euler\"\n",
              "{time = \"0, 20 ms\", value = \"0, 10 mm\"}\n"));
  const Proposal found = find_advice({.scene_file = scene, .quantity = "reaction_x+_x", .tolerance = 0.02});
  const Probe truth = probe(scene, {"rod.cells=160", "time.step=20 us"}, "reaction_x+_x");
  const Probe cheap = probe(scene, found.proposal, "reaction_x+_x");
  EXPECT_LT(difference(cheap, truth), found.error);
  EXPECT_GT(cheap.cells, 40);
  EXPECT_FALSE(found.reached);
}

/// Steps of 0.4, 0.8 and 1.6 ms see little of a pulse of 2 ms.
TEST_F(Advice, HalvesStepsThatAreTooLongToShowTheOrder) {
  rewrite(rod("end = \"8 ms\"\nstep = \"0.4 ms\"\nscheme = \"newmark\"\n",
              "{time = \"0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8, 2 ms\", value = [0, 0.095492, 0.345492, "
              "0.654508, 0.904508, 1, 0.904508, 0.654508, 0.345492, 0.095492, 0], scale = \"0.01 mm\"}\n"));
  const Proposal found = find_advice({.scene_file = scene, .quantity = "marker_middle_ux", .tolerance = 0.1});
  const Probe truth = probe(scene, {"rod.cells=160", "time.step=10 us"}, "marker_middle_ux");
  const Probe cheap = probe(scene, found.proposal, "marker_middle_ux");
  EXPECT_LT(difference(cheap, truth), found.error);
  EXPECT_TRUE(found.reached);
  EXPECT_LT(cheap.steps, 250) << "a sixteenth of the step has 320";
}

/// 8 x 8 cells are what 3000 unknowns allow, and show no order; a twentieth of a run on 64 x 64
/// allows 16 x 16, a second perhaps more.
TEST_F(Advice, ProbesExplicitCellsThatAreFineEnough) {
  rewrite(explicit_plate);
  const Proposal found = find_advice({.scene_file = scene, .quantity = "energy_kinetic", .tolerance = 0.1});
  EXPECT_EQ(found.report[1].find("probes on 8 x 8 cells"), std::string::npos) << found.report[1];
  EXPECT_TRUE(found.reached);
  EXPECT_LE(probe(scene, found.proposal, "energy_kinetic").cells, 4 * 24 * 24);
}

/// Four times as long, three steps, would do but for the kink at 0.3 s, which steps of 0.1 s meet.
TEST_F(Advice, ProposesStepsThatMeetKinks) {
  const std::string text =
      proposed({.overrides = {"time.step=0.1 s", "muscle.inertia=quasi-static", "~time.scheme",
                              "boundary.\"x+\".displacement.x={time = \"0, 0.3, 1 s\", value = \"0, 3, 0 mm\"}"},
                .quantity = "reaction_x+_x",
                .tolerance = 0.5});
  EXPECT_NE(text.find("step = \"0.1 s\""), std::string::npos) << text;
}

/// Up front: before it is known whether there is a scene at all.
TEST_F(Advice, LeavesAFileThatIsThere) {
  const std::string file = folder / "mine.toml";
  if (is_root()) std::ofstream(file) << "mine";
  any_of(false);
  try {
    advise({.scene_file = folder / "nothing.toml", .apply = file});
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.messages().size(), 1u);
    EXPECT_EQ(error.messages().front(), "\"" + file + "\" is there already; name another file with --apply");
  }
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(), "mine");
}

TEST(SceneFacts, ReadsSettings) {
  const SceneFacts facts(
      {"mesh.box = \"0.02, 0.01 m\"", "mesh.cells = [4, 2]", "muscle.inertia = \"dynamic\"", "time.step = \"0.05 s\""});
  EXPECT_EQ(facts.numbers("mesh.box"), (std::vector{0.02, 0.01}));
  EXPECT_EQ(facts.numbers("mesh.cells"), (std::vector{4.0, 2.0}));
  EXPECT_EQ(facts.text("muscle.inertia"), "dynamic");
  EXPECT_EQ(facts.number("time.step"), 0.05);
  EXPECT_TRUE(std::isnan(facts.number("time.end")));
  EXPECT_EQ(facts.below("mesh."), (std::vector<std::string>{"mesh.box", "mesh.cells"}));
}

}  // namespace
}  // namespace titin
