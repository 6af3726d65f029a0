// Numbers in the head of a checkpoint that no run has written.
#include <gtest/gtest.h>

#include "io/checkpoint_head.hpp"

namespace titin {
namespace {

std::string problem_with(const std::string& numbers) {
  const std::string json =
      R"({"version": "1", "commit": "c", "model": "m", "time": 0.5, "settings": [], "scene_file": "s", "scene": "", )" +
      numbers + "}";
  const std::string bytes = to_bytes(json, 1000);
  return parse_head(bytes, 1000).problem;
}

// Found by fuzzing.
TEST(CheckpointHead, HasWholeNumbersThatFit) {
  const std::string strange = "has a head that this Titin does not understand";
  EXPECT_EQ(problem_with(R"("ranks": 2, "step": 12, "mesh": 18446744073709551615)"), "");
  EXPECT_EQ(problem_with(R"("ranks": 1e109, "step": 12, "mesh": 7)"), strange);
  EXPECT_EQ(problem_with(R"("ranks": 4294967298, "step": 12, "mesh": 7)"), strange) << "not 2";
  EXPECT_EQ(problem_with(R"("ranks": 2, "step": 9223372036854775808, "mesh": 7)"), strange);
  EXPECT_EQ(problem_with(R"("ranks": 2, "step": 12, "mesh": -1)"), strange);
  EXPECT_EQ(problem_with(R"("ranks": "2", "step": 12, "mesh": 7)"), strange);
}

}  // namespace
}  // namespace titin
