// fidelity = "auto": a run takes the advice first, says so, and goes on from a checkpoint with what it has chosen.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "scene/probe.hpp"
#include "scene/run.hpp"
#include "uniform_block.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

/// Cells, order and inertia are more than it needs; what a pressure costs here is too little to choose by. Cells along
/// x for two ranks to share.
const std::string block = R"(fidelity = "auto"
fidelity_quantity = "reaction_x+_x"
fidelity_tolerance = 0.05
)" + std::string(uniform_block) +
                          R"([muscle]
element = "displacement"
[output]
fields = false
checkpoint_every = 1
checkpoint_keep = 9
)";

class AutomaticFidelity : public testing::Test {
 protected:
  fs::path folder;
  void SetUp() override {
    logging::set_level(logging::Level::quiet);
    folder = fs::path(testing::TempDir()) / ("titin_fidelity_np" + std::to_string(ranks()));
    if (is_root()) {
      fs::remove_all(folder);
      fs::create_directories(folder);
      std::ofstream(scene()) << block;
    }
    any_of(false);
  }
  void TearDown() override {
    logging::open_file("");
    any_of(false);
    if (is_root()) fs::remove_all(folder);
  }
  std::string scene() const { return folder / "block.toml"; }
  Outcome begin(std::vector<std::string> overrides = {}) const {
    return run({scene(), std::move(overrides), folder / "run", false, ""});
  }
  Outcome again(const std::string& file, std::vector<std::string> overrides) const {
    any_of(false);
    return run({file, std::move(overrides), "", false, folder / "run/checkpoints/step_0000000002.h5"});
  }
  std::string text_of(const std::string& name) const {
    any_of(false);
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    any_of(false);
    return text.str();
  }
  static int times_in(const std::string& text, const std::string& word) {
    int n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  }
  std::vector<std::string> messages(std::vector<std::string> overrides) const {
    try {
      begin(std::move(overrides));
    } catch (const InputError& error) {
      return error.messages();
    }
    return {};
  }
};

TEST_F(AutomaticFidelity, RunsWhatAdviceProposes) {
  EXPECT_EQ(begin(), Outcome::finished);
  const std::string resolved = text_of("run/resolved.toml"), log = text_of("run/run.log");
  EXPECT_NE(resolved.find("# fidelity = \"auto\" has chosen 'muscle.inertia=quasi-static' '~time.scheme'"),
            std::string::npos)
      << resolved;
  for (const char* line : {"\nfidelity = \"as_written\"\n", "fidelity_quantity = \"reaction_x+_x\"\n",
                           "fidelity_tolerance = 0.05\n", "inertia = \"quasi-static\"\n"})
    EXPECT_NE(resolved.find(line), std::string::npos) << line << "is not in\n" << resolved;
  EXPECT_EQ(resolved.find("cells = [4, 2, 2]"), std::string::npos) << resolved;
  for (const char* words : {"block.toml: \"reaction_x+_x\" within 5 %\n", "what a probe finds",
                            "without inertia and rates", "take it", "within about", "fidelity = \"auto\" has chosen"})
    EXPECT_EQ(times_in(log, words), 1) << words << " in\n" << log;
  const Probe as_written = probe(scene(), {}, "reaction_x+_x");
  const Probe chosen = probe(folder / "run/resolved.toml", {}, "reaction_x+_x");
  EXPECT_LT(difference(chosen, as_written), 0.05);
  EXPECT_LT(chosen.unknowns * chosen.steps, as_written.unknowns * as_written.steps / 4);
}

TEST_F(AutomaticFidelity, WhatIsResolvedIsNotAdvisedAgain) {
  EXPECT_EQ(begin(), Outcome::finished);
  any_of(false);
  EXPECT_EQ(run({folder / "run/resolved.toml", {}, folder / "resolved", false, ""}), Outcome::finished);
  EXPECT_EQ(text_of("resolved/history.csv"), text_of("run/history.csv"));
  EXPECT_EQ(times_in(text_of("resolved/run.log"), "what a probe finds"), 0);
}

TEST_F(AutomaticFidelity, ARestartKeepsTheChoice) {
  EXPECT_EQ(begin(), Outcome::finished);
  const std::string whole = text_of("run/history.csv"), chosen = "has chosen 'muscle.inertia=quasi-static'";
  ASSERT_EQ(times_in(text_of("run/run.log"), "what a probe finds"), 1);
  EXPECT_EQ(again(scene(), {}), Outcome::finished) << "the scene says auto, and its keys are not those of the run";
  EXPECT_EQ(text_of("run/history.csv"), whole);
  EXPECT_EQ(again("", {}), Outcome::finished) << "the scene in the checkpoint";
  EXPECT_EQ(text_of("run/history.csv"), whole);
  EXPECT_EQ(again(scene(), {"fidelity_tolerance=0.5"}), Outcome::finished) << "too late to matter";
  EXPECT_EQ(text_of("run/history.csv"), whole);
  EXPECT_EQ(times_in(text_of("run/run.log"), "what a probe finds"), 1);
  EXPECT_EQ(times_in(text_of("run/run.log"), chosen), 4) << "each start says what it runs";
}

TEST_F(AutomaticFidelity, SaysWhatIsWrongWithIt) {
  const auto found = messages({"fidelity_tolerance=2", "time.step=-1 s"});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "command line: fidelity_tolerance: 2 is out of range; allowed: 1e-06 to 1");
  EXPECT_NE(found[1].find("time.step"), std::string::npos);
  const auto unknown = messages({"fidelity_quantity=reaction_x+_q"});
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_EQ(unknown[0],
            "command line: fidelity_quantity: this run follows no \"reaction_x+_q\"; did you mean \"reaction_x+_x\"?");
  EXPECT_FALSE(fs::exists(folder / "run"));
}

}  // namespace
}  // namespace titin
