// What a cell of MOOD falls to first.
#include <gtest/gtest.h>

#include "flows_for_tests.hpp"
#include "fv/riemann.hpp"

namespace titin {
namespace {

using namespace test;

/// How many cells of Sod's tube lose an order over twenty steps: to limited slopes, to none.
std::array<double, 2> lowered(Cascade cascade) {
  const Riemann sod({1, 1, 0}, {0.125, 0.1, 0}, 0.5, 1.4);
  FvConfig config;
  config.cascade = cascade;
  Flow<2> flow(unit_box<2>(20), make_closure(perfect_gas(1.4)), config, {wall<2>(plane_sides)}, start_from<2>(sod));
  std::vector<double> count(2);
  for (int k = 0; k < 20; ++k) {
    flow.step();
    for (int c = 0; c < flow.mesh.cells(); ++c) {
      count[0] += flow.scheme->order(c) == CellOrder::limited;
      count[1] += flow.scheme->order(c) == CellOrder::constant;
    }
  }
  sum(count);
  return {count[0], count[1]};
}

TEST(Cascade, FallsByWayOfLimitedSlopesOrAtOnce) {
  const auto by_limited = lowered(Cascade::limited), at_once = lowered(Cascade::constant);
  EXPECT_GT(by_limited[0], 0);
  EXPECT_EQ(at_once[0], 0);
  EXPECT_GT(at_once[1], by_limited[1]);
}

}  // namespace
}  // namespace titin
