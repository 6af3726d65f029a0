// A run that goes on from a checkpoint is the run that never stopped: the same rows of history.csv, character by
// character, whatever formulation, law or clock. Other numbers of ranks: tests/scene/run_restart.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "io/parallel_hdf5.hpp"
#include "scene/run.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

// Inertia, memory, a wall that augments, an active term and a follower load: all that a step leaves to the next.
const char* const muscle = R"(
model = "muscle"
[mesh]
box = "20, 10, 10 mm"
cells = [2, 1, 1]
[time]
end = "30 ms"
step = "2 ms"
scheme = "generalised_alpha"
[materials.gel]
density = "1000 kg/m^3"
fibre = [1, 0.2, 0]
volumetric = {law = "simo", bulk_modulus = "1 MPa"}
[materials.gel.terms.matrix]
law = "neo_hookean"
mu = "20 kPa"
prony = {strength = [0.5], time = "10 ms"}
[materials.gel.terms.active]
law = "hill_active"
peak_stress = "50 kPa"
max_strain_rate = "5 1/s"
activation = {time = "0, 20 ms", value = [0, 1]}
[boundary."x-"]
clamp = true
[boundary."x+"]
pressure = {time = "0, 10 ms", value = "0, 2 kPa"}
[boundary."y-"]
wall = {point = "0, -0.1, 0 mm", normal = [0, 1, 0], penalty = "50 MPa/m", gap_tolerance = "10 um"}
[markers]
tip = "20, 5, 5 mm"
[torques]
"x-" = "3, -2, 1 mm"
[output]
fields = false
)";

const char* const gas = R"(
model = "lagrange"
exact.solution = "riemann"
[mesh]
box = "1, 0.2 m"
cells = [24, 4]
kind = "simplices"
[time]
end = "0.1 s"
[fv]
order = 2
[materials.gas.fluid]
law = "perfect_gas"
gamma = 1.4
[boundary.sides]
on = ["x-", "x+", "y-", "y+"]
wall = true
[output]
fields = false
)";

const char* const solid = R"(
model = "lagrange"
[mesh]
box = "20, 10, 10 mm"
cells = [4, 2, 2]
kind = "simplices"
[time]
end = "0.3 ms"
[materials.rubber]
density = "1000 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "1 MPa"}
terms.matrix = {law = "neo_hookean", mu = "200 kPa"}
[boundary."x-"]
wall = true
[boundary."x+"]
pressure = "50 kPa"
[torques]
"x-" = "3, -2, 1 mm"
[averages.front]
lower = "10, 0, 0 mm"
upper = "20, 10, 10 mm"
[output]
fields = false
)";

class Restarts : public testing::Test {
 protected:
  fs::path path;
  void SetUp() override {
    logging::set_level(logging::Level::quiet);
    path = fs::path(testing::TempDir()) / ("titin_restart_np" + std::to_string(ranks()));
    if (is_root()) {
      fs::remove_all(path);
      fs::create_directories(path);
    }
    any_of(false);
  }
  void TearDown() override {
    logging::open_file("");
    any_of(false);
    if (is_root()) fs::remove_all(path);
  }
  Outcome begin(const std::string& scene, std::vector<std::string> overrides) const {
    if (is_root()) std::ofstream(path / "scene.toml") << scene;
    any_of(false);
    return run({path / "scene.toml", std::move(overrides), path / "whole", false, ""});
  }
  /// Copies the run and goes on from its checkpoint of this step.
  Outcome again(long step, std::vector<std::string> overrides = {}) const {
    any_of(false);
    if (is_root()) {
      fs::remove_all(path / "again");
      fs::copy(path / "whole", path / "again", fs::copy_options::recursive);
    }
    any_of(false);
    return run({"", std::move(overrides), "", false, path / "again" / checkpoint(step)});
  }
  static std::string checkpoint(long step) { return fmt::format("checkpoints/step_{:010}.h5", step); }
  std::string text_of(const std::string& name) const {
    any_of(false);
    std::ostringstream text;
    text << std::ifstream(path / name).rdbuf();
    any_of(false);
    return text.str();
  }
  std::vector<std::string> messages(const std::string& restart, std::vector<std::string> overrides = {}) const {
    try {
      run({"", std::move(overrides), "", false, path / restart});
    } catch (const InputError& error) {
      return error.messages();
    }
    return {};
  }
  void compare_histories(long step) const {
    EXPECT_EQ(again(step), Outcome::finished);
    EXPECT_EQ(text_of("again/history.csv"), text_of("whole/history.csv"));
    const auto whole = nlohmann::json::parse(text_of("whole/run.json"));
    const auto restarted = nlohmann::json::parse(text_of("again/run.json"));
    EXPECT_EQ(restarted["restarted_at_step"], step);
    EXPECT_TRUE(whole["restarted_at_step"].is_null());
    for (const char* same : {"steps", "time", "newton", "conservation", "errors", "krylov", "rejected"})
      EXPECT_EQ(restarted[same], whole[same]) << same;
  }
};

TEST_F(Restarts, MuscleGoesOnByTheBit) {
  EXPECT_EQ(begin(muscle, {"output.checkpoint_every=5", "output.checkpoint_keep=9"}), Outcome::finished);
  compare_histories(5);
  compare_histories(10);
}

TEST_F(Restarts, LoadsOnRailsAndLinksGoOnByTheBit) {
  EXPECT_EQ(
      begin(muscle, {"boundary.x+.rail={along=\"x\", force={time=\"0, 10 ms\", value=\"0, 0.2 N\"}, mass=\"1 g\"}",
                     "link.tendon={between=[\"x-\", \"x+\"], spring=\"10, 0, 0 N/m\", damper=\"0.1, 0, 0 N s/m\"}",
                     "time.end=16 ms", "output.checkpoint_every=4", "output.checkpoint_keep=9"}),
      Outcome::finished);
  compare_histories(4);
}

TEST_F(Restarts, AdaptiveStepsGoOnByTheBit) {
  EXPECT_EQ(
      begin(muscle, {"time.tolerance=1e-2", "time.scheme=bdf2", "time.end=10 ms", "muscle.error_estimate=true",
                     "boundary.y-.wall.gap_tolerance=0 m", "output.checkpoint_every=4", "output.checkpoint_keep=99"}),
      Outcome::finished);
  compare_histories(8);
}

TEST_F(Restarts, TheBlockSolverGoesOnByTheBit) {
  EXPECT_EQ(begin(muscle, {"solver.linear=block", "mesh.cells=[4, 2, 2]", "time.end=12 ms", "output.checkpoint_every=3",
                           "output.checkpoint_keep=9"}),
            Outcome::finished);
  compare_histories(3);
}

TEST_F(Restarts, GasGoesOnByTheBit) {
  EXPECT_EQ(begin(gas, {"output.checkpoint_every=10", "output.checkpoint_keep=999"}), Outcome::finished);
  compare_histories(20);
}

TEST_F(Restarts, SolidGoesOnByTheBit) {
  EXPECT_EQ(begin(solid, {"output.checkpoint_every=7", "output.checkpoint_keep=999", "output.history_every=3"}),
            Outcome::finished);
  compare_histories(14);
}

// Stopped, gone on with and stopped again: history.h5 is always that of all rows, and no part of one is left.
TEST_F(Restarts, HistoryInHdf5IsThatOfAllRows) {
  const auto check = [&](const std::string& folder) {
    const std::string text = text_of(folder + "/history.csv");
    const std::uint64_t rows = std::count(text.begin(), text.end(), '\n') - 1;
    ParallelHdf5 file((path / folder / "history.h5").string(), ParallelHdf5::Mode::read);
    EXPECT_EQ(file.rows("time"), rows);
    EXPECT_EQ(file.rows("torque_x-_y"), rows);
    const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
    EXPECT_EQ(file.read<double>("time", rows - 1, 1).at(0), std::stod(last));
    EXPECT_FALSE(fs::exists(path / folder / "history.h5.part"));
  };
  EXPECT_EQ(begin(solid, {"output.history_hdf5=true", "output.checkpoint_every=5", "time.step=2 us", "time.end=60 us"}),
            Outcome::finished);
  check("whole");
  EXPECT_EQ(run({"", {"time.end=80 us"}, "", false, path / "whole"}), Outcome::finished);
  check("whole");
}

TEST_F(Restarts, AveragedPressuresGoOnByTheBit) {
  EXPECT_EQ(begin(solid, {"fv.patch_pressure=true", "time.end=0.1 ms", "output.checkpoint_every=7",
                          "output.checkpoint_keep=999"}),
            Outcome::finished);
  compare_histories(14);
}

// The only two kept are the last ones; a run may be made longer; what lies after its checkpoint is not kept.
TEST_F(Restarts, ARunCanBeMadeLonger) {
  EXPECT_EQ(begin(solid, {"output.checkpoint_every=5", "time.step=2 us", "time.end=60 us"}), Outcome::finished);
  any_of(false);
  long kept = 0;
  for (const auto& file : fs::directory_iterator(path / "whole/checkpoints")) kept += file.is_regular_file();
  EXPECT_EQ(kept, 2);
  any_of(false);
  EXPECT_EQ(run({"", {"time.end=80 us"}, "", false, path / "whole"}), Outcome::finished);
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(text_of("whole/run.json"))["time"], 80e-6);
}

TEST_F(Restarts, ARunEndsInTimeAndGoesOn) {
  EXPECT_EQ(begin(muscle, {"output.wall_limit=1 us"}), Outcome::stopped);
  const auto stopped = nlohmann::json::parse(text_of("whole/run.json"));
  EXPECT_EQ(stopped["steps"], 0);
  EXPECT_EQ(stopped["reason"], "stopped at 0 s: the next step could pass output.wall_limit");
  EXPECT_EQ(run({"", {"output.wall_limit=0 s", "time.end=4 ms"}, "", false, path / "whole"}), Outcome::finished);
  EXPECT_EQ(nlohmann::json::parse(text_of("whole/run.json"))["steps"], 2);
}

TEST_F(Restarts, OtherScenesAndBadFilesAreRefused) {
  EXPECT_EQ(begin(solid, {"output.checkpoint_every=5", "time.step=2 us", "time.end=20 us"}), Outcome::finished);
  const std::string last = "whole/" + checkpoint(10), name = (path / last).string();
  EXPECT_EQ(messages(last, {"boundary.x+.pressure=60 kPa", "materials.rubber.terms.matrix.mu=100 kPa"}),
            std::vector<std::string>{"restart " + name +
                                     ": the checkpoint is of another scene: boundary.\"x+\".pressure, "
                                     "materials.rubber.terms.matrix.mu differ; leave them as they were, or begin a "
                                     "new run"});
  EXPECT_EQ(messages(last, {"time.end=10 us"}),
            std::vector<std::string>{"restart " + name +
                                     ": the checkpoint is at 2e-05 s and time.end at 1e-05 s; name an earlier "
                                     "checkpoint, or a later end"});
  const auto size = fs::file_size(name);
  any_of(false);
  if (is_root()) fs::resize_file(name, size / 2);
  any_of(false);
  EXPECT_EQ(messages("whole"),
            std::vector<std::string>{fmt::format("restart {}: is cut off: {} of {} bytes are there; name an earlier "
                                                 "one: --restart RUN/checkpoints/FILE",
                                                 name, size / 2, size)});
  if (is_root()) std::ofstream(name) << "nothing of ours";
  EXPECT_EQ(messages("whole"), std::vector<std::string>{"restart " + name +
                                                        ": is no checkpoint of Titin, or was not written to its end; "
                                                        "name an earlier one: --restart RUN/checkpoints/FILE"});
  if (is_root()) fs::remove_all(path / "whole/checkpoints");
  EXPECT_EQ(messages("whole"),
            std::vector<std::string>{"restart " + (path / "whole").string() +
                                     ": this folder has no checkpoints; a run writes them when it is stopped, and as "
                                     "output.checkpoint_every asks"});
}

// One number of the state, somewhere in the file.
TEST_F(Restarts, AChangedNumberIsFound) {
  EXPECT_EQ(begin(solid, {"output.checkpoint_every=5", "time.step=2 us", "time.end=10 us"}), Outcome::finished);
  const std::string name = (path / "whole" / checkpoint(5)).string();
  const double time = nlohmann::json::parse(text_of("whole/run.json"))["time"];
  if (is_root()) {
    std::fstream file(name, std::ios::in | std::ios::out | std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto at = text.find(std::string(reinterpret_cast<const char*>(&time), sizeof time));
    ASSERT_NE(at, std::string::npos);
    file.clear();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(text[at] ^ 1));
  }
  const auto said = messages("whole");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("was changed after it was written"), std::string::npos) << said[0];
}

}  // namespace
}  // namespace titin
