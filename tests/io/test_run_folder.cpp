#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/config.hpp"
#include "base/parallel.hpp"
#include "io/run_folder.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

/// A folder of this test's own; rank 0 prepares it, and all ranks see the same.
class Folder : public testing::Test {
 protected:
  fs::path path;
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = fs::path(testing::TempDir()) / (std::string("titin_folder_") + test->name() + std::to_string(ranks()));
    if (is_root()) fs::remove_all(path);
    any_of(false);  // waits for rank 0
  }
  void TearDown() override {
    any_of(false);
    if (is_root()) fs::remove_all(path);
  }
  void put(const std::string& name, const std::string& text = "x") const {
    if (is_root()) {
      fs::create_directories((path / name).parent_path());
      std::ofstream(path / name) << text;
    }
    any_of(false);
  }
  bool has(const std::string& name) const {
    any_of(false);
    const bool there = fs::exists(path / name);
    any_of(false);
    return there;
  }
  std::string message(bool overwrite) const {
    const std::string problem = RunFolder::problem(path, overwrite);
    if (problem.empty()) {
      RunFolder(path, overwrite);
      return "";
    }
    EXPECT_THROW(RunFolder(path, overwrite), InputError);
    const std::string head = "output folder " + path.string() + ": ";
    EXPECT_EQ(problem.substr(0, head.size()), head);
    return problem.substr(head.size());
  }
  void put_a_run() const {
    for (const char* name : {"resolved.toml", "run.json", "run.log", "history.csv", "history.h5", "fields/fields.pvd",
                             "fields/Cycle000003/data.pvtu", "fields/Cycle000003/proc000001.vtu"})
      put(name);
  }
};

TEST_F(Folder, IsMadeWithItsParents) {
  const RunFolder folder(path / "a" / "b", false);
  folder.write("run.json", "{}");
  EXPECT_TRUE(has("a/b/run.json"));
  EXPECT_FALSE(has("a/b/run.json.part"));
}

TEST_F(Folder, MayBeThereWhenEmpty) {
  put("inside");
  if (is_root()) fs::remove(path / "inside");
  EXPECT_EQ(message(false), "");
}

TEST_F(Folder, OfAnEarlierRunNeedsOverwrite) {
  put_a_run();
  EXPECT_EQ(message(false), "holds an earlier run; replace it with --overwrite, or name another folder with -o");
  EXPECT_TRUE(has("history.csv"));
  EXPECT_EQ(message(true), "");
  EXPECT_FALSE(has("history.csv"));
  EXPECT_FALSE(has("history.h5"));
  EXPECT_FALSE(has("fields"));
}

TEST_F(Folder, OfTheUserIsNeverTouched) {
  put("history.csv", "precious");
  for (const bool overwrite : {false, true})
    EXPECT_EQ(message(overwrite), "is not empty, and no run of Titin wrote it; name another folder with -o");
  EXPECT_TRUE(has("history.csv"));
}

TEST_F(Folder, KeepsTheUsersFilesInAnEarlierRun) {
  put_a_run();
  put("notes.txt");
  put("fields/Cycle000003/my.vtu");
  put("sub/history.csv");
  EXPECT_EQ(message(true), "");
  EXPECT_TRUE(has("notes.txt"));
  EXPECT_TRUE(has("fields/Cycle000003/my.vtu"));
  EXPECT_TRUE(has("sub/history.csv"));
  EXPECT_FALSE(has("fields/Cycle000003/data.pvtu"));
}

TEST_F(Folder, DoesNotFollowLinks) {
  put_a_run();
  put("../titin_elsewhere/data.pvtu");
  if (is_root()) fs::create_directory_symlink(path / "../titin_elsewhere", path / "fields/Cycle000007");
  EXPECT_EQ(message(true), "");
  EXPECT_TRUE(has("../titin_elsewhere/data.pvtu"));
  any_of(false);
  if (is_root()) fs::remove_all(path / "../titin_elsewhere");
}

TEST_F(Folder, BelongsToOneRunAtATime) {
  const std::string taken = "another run is writing to it (process ";
  {
    const RunFolder first(path, false);
    first.write("run.json", "{}");
    first.write("resolved.toml", "");
    any_of(false);
    for (const bool overwrite : {false, true}) EXPECT_EQ(message(overwrite).substr(0, taken.size()), taken);
    EXPECT_THROW(RunFolder::of_restart(path), InputError);
    EXPECT_TRUE(has("resolved.toml"));
  }
  any_of(false);
  { RunFolder::of_restart(path); }
  any_of(false);
  EXPECT_EQ(message(true), "");
}

TEST_F(Folder, OfARunThatWroteNothingIsEmpty) {
  put("run.lock");
  EXPECT_EQ(message(false), "");
  put("run.lock");
  put("mine");
  EXPECT_EQ(message(true), "is not empty, and no run of Titin wrote it; name another folder with -o");
}

TEST_F(Folder, ThatIsAFileIsRefused) {
  if (is_root()) std::ofstream(path) << "x";
  any_of(false);
  for (const bool overwrite : {false, true}) EXPECT_EQ(message(overwrite), "is a file; name a folder with -o");
}

}  // namespace
}  // namespace titin
