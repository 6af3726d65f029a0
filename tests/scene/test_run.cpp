#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "scene/run.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

const char* const pulled_block = R"(
title = "A passive block, pulled"
model = "muscle"
[mesh]
box = "20, 10, 10 mm"
cells = [2, 1, 1]
[time]
end = "0.1 s"
step = "25 ms"
[muscle]
inertia = "quasi-static"
[materials.gel]
density = "1000 kg/m^3"
volumetric = {law = "simo", bulk_modulus = "1 MPa"}
terms.matrix = {law = "neo_hookean", mu = "100 kPa"}
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement.x = {time = "0, 0.1 s", value = "0, 3 mm"}
)";

class Runs : public testing::Test {
 protected:
  fs::path path;
  void SetUp() override {
    logging::set_level(logging::Level::quiet);
    path = fs::path(testing::TempDir()) / ("titin_run_np" + std::to_string(ranks()));
    if (is_root()) {
      fs::remove_all(path);
      fs::create_directories(path);
      std::ofstream(path / "block.toml") << pulled_block;
    }
    any_of(false);
  }
  void TearDown() override {
    logging::open_file("");
    any_of(false);
    if (is_root()) fs::remove_all(path);
  }

  RunOptions options(std::vector<std::string> overrides, const std::string& folder = "out") const {
    return {path / "block.toml", std::move(overrides), path / folder, false};
  }
  std::string text_of(const std::string& name) const {
    any_of(false);
    std::ostringstream text;
    text << std::ifstream(path / name).rdbuf();
    any_of(false);
    return text.str();
  }
  nlohmann::json report(const std::string& folder = "out") const {
    return nlohmann::json::parse(text_of(folder + "/run.json"));
  }
  long rows(const std::string& folder = "out") const {
    const std::string history = text_of(folder + "/history.csv");
    return std::count(history.begin(), history.end(), '\n') - 1;
  }
  long fields(const std::string& folder = "out") const {
    const std::string index = text_of(folder + "/fields/fields.pvd");
    long n = 0;
    for (auto at = index.find("timestep="); at != std::string::npos; at = index.find("timestep=", at + 1)) ++n;
    return n;
  }
};

TEST_F(Runs, FillTheirFolder) {
  EXPECT_EQ(run(options({})), Outcome::finished);
  const auto json = report();
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["steps"], 4);
  EXPECT_EQ(json["time"], 0.1);
  EXPECT_EQ(json["ranks"], ranks());
  EXPECT_EQ(json["newton"]["per_step"].size(), 4u);
  EXPECT_EQ(json["model"], "muscle");
  EXPECT_LT(json["conservation"]["energy_balance_error"], 0.2);  // four steps of backward Euler
  EXPECT_LT(json["conservation"]["volume_change"], 0.05);
  EXPECT_EQ(rows(), 5);
  EXPECT_EQ(fields(), 5);
  EXPECT_NE(text_of("out/run.log").find("finished: 4 steps"), std::string::npos);
}

TEST_F(Runs, AreRepeatedByTheirResolvedScene) {
  EXPECT_EQ(run(options({"time.step=50 ms", "output.fields=false"})), Outcome::finished);
  RunOptions again = options({}, "again");
  again.scene_file = path / "out/resolved.toml";
  EXPECT_EQ(run(again), Outcome::finished);
  EXPECT_EQ(text_of("again/history.csv"), text_of("out/history.csv"));
  EXPECT_FALSE(fs::exists(path / "out/fields"));
  const auto without_head = [](const std::string& text) { return text.substr(text.find('\n')); };
  EXPECT_EQ(without_head(text_of("again/resolved.toml")), without_head(text_of("out/resolved.toml")));
}

// A run is its own reference; one with half the steps is off by the error of its larger ones.
TEST_F(Runs, SayHowFarTheyAreFromAReference) {
  run(options({"output.fields=false"}, "first"));
  EXPECT_TRUE(report("first")["errors"].empty());
  const std::string against = "reference.history=" + (path / "first/history.csv").string();
  run(options({"output.fields=false", against}, "again"));
  EXPECT_EQ(report("again")["errors"]["reaction_x+_x_l2"], 0);
  EXPECT_EQ(report("again")["errors"]["volume_max"], 0);
  run(options({"output.fields=false", "time.step=50 ms", against}, "coarse"));
  EXPECT_GT(report("coarse")["errors"]["reaction_x+_x_l2"], 0);
  EXPECT_LT(report("coarse")["errors"]["reaction_x+_x_max"], 0.1);
}

TEST_F(Runs, WriteFieldsByStepsOrByTimeAndAlwaysAtTheEnd) {
  run(options({"output.every=3"}, "steps"));
  EXPECT_EQ(fields("steps"), 3);  // 0, 3 and the last, 4
  run(options({"output.interval=50 ms"}, "time"));
  EXPECT_EQ(fields("time"), 3);  // 0, 0.05, 0.1 s
  EXPECT_EQ(rows("time"), 5);
  EXPECT_THROW(run(options({"output.every=3", "output.interval=50 ms"}, "both")), InputError);
}

TEST_F(Runs, TouchNothingWhenTheInputIsWrong) {
  try {
    run(options({"time.stp=1 s"}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages(),
              std::vector<std::string>{"command line: time.stp: unknown key; did you mean \"step\"?"});
  }
  any_of(false);
  EXPECT_FALSE(fs::exists(path / "out"));
}

TEST_F(Runs, ReportTheSceneAndTheFolderTogether) {
  if (is_root()) std::ofstream(path / "taken") << "x";
  any_of(false);
  try {
    run(options({"time.stp=1 s"}, "taken"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 2u);
  }
}

// Pushed through itself: no step is short enough.
TEST_F(Runs, ThatDoNotConvergeKeepTheirOutput) {
  const Outcome outcome =
      run(options({"boundary.x+.displacement.x={time = \"0, 0.05, 0.06 s\", value = \"0, 1, -40 mm\"}",
                   "time.max_cuts=2", "output.every=100"}));
  EXPECT_EQ(outcome, Outcome::not_converged);
  const auto json = report();
  EXPECT_EQ(json["status"], "not_converged");
  EXPECT_EQ(json["newton"]["cuts"], 2);
  EXPECT_GT(json["newton"]["failed"], 0);
  EXPECT_EQ(rows(), json["steps"].get<long>() + 1);
  EXPECT_EQ(fields(), 2);  // the first and the last state that was reached
  const std::string reason = json["reason"];
  EXPECT_NE(reason.find("failed: "), std::string::npos) << reason;
  EXPECT_NE(reason.find("halved 2 times in a row: allow more (time.max_cuts)"), std::string::npos) << reason;
}

TEST_F(Runs, StopAfterTheStepWhenAnyRankIsSignalled) {
  for (const int signal : {SIGTERM, SIGUSR1}) {
    const std::string folder = "signal" + std::to_string(signal);
    RunOptions long_run = options({"time.end=1000 s", "time.step=1 ms", "output.every=1000000"}, folder);
    std::jthread sender([&, runner = pthread_self(), last = rank() == ranks() - 1](std::stop_token stop) {
      while (!fs::exists(path / folder / "fields") && !stop.stop_requested())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (last && !stop.stop_requested()) pthread_kill(runner, signal);
    });
    EXPECT_EQ(run(long_run), Outcome::stopped);
    const auto json = report(folder);
    EXPECT_EQ(json["status"], "stopped");
    EXPECT_EQ(rows(folder), json["steps"].get<long>() + 1);
    EXPECT_EQ(fields(folder), json["steps"] == 0 ? 1 : 2);
  }
}

}  // namespace
}  // namespace titin
