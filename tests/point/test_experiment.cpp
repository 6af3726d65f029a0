/// Experiments on a point against closed forms, and what must hold for any of them.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "materials/hill_curves.hpp"
#include "materials/registry.hpp"
#include "points_for_tests.hpp"

namespace titin::testing {
namespace {

// Newton's residual is round-off beside the stiffness; stresses are within some hundred roundings of it.
constexpr double closed_form = 1e-11;

void expect_curve(const Curves& curves, const char* x, const char* y, const std::function<double(double)>& exact,
                  double tolerance = closed_form) {
  const auto at = curves[x], found = curves[y];
  double largest = 0;
  for (double v : at) largest = std::max(largest, std::abs(exact(v)));
  for (std::size_t k = 0; k < at.size(); ++k)
    EXPECT_NEAR(found[k], exact(at[k]), tolerance * largest) << x << " " << at[k];
}

const Words neo_hookean{"neo_hookean"};

TEST(Incompressible, UniaxialIsTheClosedForm) {
  const double mu = 1e4;
  for (const char* stretch : {"stretch=2.5", "stretch=0.3"})
    expect_curve(run(neo_hookean, {"mu=10 kPa", stretch}), "F_xx", "sigma_xx",
                 [&](double l) { return mu * (l * l - 1 / l); });
  expect_curve(run({"mooney_rivlin"}, {"c1=6 kPa", "c2=2 kPa", "stretch=2"}), "F_xx", "sigma_xx",
               [](double l) { return 2 * (l * l - 1 / l) * (6e3 + 2e3 / l); });
  expect_curve(run({"ogden"}, {"mu=10 kPa", "alpha=20", "stretch=1.4"}), "F_xx", "sigma_xx",
               [](double l) { return 1e4 * (std::pow(l, 20) - std::pow(l, -10)); });
}

TEST(Incompressible, EquibiaxialPlanarAndShearAreTheClosedForms) {
  const double mu = 1e4;
  expect_curve(run(neo_hookean, {"mu=10 kPa", "loading=equibiaxial", "stretch=1.8"}), "F_xx", "sigma_xx",
               [&](double l) { return mu * (l * l - std::pow(l, -4)); });
  expect_curve(run(neo_hookean, {"mu=10 kPa", "loading=planar", "stretch=1.8"}), "F_xx", "sigma_xx",
               [&](double l) { return mu * (l * l - 1 / (l * l)); });
  const Curves shear = run(neo_hookean, {"mu=10 kPa", "loading=simple_shear", "shear=1.5", "plane=zy"});
  expect_curve(shear, "F_zy", "sigma_yz", [&](double g) { return mu * g; });
  expect_curve(shear, "F_zy", "sigma_zz", [&](double g) { return mu * g * g; });  // sigma_yy from a free x axis
}

TEST(Incompressible, StressControlIsStretchControlTurnedRound) {
  const Curves by_stress = run(neo_hookean, {"mu=10 kPa", "stress=12 kPa"});
  expect_curve(by_stress, "F_xx", "P_xx", [](double l) { return 1e4 * (l - 1 / (l * l)); });
  EXPECT_DOUBLE_EQ(by_stress["P_xx"].back(), 12e3);
  const Curves biaxial = run(neo_hookean, {"mu=10 kPa", "loading=biaxial", "ratio=0.5", "stress=8 kPa"});
  EXPECT_NEAR(biaxial["P_yy"].back(), 4e3, 1e-7);
}

TEST(Compressible, StVenantKirchhoffInTensionAndConfinement) {
  const Words keys{"mu=10 kPa", "lambda=40 kPa"};
  const double E = 1e4 * (3 * 4e4 + 2e4) / (4e4 + 1e4);
  Words tension = keys, confined = keys;
  tension.push_back("stretch=1.6"), confined.insert(confined.end(), {"stretch=0.7", "loading=confined"});
  expect_curve(run({"st_venant_kirchhoff"}, tension), "F_xx", "P_xx",
               [&](double l) { return 0.5 * E * l * (l * l - 1); });
  expect_curve(run({"st_venant_kirchhoff"}, confined), "F_xx", "P_xx", [](double l) { return 3e4 * l * (l * l - 1); });
}

TEST(Compressible, TheSidesOfAFibreOffTheAxisAreFreeOfStress) {
  const Curves c = run({"neo_hookean", "linear_fibre"}, {"mu=10 kPa", "stiffness=200 kPa", "fibre=[0.8, 0.36, 0.48]",
                                                         "volumetric.bulk_modulus=1 MPa", "stretch=1.4"});
  EXPECT_GT(c["sigma_xx"].back(), 1e4);
  EXPECT_GT(std::abs(c["F_xy"].back()), 0.01);
  for (const char* side : {"sigma_yy", "sigma_zz", "sigma_xy", "sigma_yz", "sigma_zx"})
    EXPECT_NEAR(c[side].back(), 0, 1e-7 * c["sigma_xx"].back()) << side;
}

TEST(Work, IsTheEnergyAtSecondOrderInTheSteps) {
  const auto error = [](const char* steps) {
    const Curves c = run({"gent"}, {"mu=10 kPa", "limit=20", "stretch=1.8", steps});
    return std::abs(c["work"].back() - c["energy"].back());
  };
  EXPECT_NEAR(std::log2(error("steps=20") / error("steps=40")), 2, 0.05);
}

TEST(EveryLaw, IsFoundInTensionAndCompression) {
  for (const LawInfo& law : laws()) {
    if (law.kind == "volumetric" || law.kind == "fluid" || law.published.empty()) continue;
    for (const char* stretch : {"1.1", "0.9"}) {
      SCOPED_TRACE(law.name + " at " + stretch);
      const std::string material =
          "[materials.m]\ndensity = \"1000 kg/m^3\"\nfibre = [1, 0, 0]\nsecond_fibre = [0, 1, 0]\n"
          "volumetric = { law = \"simo\", bulk_modulus = \"1 GPa\" }\n[materials.m.terms]\n"
          "matrix = { law = \"neo_hookean\", mu = \"1 kPa\" }\nlaw = { law = \"" +
          law.name + "\", " + law.published.front().parameters + " }\n";
      const Curves c = run_scene(material + "[point]\nvolume = \"incompressible\"\nsteps = 10\nstretch = " + stretch);
      for (double iterations : c["newton"]) EXPECT_LT(iterations, 15);
    }
  }
}

TEST(Relaxation, OfAPronySeriesIsItsSumOfExponentials) {
  const Curves c = run(neo_hookean, {"mu=10 kPa", "prony={strength=[0.3, 0.2], time=\"0.1, 1 s\"}", "stretch=1.3",
                                     "program=hold", "rise=0 s", "end=5 s", "spacing=logarithmic"});
  const double elastic = 1e4 * (1.3 - 1 / (1.3 * 1.3));
  expect_curve(c, "time", "P_xx",
               [&](double t) { return elastic * (1 + 0.3 * std::exp(-t / 0.1) + 0.2 * std::exp(-t)); });
}

TEST(Creep, KeepsItsStressAndEndsWhereTheLongTermLawDoes) {
  const Curves c = run(neo_hookean, {"mu=10 kPa", "prony={strength=[0.5], time=\"0.1 s\"}", "stress=5 kPa",
                                     "program=hold", "rise=0 s", "end=5 s"});
  for (double P : c["P_xx"]) EXPECT_NEAR(P, 5e3, 1e-6);
  const double l = c["F_xx"].back();
  EXPECT_NEAR(1e4 * (l - 1 / (l * l)), 5e3, 1e-5);
  EXPECT_LT(c["F_xx"].front(), l);
  // What is put in is stored or dissipated (the jump at the beginning is all stored).
  EXPECT_NEAR(c["work"].back(), c["energy"].back() - c["energy"].front() + c["dissipation_neo_hookean"].back(), 1);
}

TEST(Cycles, ReturnToRestAndCountTheirSteps) {
  const Curves cycle = run(neo_hookean, {"mu=10 kPa", "stretch=1.5", "program=cycle", "cycles=2", "steps=10"});
  EXPECT_EQ(cycle.table.rows.size(), 41u);
  EXPECT_NEAR(cycle["P_xx"].back(), 0, 1e-8);
  EXPECT_NEAR(cycle["work"].back(), 0, 1e-8);
  const Curves sine =
      run(neo_hookean, {"mu=10 kPa", "shear=0.4", "loading=simple_shear", "program=sine", "rise=0.25 s", "steps=5"});
  EXPECT_EQ(sine.table.rows.size(), 21u);
  EXPECT_NEAR(sine["F_xy"][15], -0.4, 1e-15);
  EXPECT_NEAR(sine["time"].back(), 1, 1e-15);
}

const char* const muscle = R"(
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
[materials.muscle.terms]
base = { law = "neo_hookean", mu = "1 Pa" }
active = { law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 1 }
[point]
volume = "incompressible"
program = "isotonic"
release = "0.01 s"
end = "0.0101 s"
steps = 4
)";

/// What a muscle's force does to its velocity: Hill's experiment.
TEST(Isotonic, AReleasedMuscleShortensAtTheVelocityOfItsLoad) {
  for (double load : {0.2, 0.5, 0.8, 1.2}) {
    const Curves c = run_scene(muscle, {fmt::format("point.load={}", load)});
    const double held = c["P_xx"][4];
    const double velocity = c["fibre_rate"].back() / 5, stretch = c["F_xx"].back();
    const double isometric =
        hill::active_force(HillCurve::flexodeal, stretch) / hill::active_force(HillCurve::flexodeal, 1.0);
    EXPECT_NEAR(c["P_xx"].back(), load * held, 1e-9 * held);
    // P = sigma / stretch of an incompressible fibre, but for the soft base
    EXPECT_NEAR(hill::force_velocity(HillCurve::flexodeal, velocity) * isometric / stretch, load, 1e-4) << load;
    EXPECT_EQ(velocity < 0, load < 1);
  }
}

TEST(Rate, OfNoneMakesARampQuasiStatic) {
  const Words ramp{"point.program=ramp", "point.stretch=1.2"};
  Words slow = ramp, still = ramp;
  slow.push_back("point.rise=1e6 s"), still.push_back("point.fibre_rate=none");
  EXPECT_NEAR(run_scene(muscle, slow)["P_xx"].back(), run_scene(muscle, still)["P_xx"].back(), 1);
  Words fast = ramp;
  fast.push_back("point.rise=0.2 s");  // a fifth of the largest rate, lengthening
  EXPECT_GT(run_scene(muscle, fast)["P_xx"].back(), 1.3 * run_scene(muscle, still)["P_xx"].back());
}

TEST(Components, HaveEachItsOwnCourse) {
  const Curves c = run_scene(R"(
[materials.gel]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "100 kPa" }
terms.m = { law = "neo_hookean", mu = "10 kPa" }
[point]
loading = "components"
end = "2 s"
F.xx = { time = "0, 1 s", value = [1, 1.3] }
F.xy = 0.2
P.zz = { time = "1, 2 s", value = "0, -4 kPa" }
)");
  EXPECT_DOUBLE_EQ(c["F_xx"].back(), 1.3);
  EXPECT_DOUBLE_EQ(c["F_xy"].back(), 0.2);
  EXPECT_DOUBLE_EQ(c["F_yx"].back(), 0);
  EXPECT_NEAR(c["P_zz"].back(), -4e3, 1e-7);
  EXPECT_NEAR(c["P_yy"].back(), 0, 1e-7);
  EXPECT_DOUBLE_EQ(c["time"].back(), 2);
}

TEST(TriaxialShear, IsSixShearsFromRest) {
  const Curves c =
      run({"holzapfel_ogden"}, {"a=59 Pa", "b=8.023", "af=18472 Pa", "bf=16.026", "as=2481 Pa", "bs=11.12",
                                "afs=216 Pa", "bfs=11.436", "loading=triaxial_shear", "shear=0.4", "steps=4"});
  EXPECT_EQ(c.table.rows.size(), 30u);
  EXPECT_EQ(c["plane"].back(), 6);
  for (std::size_t k = 0; k < 30; k += 5) EXPECT_EQ(c["energy"][k], 0);
  // Shears that stretch the fibres (fs is F_yx here, fn F_zx) are the stiffest: Dokos et al. 2002.
  EXPECT_GT(c["P_yx"][14], c["P_xy"][4]);
  EXPECT_GT(c["P_zx"][24], c["P_xz"][9]);
}

TEST(Failure, IsAValueWithTheRowsBefore) {
  // A fibre alone that is pushed: nothing resists sideways.
  const PointScene scene = PointScene::read(point_text_of_laws({"linear_fibre"}, {"stiffness=1 kPa", "stretch=0.8"}));
  const CurveTable table = run_experiment(*scene.material, scene.loading);
  EXPECT_NE(table.problem.find("nothing resists"), std::string::npos) << table.problem;
}

}  // namespace
}  // namespace titin::testing
