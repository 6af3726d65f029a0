#include <gtest/gtest.h>

#include <thread>

#include "base/timers.hpp"

namespace titin {
namespace {

void pass(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

TEST(Timers, PauseTheOuterPhase) {
  {
    Timers::Scope outer("outer");
    pass(2);
    {
      Timers::Scope inner("inner");
      pass(60);
    }
    pass(2);
  }
  pass(60);  // booked on nobody
  const auto& phases = Timers::phases();
  EXPECT_GE(phases.at("inner").wall, 0.06);
  EXPECT_GE(phases.at("outer").wall, 0.004);
  EXPECT_LT(phases.at("outer").wall, phases.at("inner").wall);
  EXPECT_EQ(phases.at("inner").calls, 1);
  EXPECT_LT(phases.at("inner").cpu, phases.at("inner").wall);
}

TEST(Timers, KnowTheProcess) {
  EXPECT_GT(wall_seconds(), 0);
  EXPECT_GT(cpu_seconds(), 0);
  EXPECT_GT(peak_rss_bytes(), 1u << 20);
}

}  // namespace
}  // namespace titin
