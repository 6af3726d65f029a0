// What solver.linear = "auto" takes.
#include <gtest/gtest.h>

#include <limits>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "solve/linear_choice.hpp"

namespace titin {
namespace {

constexpr double gigabyte = 1e9, endless = std::numeric_limits<double>::infinity();

TEST(AutomaticSolver, IsDirectForFewUnknownsThatFit) {
  EXPECT_EQ(automatic_choice(30000, 3, true, 8 * gigabyte).method, LinearMethod::direct);
  EXPECT_EQ(automatic_choice(30000, 3, true, 0.1 * gigabyte).method, LinearMethod::block) << "no room for factors";
  EXPECT_EQ(automatic_choice(100000, 3, true, endless).method, LinearMethod::block) << "too slow, if it fitted";
  EXPECT_EQ(automatic_choice(100000, 2, true, 8 * gigabyte).method, LinearMethod::direct) << "little fill in the plane";
  EXPECT_EQ(automatic_choice(1e6, 2, true, 64 * gigabyte).method, LinearMethod::block);
}

TEST(AutomaticSolver, SaysWhenNothingFits) {
  const LinearChoice choice = automatic_choice(1e6, 3, false, 8 * gigabyte);
  EXPECT_EQ(choice.method, LinearMethod::direct);
  EXPECT_FALSE(choice.fits);
  EXPECT_EQ(choice.why,
            "factors need about 19 GB of 8 GB that are free; no block solver for these elements or this scheme");
}

TEST(Memory, IsLeftOnThisMachine) {
  const double left = available_memory();
  EXPECT_GT(left, 1e6);
  EXPECT_LE(ranks_on_node(), ranks());
  EXPECT_GE(ranks_on_node(), 1);
}

}  // namespace
}  // namespace titin
