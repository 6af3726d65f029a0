// What `titin inspect` reads of a run folder, also where it is damaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/config.hpp"
#include "base/parallel.hpp"
#include "io/run_contents.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

class RunContentsTest : public testing::Test {
 protected:
  RunContentsTest()
      : folder_(fs::temp_directory_path() /
                ("titin_contents_" + std::to_string(getpid()) + "_" + std::to_string(rank()))) {
    fs::create_directories(folder_ / "fields");
  }
  ~RunContentsTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string fact(const std::string& what) {
    for (const auto& [name, text] : read_run_contents(folder_.string()).facts)
      if (name == what) return text;
    return "nothing";
  }
  std::string refusal() {
    try {
      read_run_contents(folder_.string());
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.substr(message.find(": ") + 2);
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(RunContentsTest, TellsWhatARunHasLeft) {
  write("run.json",
        R"({"title": "A block", "status": "stopped", "reason": "stopped by SIGUSR1 at 0.1 s", "scene": "block.toml",
    "model": "muscle", "version": "0.1.0", "commit": "abc", "ranks": 2, "cells": 512, "unknowns": 15963, "steps": 4, "time": 0.1,
    "newton": {"total": 12}, "krylov": {"total": 34}, "cpu_seconds": 1.5, "peak_rss_bytes": 2.5e8, "warnings": 1})");
  write("history.csv", "time [s],\"force, left [N]\"\n0,1\n0.05,-3\n0.1,2\n");
  write("fields/fields.pvd", "<DataSet timestep=\"0\" /><DataSet timestep=\"0.1\" /><DataSet timestep=\"0.1\" />");
  EXPECT_EQ(fact("status"), "stopped: stopped by SIGUSR1 at 0.1 s");
  EXPECT_EQ(fact("size"), "512 cells, 15963 unknowns");
  EXPECT_EQ(fact("reached"), "0.1 s in 4 steps");
  EXPECT_EQ(fact("iterations"), "12 of Newton's method, 34 of linear solvers");
  EXPECT_EQ(fact("cost"), "1.5 CPU seconds, 250 MB of memory");
  EXPECT_EQ(fact("warnings"), "1, see run.log");
  EXPECT_EQ(fact("history.csv"), "3 rows of 2 columns");
  EXPECT_EQ(fact("fields/"), "2 times from 0 to 0.1 s, 1 file, 76 B");
  const HistoryColumn force = read_run_contents(folder_.string()).history.columns.at(1);
  EXPECT_EQ(force.name, "force, left [N]");
  EXPECT_EQ(std::vector<double>({force.first, force.last, force.least, force.largest}),
            std::vector<double>({1, 2, -3, 2}));
}

TEST_F(RunContentsTest, ReadsASeriesOfFiles) {
  write("run.json", "{}");
  write("fields/fields.vtkhdf.series",
        R"({"file-series-version": "1.0", "files": [{"name": "a", "time": 0.0}, {"name": "b", "time" : 2.5e-1}]})");
  EXPECT_EQ(fact("fields/").substr(0, 26), "2 times from 0 to 0.25 s, ");
}

// One word of a million letters: a reader that calls itself for each of them has no such stack.
TEST_F(RunContentsTest, IsNotImpressedByLongWords) {
  write("run.json", "{}");
  const std::string word(1'000'000, '1');
  write("fields/fields.pvd", "<DataSet timestep=\"0.5\"/><DataSet timestep=\"" + word);
  EXPECT_EQ(fact("fields/").substr(0, 24), "1 time from 0.5 to 0.5 s");
  write("fields/fields.vtkhdf.series",
        "\"time\": 0.25, \"time\"" + std::string(1'000'000, ' ') + ": 2, \"time\": " + word);
  EXPECT_EQ(fact("fields/").substr(0, 24), "3 times from 0.25 to 2 s");
}

TEST_F(RunContentsTest, SaysWhatIsDamaged) {
  EXPECT_EQ(refusal(), "holds no run.json, so no run of Titin wrote it");
  write("run.json", "{\"status\": \"run");
  EXPECT_EQ(refusal(), "its run.json cannot be read; is it whole?");
  write("run.json", R"({"status": 3, "newton": [1], "title": "a)"
                    "\\u001b"
                    R"([31mb", "time": "late"})");
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(fact("title"), "a?[31mb");
  EXPECT_EQ(fact("reached"), "0 s in 0 steps");
  write("history.csv", "time [s],a\n0,1\n1\n");
  EXPECT_EQ(fact("history.csv"), "1 row of 2 columns; line 3: 1 value for 2 columns");
  write("history.csv", "time [s],a\n0,1\n1,x\n");
  EXPECT_EQ(fact("history.csv"), "1 row of 2 columns; line 3: \"x\" is no number");
  write("history.csv", "");
  EXPECT_EQ(fact("history.csv"), "0 rows of 0 columns; is empty, or cannot be read");
  fs::remove_all(folder_);
  EXPECT_EQ(refusal(), "is no folder; give that of a run, such as results/block");
}

}  // namespace
}  // namespace titin
