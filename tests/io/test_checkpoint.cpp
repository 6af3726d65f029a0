// Checkpoint files by themselves: what was written comes back, in whatever order cells are asked for, or a sentence.
#include "io/checkpoint.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "io/output_error.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

constexpr int cells = 12;  // of all ranks

/// A state with each kind of thing in it. Rank r has the cells r, r + ranks, ..., or the last first.
struct State {
  explicit State(bool turned = false) {
    for (int cell = rank(); cell < cells; cell += ranks()) rows.number.push_back(cell);
    if (turned) std::reverse(rows.number.begin(), rows.number.end());
    for (const long cell : rows.number) sizes.push_back(static_cast<int>(cell % 3));
  }
  void fill() {
    common = {0.1, -0.0, std::numeric_limits<double>::infinity(), 1.0 / 3};
    parts = {1.0 + rank(), 1e-300};
    for (const long cell : rows.number) {
      pairs.insert(pairs.end(), {0.1 * static_cast<double>(cell), -1.0});
      for (int k = 0; k < cell % 3; ++k) ragged.push_back(static_cast<double>(10 * cell + k));
    }
    steps = 7;
  }
  void walk(StateWalk& walk) {
    parts.resize(2);
    pairs.resize(2 * rows.number.size());
    ragged.resize(std::accumulate(sizes.begin(), sizes.end(), 0));
    walk.number("steps", steps);
    walk.common("common", common);
    walk.parts("parts", parts);
    walk.rows("pairs", rows, 2, pairs.data());
    walk.ragged("ragged", rows, sizes, ragged.data());
  }
  StateRows rows{"cells", {}};
  std::vector<int> sizes;
  std::vector<double> common, parts, pairs, ragged;
  long steps = 0;
};

class CheckpointFiles : public testing::Test {
 protected:
  std::string folder = (fs::path(testing::TempDir()) / ("titin_checkpoints_np" + std::to_string(ranks()))).string();
  void SetUp() override {
    if (is_root()) fs::remove_all(folder);
    any_of(false);
  }
  void TearDown() override {
    any_of(false);
    if (is_root()) fs::remove_all(folder);
  }
  static CheckpointHead head(long step) {
    CheckpointHead head;
    head.step = step;
    head.time = 0.1 * static_cast<double>(step);
    head.settings = {"a = 1", "b = \"caf\xc3\xa9\""};
    return head;
  }
  std::string write(long step, int keep = 2) const {
    State state;
    state.fill();
    Checkpoints(folder, keep).write(head(step), [&](StateWalk& walk) { state.walk(walk); });
    any_of(false);
    return find_checkpoint(folder).path;
  }
};

TEST_F(CheckpointFiles, GiveBackWhatWasWritten) {
  const std::string file = write(3);
  const FoundCheckpoint found = find_checkpoint(folder);
  EXPECT_EQ(found.problem, "");
  EXPECT_EQ(found.head.step, 3);
  EXPECT_EQ(found.head.time, 0.1 * 3);
  EXPECT_EQ(found.head.settings, head(3).settings);
  for (const bool turned : {false, true}) {
    State wanted(turned), state(turned);
    wanted.fill();
    read_checkpoint(file, [&](StateWalk& walk) { state.walk(walk); });
    EXPECT_EQ(state.steps, 7);
    EXPECT_EQ(state.common, wanted.common);
    EXPECT_TRUE(std::signbit(state.common[1]));
    EXPECT_EQ(state.parts, wanted.parts);
    EXPECT_EQ(state.pairs, wanted.pairs) << turned;
    EXPECT_EQ(state.ragged, wanted.ragged) << turned;
  }
}

TEST_F(CheckpointFiles, AreKeptAsManyAsAskedForAndNoneOfALostFuture) {
  for (const long step : {1, 2, 3, 10}) write(step, 3);
  const auto there = [&](long step) { return fs::exists(fmt::format("{}/checkpoints/step_{:010}.h5", folder, step)); };
  EXPECT_FALSE(there(1));
  EXPECT_TRUE(there(2) && there(3) && there(10));
  if (is_root()) std::ofstream(folder + "/checkpoints/step_0000000011.h5.part") << "killed";
  if (is_root()) std::ofstream(folder + "/checkpoints/notes.txt") << "the user's";
  any_of(false);
  EXPECT_EQ(find_checkpoint(folder).head.step, 10);
  Checkpoints(folder, 3).forget_after(3);
  EXPECT_TRUE(there(2) && there(3));
  EXPECT_FALSE(there(10));
  EXPECT_FALSE(fs::exists(folder + "/checkpoints/step_0000000011.h5.part"));
  EXPECT_TRUE(fs::exists(folder + "/checkpoints/notes.txt"));
}

TEST_F(CheckpointFiles, ThatLackSomethingSayWhat) {
  const std::string file = write(1);
  const auto message = [&](const std::function<void(StateWalk&)>& walk) {
    try {
      read_checkpoint(file, walk);
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(file.size());
    }
    return std::string();
  };
  std::vector<double> values(3);
  EXPECT_EQ(message([&](StateWalk& walk) { walk.common("other", values); }), ": common/other is missing");
  EXPECT_EQ(message([&](StateWalk& walk) { walk.parts("parts", values); }), ": parts/parts has another number of sums");
  StateRows rows{"cells", {cells + rank()}};
  EXPECT_EQ(message([&](StateWalk& walk) { walk.rows("pairs", rows, 2, values.data()); }),
            ": cells/pairs lacks cells or nodes of this mesh");
  rows.number = {rank()};
  EXPECT_EQ(message([&](StateWalk& walk) { walk.rows("pairs", rows, 3, values.data()); }),
            ": cells/pairs has rows of other sizes");
}

TEST_F(CheckpointFiles, ThatCannotBeWrittenLeaveTheEarlierOnes) {
  write(1);
  if (is_root()) fs::create_directories(folder + "/checkpoints/step_0000000002.h5/in the way");
  any_of(false);
  State state;
  state.fill();
  EXPECT_THROW(Checkpoints(folder, 2).write(head(2), [&](StateWalk& walk) { state.walk(walk); }), OutputError);
  EXPECT_TRUE(fs::exists(folder + "/checkpoints/step_0000000001.h5"));
}

}  // namespace
}  // namespace titin
