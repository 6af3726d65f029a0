// Damage laws against their closed forms on a cyclic uniaxial path of an incompressible neo-Hookean bar.
#include <gtest/gtest.h>

#include "memory_for_tests.hpp"

namespace titin {
namespace {

using namespace testing;

constexpr double printed = 1e-9;  // the tables were computed in double precision by another program

struct Case {
  const char* entry;
  const char* damage;
};

class Damage : public ::testing::TestWithParam<Case> {};

/// P_11 of an incompressible bar: the pressure takes the lateral stress away.
double bar(RememberingPoint& point, double l) {
  const double m = 1 / std::sqrt(l);
  const Mat3 P = point.step(diagonal(l, m, m), 0.1);
  return P[0] - P[4] * m / l;
}

TEST_P(Damage, FollowsItsTableThroughUnloadingAndReloading) {
  RememberingPoint point(material_of("neo_hookean", std::string("mu = \"10 Pa\", damage = ") + GetParam().damage));
  const auto reference = time_dependent()[GetParam().entry];
  double last = 0;
  for (const auto& row : reference["rows"]) {
    const double P = bar(point, row[0].get<double>());
    EXPECT_NEAR(P, row[4].get<double>(), printed) << GetParam().entry << " at stretch " << row[0];
    EXPECT_GE(point.dissipated(), last);
    last = point.dissipated();
  }
  EXPECT_GT(last, 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, Damage,
    ::testing::Values(
        Case{"damage_eq29_corrected",
             "{ law = \"exponential\", threshold = \"0.2 J/m^3\", scale = \"3.3333333333333335 J/m^3\" }"},
        Case{"damage_eq30",
             "{ law = \"balzani\", threshold = \"0.16 J/m^3\", failure = \"6.25 J/m^3\", shape = -2.5 }"},
        Case{"damage_simo_ju", "{ law = \"simo_ju\", scale = \"1.125 J/m^3\", residual = 0.2 }"}),
    [](const auto& info) { return std::string(info.param.entry); });

TEST(DamageTangent, IsExactWhileLoadingAndUnloading) {
  const std::string law =
      "mu = \"10 Pa\", damage = { law = \"simo_ju\", scale = \"1 J/m^3\", residual = 0.1, time = \"0.1 s\" }";
  RememberingPoint loading(material_of("neo_hookean", law));
  loading.step(diagonal(1.1, 0.95, 0.96), 0.1);
  EXPECT_NEAR(tangent_order(loading, {1.4, 0.2, 0, 0.1, 0.85, 0, 0, 0.1, 0.9}, 0.1), 2.0, 0.1);
  RememberingPoint unloading(material_of("neo_hookean", law));
  unloading.step({1.5, 0.4, 0, 0.1, 0.85, 0, 0, 0.1, 0.9}, 10.0);
  EXPECT_NEAR(tangent_order(unloading, {1.1, 0.1, 0, 0.1, 0.95, 0, 0, 0.1, 0.95}, 0.1), 2.0, 0.1);
}

TEST(DamageOverViscosity, ComposesAndKeepsItsBooks) {
  RememberingPoint point(material_of("neo_hookean",
                                     "mu = \"10 Pa\", prony = { strength = [0.5], time = \"0.1 s\" }, damage = { law = "
                                     "\"exponential\", scale = \"2 J/m^3\" }"));
  double last = 0;
  for (int n = 1; n <= 20; ++n) {
    point.stress(diagonal(1 + 0.02 * n, 1 / std::sqrt(1 + 0.02 * n), 1 / std::sqrt(1 + 0.02 * n)), 0.05);
    EXPECT_GT(point.dissipated(), last);
    last = point.dissipated();
    point.take();
  }
}

}  // namespace
}  // namespace titin
