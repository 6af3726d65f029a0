#include <gtest/gtest.h>

#include "base/words.hpp"

namespace titin {
namespace {

TEST(Words, FindTheNearestWord) {
  const std::vector<std::string> known = {"end", "step", "max_cuts", "boundary"};
  EXPECT_EQ(nearest("stpe", known), "step");  // swap
  EXPECT_EQ(nearest("stp", known), "step");   // left out
  EXPECT_EQ(nearest("Step", known), "step");  // case costs nothing
  EXPECT_EQ(nearest("boundry", known), "boundary");
  EXPECT_EQ(nearest("maxcut", known), "max_cuts");
  EXPECT_EQ(nearest("viscosity", known), "");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest(std::string(100000, 'a'), known), "");
}

TEST(Words, AreCounted) {
  EXPECT_EQ(count(1, "rank"), "1 rank");
  EXPECT_EQ(count(0, "cell"), "0 cells");
  EXPECT_EQ(count(3e9, "cell"), "3000000000 cells");
}

TEST(Words, ArePrintedSafely) {
  EXPECT_EQ(in_quotes("a\x1b[31mb\n"), "\"a?[31mb?\"");
  EXPECT_EQ(printable(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(printable(std::string(59, 'x') + "µµ"), std::string(59, 'x') + "...");  // no half characters
  EXPECT_EQ(toml_string("a\"b\\c\n"), R"("a\"b\\c\u000A")");
}

}  // namespace
}  // namespace titin
