/// The curves of Hill-type muscle at tabulated points (check values: evaluation of the published tables in other code).
#include <gtest/gtest.h>

#include "materials/collagen_table.hpp"
#include "materials/hill_active.hpp"
#include "materials/hill_curves.hpp"
#include "materials/hill_passive.hpp"

namespace titin {
namespace {

// The check values are printed with six decimals; slopes with three or six.
constexpr double printed = 0.6e-6, printed_slope = 0.6e-3;
constexpr double round_off = 1e-12;

struct Value {
  double x, f;
};

TEST(HillCurves, ActiveForceHasThePublishedValues) {
  const Value table[] = {{0.4, -0.004294}, {0.45, 0.009405}, {0.5, 0.047116},   {0.6, 0.242062},  {0.7, 0.594128},
                         {0.75, 0.750394}, {0.8, 0.860128},  {0.9, 0.966825},   {0.95, 0.993381}, {1, 0.994099},
                         {1.05, 0.950024}, {1.1, 0.864581},  {1.15, 0.763494},  {1.2, 0.666163},  {1.3, 0.478207},
                         {1.4, 0.301513},  {1.5, 0.152316},  {1.6, 0.043858},   {1.7, -0.000406}, {1.75, 0.002928},
                         {0.3999, 0},      {1.7501, 0},      {0.9772, 0.998422}};
  for (const Value& v : table) EXPECT_NEAR(hill::active_force(HillCurve::flexodeal, v.x), v.f, printed) << v.x;
}

TEST(HillCurves, TabulatedSinesAreTheSines) {
  const double value = 4e-15, slope = 4e-12;  // neglected Taylor terms
  for (double x = hill::active_min; x <= hill::active_max; x += 1.7e-4) {
    const auto f = hill::active_sine_sum(Dual<1, 1>::variable(x, 0));
    EXPECT_NEAR(f.value, hill::active_sines_derivative(x, 0), value) << x;
    EXPECT_NEAR(f.gradient[0], hill::active_sines_derivative(x, 1), slope) << x;
  }
}

TEST(HillCurves, SmoothActiveForceIsNeverNegativeAndHasNoKinks) {
  double last = 0, last_slope = 0;
  const double h = 1e-4;
  for (double x = 0.3; x < 1.9; x += h) {
    const auto f = hill::active_force(HillCurve::flexodeal_smooth, Dual<1, 1>::variable(x, 0));
    EXPECT_GE(f.value, 0) << x;
    // Largest slope of the curve is 4, its largest curvature 70 (in the blend that begins at 0.4).
    EXPECT_NEAR(f.value, last, 4 * h) << x;
    EXPECT_NEAR(f.gradient[0], last_slope, 70 * h) << x;
    last = f.value, last_slope = f.gradient[0];
  }
  for (double x : {0.5, 0.8, 1.0, 1.3, 1.6})
    EXPECT_EQ(hill::active_force(HillCurve::flexodeal_smooth, x), hill::active_force(HillCurve::flexodeal, x));
}

TEST(HillCurves, ForceVelocityHasThePublishedValuesAndSlopes) {
  const Value table[] = {{-1.3, 0},         {-1, 0.007790},   {-0.75, 0.052496}, {-0.5, 0.158625},
                         {-0.25, 0.350355}, {-0.1, 0.575342}, {-0.01, 0.941204}, {0, 1},
                         {0.01, 1.076363},  {0.02, 1.170971}, {0.03, 1.264830},  {0.05, 1.374324},
                         {0.1, 1.419268},   {0.2, 1.490012},  {0.5, 1.586249},   {0.9, 1.595047}};
  for (const Value& v : table) EXPECT_NEAR(hill::force_velocity(HillCurve::flexodeal, v.x), v.f, printed) << v.x;
  const Value slopes[] = {{-0.25, 0.970369}, {-0.1, 2.7005}, {-0.01, 5.6713}, {0, 6.090887},
                          {0.01, 8.865},     {0.02, 9.740},  {0.03, 8.715},   {0.05, 0.967864}};
  for (const Value& v : slopes) {
    const auto f = hill::force_velocity(HillCurve::flexodeal, Dual<1, 1>::variable(v.x, 0));
    EXPECT_NEAR(f.gradient[0], v.f, printed_slope) << v.x;
  }
}

TEST(HillCurves, PassiveForceHasThePublishedValues) {
  const Value table[] = {{0.9, 0},        {1, 0},          {1.05, 0.005885}, {1.1, 0.023538},
                         {1.2, 0.094154}, {1.3, 0.214552}, {1.4, 0.400972},  {1.5, 0.656118},
                         {1.6, 0.949902}, {1.65, 1.1},     {1.75, 1.402332}};
  for (const Value& v : table) EXPECT_NEAR(hill::passive_force(HillCurve::flexodeal, v.x), v.f, printed) << v.x;
}

TEST(HillCurves, CollagenTableHasThePublishedValuesAndPullsAtRest) {
  CollagenTable law;
  law.stress_scale = 1;
  const Value table[] = {{0.5, 0.005},     {1, 0.01},        {1.005, 0.022947},
                         {1.01, 0.061688}, {1.02, 0.225024}, {1.05, 0.886229},
                         {1.1, 1.948337},  {1.15, 2.960569}, {1.25, 2.960569 + 1.974586}};
  for (const Value& v : table) EXPECT_NEAR(law.fibre_stress(v.x, 0.0, 0), v.f, printed) << v.x;
  law.stress_free_rest = true;
  EXPECT_EQ(law.fibre_stress(1.0, 0.0, 0), 0);
  EXPECT_EQ(law.fibre_stress(0.9, 0.0, 0), 0);
  EXPECT_NEAR(law.fibre_stress(1.1, 0.0, 0), 1.938337, printed);
}

TEST(HillCurves, DeGrooteCurvesHaveTheValuesOfAnIndependentEvaluation) {
  const auto curve = HillCurve::degroote;
  const Value active[] = {{0.5, 0.054112153014274314},
                          {0.8, 0.8364395661146518},
                          {1.0, 1.0},
                          {1.2, 0.7936897180660011},
                          {1.5, 0.22614862789744}};
  for (const Value& v : active) EXPECT_NEAR(hill::active_force(curve, v.x), v.f, round_off) << v.x;
  const Value velocity[] = {{-1, 0}, {-0.5, 0.2340363935488038}, {-0.1, 0.745171585030237},
                            {0, 1},  {0.1, 1.2065086712602473},  {1, 1.7943429635553172}};
  for (const Value& v : velocity) EXPECT_NEAR(hill::force_velocity(curve, v.x), v.f, round_off) << v.x;
  const Value passive[] = {
      {0.8, 0.004739942143981771}, {1.0, 0.01822882382007152}, {1.3, 0.13525881677781018}, {1.6, 1.0}};
  for (const Value& v : passive) EXPECT_NEAR(hill::passive_force(curve, v.x), v.f, round_off) << v.x;
}

/// dE/dx = f / x, by central differences at their order.
TEST(HillCurves, PassiveEnergiesDifferentiateToTheirForces) {
  const double h = 1e-4, second_order = 1e-6;  // h^2 times third derivatives below 100
  for (HillCurve curve : {HillCurve::flexodeal, HillCurve::degroote})
    for (double x : {0.8, 1.1, 1.3, 1.6, 1.9}) {
      const double slope = (hill::passive_energy(curve, x + h) - hill::passive_energy(curve, x - h)) / (2 * h);
      EXPECT_NEAR(slope, hill::passive_force(curve, x) / x, second_order) << x;
    }
}

/// Nominal: force per undeformed area, the Kirchhoff stress being larger by the stretch; the energy is its integral.
TEST(HillCurves, NominalStressIsTheCurve) {
  const double h = 1e-6, difference = 1e-8;
  HillPassive passive;
  passive.peak_stress = 1;
  passive.stress = HillStress::nominal;
  for (HillCurve curve : {HillCurve::flexodeal, HillCurve::degroote}) {
    passive.curve = curve;
    EXPECT_EQ(passive.energy(1), 0);
    for (double x : {0.95, 1.1, 1.3, 1.45, 1.6}) {
      const double slope = (passive.energy(x + h) - passive.energy(x - h)) / (2 * h);
      EXPECT_NEAR(slope, hill::passive_force(curve, x), difference) << x;
      EXPECT_NEAR(passive.fibre_stress(x, 0.0, 0) / x, hill::passive_force(curve, x), round_off) << x;
    }
  }
}

}  // namespace
}  // namespace titin
