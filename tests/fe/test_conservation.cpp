#include <gtest/gtest.h>

#include "fe/conservation.hpp"

namespace titin {
namespace {

TEST(Conservation, IsTheLargestErrorSoFarOverWhatThereWas) {
  Conservation conservation;
  const auto update = [&](double energy, double work, double error, double volume) {
    conservation.update({{"energy_base", "J", energy},
                         {"work_active", "J", work},
                         {"energy_balance_error", "J", error},
                         {"volume", "m^3", volume},
                         {"reaction_x-_x", "N", 1e9}});
  };
  update(0, 0, 0, 2);
  EXPECT_EQ(conservation.list()[0].value, 0);
  update(3, -5, -0.5, 1.9);
  update(1, 0, 0.1, 2.02);
  const auto list = conservation.list();
  EXPECT_EQ(list[0].name, "energy_balance_error");
  EXPECT_DOUBLE_EQ(list[0].value, 0.1);
  EXPECT_EQ(list[1].name, "volume_change");
  EXPECT_NEAR(list[1].value, 0.05, 1e-15);
}

}  // namespace
}  // namespace titin
