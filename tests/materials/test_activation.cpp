// From excitation to activation: closed forms, and an accurate integration by another program.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/activation.hpp"
#include "materials_for_tests.hpp"

namespace titin {
namespace {

using namespace testing;

// Between points of the stored curve: its spacing is a hundredth of the time constant, so (1/100)^2 / 8 of a change.
constexpr double interpolation = 2e-5;

/// Rises at 0.05 s, falls to a tenth at 0.3 s.
Table pulse() { return Table({0, 0.05, 0.06, 0.3, 0.31}, {0, 0, 1, 1, 0.1}); }

TEST(ActivationModel, ZajacFollowsItsExponentialUnderConstantExcitation) {
  const ActivationModel model{ActivationDynamics::zajac, 0.02, 0.025, 0.0};
  const Table a = model.integrate(Table(0.5));
  const double beta = 0.8, rate = (beta + 0.5 * (1 - beta)) / 0.02, settled = 0.5 / (beta + 0.5 * (1 - beta));
  for (double t : {0.001, 0.01, 0.05, 0.2}) EXPECT_NEAR(a(t), settled * -std::expm1(-rate * t), interpolation) << t;
}

// Reference: DOP853 with tolerance 1e-13 (SciPy), restarted at the kinks.
struct Reference {
  ActivationDynamics law;
  double values[6];
};
constexpr double times[6] = {0.03, 0.08, 0.2, 0.305, 0.33, 0.45};
constexpr Reference references[] = {
    {ActivationDynamics::de_groote,
     {0.00250510075109, 0.650629612555, 0.993760776447, 0.964322334893, 0.483329385051, 0.100810375606}},
    {ActivationDynamics::zajac,
     {0.0121306131943, 0.811713351861, 0.999936836866, 0.982709638536, 0.712784865877, 0.337779981497}}};

TEST(ActivationModel, FollowsAPulseAsIntegrated) {
  for (const Reference& reference : references) {
    const ActivationModel model{reference.law, 0.015, 0.06, 0.02};
    const Table a = model.integrate(pulse());
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(a(times[i]), reference.values[i], interpolation) << times[i];
  }
}

const std::string fibre = "peak_stress = \"200 kPa\", max_strain_rate = \"5 1/s\", ";

TEST(Excitation, DrivesAMuscleThroughItsScene) {
  const auto driven =
      material_of("hill_active", fibre +
                                     "excitation = 1, dynamics = { law = \"zajac\", activation_time = \"20 ms\", "
                                     "deactivation_time = \"25 ms\" }");
  const auto given = material_of("hill_active", fibre + "activation = 1");
  Point p;
  p.F = {1.1, 0, 0, 0, 1, 0, 0, 0, 1};
  p.time = 0.02;
  EXPECT_NEAR(stress(*driven, p)[0], -std::expm1(-1.0) * stress(*given, p)[0],
              interpolation * std::abs(stress(*given, p)[0]) * 10);
}

TEST(Excitation, IsGivenInsteadOfActivationNotBeside) {
  EXPECT_THROW(material_of("hill_active", fibre + "activation = 1, excitation = 1"), InputError);
  EXPECT_THROW(material_of("hill_active", "peak_stress = \"200 kPa\", max_strain_rate = \"5 1/s\""), InputError);
}

}  // namespace
}  // namespace titin
