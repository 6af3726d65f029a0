// Borders of the maps in docs/verification/charts.md: at a few points beside each, what works there and what does not,
// with the scenes of configs as the benches run them. A border that moves must move its map.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/log.hpp"
#include "scene/scene.hpp"

namespace titin {
namespace {

using Settings = std::vector<std::string>;

struct Ran {
  std::string failure;                            // empty when it finished
  std::map<std::string, double> errors, last;     // against the exact solution; quantities at the end
  std::map<std::string, double> lowest, highest;  // quantities so far, from the start on
  double range(const std::string& name) const { return highest.at(name) - lowest.at(name); }
};

void note(Model& model, Ran& ran) {
  for (const Quantity& q : model.quantities()) {
    ran.last[q.name] = q.value;
    const auto [low, first] = ran.lowest.try_emplace(q.name, q.value);
    const auto [high, also] = ran.highest.try_emplace(q.name, q.value);
    low->second = std::min(low->second, q.value), high->second = std::max(high->second, q.value);
  }
}

/// A scene to its end, without files.
Ran run(const std::string& name, const Settings& settings) {
  const Scene scene = Scene::read(fmt::format("{}/../../configs/{}.toml", TITIN_TEST_DATA, name), settings);
  Model& model = *scene.model;
  Clock clock(scene.clock, model.largest_dt());
  clock.land_on(model.kinks());
  Ran ran;
  note(model, ran);
  while (!clock.done()) {
    const Step step = model.advance(clock.dt());
    if (!step.ok()) {
      model.rewind();
      if (clock.cut(step)) continue;
      ran.failure = step.failure;
      return ran;
    }
    model.accept();
    clock.accept(step, model.largest_dt());
    note(model, ran);
  }
  for (const Quantity& q : model.errors()) ran.errors[q.name] = q.value;
  return ran;
}

Settings operator+(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// ---- The swinging plate: configs/bench/poisson.toml, distortion.toml

constexpr double amplitude = 5e-6, shear_modulus = 5.86206896552e6;  // [m], [Pa]

/// Error of the displacement after an eighth of a period, over the displacement. Negative when the run ends before.
double plate(const std::string& model, const Settings& settings) {
  const Settings eighth{"time.end=4.843127325 ms", "exact_motion.swing.amplitude=0.005 mm",
                        model == "lagrange" ? "initial.swing.rate=0.0008108378218" : "initial.rate=0.0008108378218"};
  const Settings tight = model == "lagrange" ? Settings{} : Settings{"solver.tolerance=1e-8"};
  const Ran ran = run(model + "/swinging_plate", eighth + tight + settings);
  const double error = ran.failure.empty() ? ran.errors.at("displacement_L2") / amplitude : -1;
  fmt::print("{} {}: {:.3g} {}\n", model, fmt::join(settings, " "), error, ran.failure);
  return error;
}

Settings of_ratio(double ratio) {
  const double bulk = shear_modulus * 2 * (1 + ratio) / (3 * (1 - 2 * ratio));
  return {fmt::format("materials.rubber.volumetric.bulk_modulus={:.12g} Pa", bulk),
          fmt::format("exact_motion.bulk_modulus={:.12g} Pa", bulk)};
}

TEST(Ratio, IsOfNoConcernToPairsThatDoNotLock) {
  for (double ratio : {0.3, 0.49999}) {
    EXPECT_LT(std::abs(plate("muscle", Settings{"mesh.cells=[8, 8]"} + of_ratio(ratio))), 2e-3);
    EXPECT_LT(std::abs(plate("muscle", Settings{"mesh.cells=[16, 16]", "muscle.order=1"} + of_ratio(ratio))), 0.02);
  }
}

TEST(Ratio, LocksDisplacementsAlone) {
  const Settings first{"mesh.cells=[16, 16]", "muscle.element=displacement", "muscle.order=1"};
  EXPECT_LT(std::abs(plate("muscle", first + of_ratio(0.45))), 0.05);
  EXPECT_GT(plate("muscle", first + of_ratio(0.4999)), 0.2);
}

TEST(Ratio, LocksFiniteVolumesAlongOneDiagonal) {
  const Settings crossed{"mesh.cells=[16, 16]"}, same = crossed + Settings{"mesh.cuts=same"},
                                                 patches = same + Settings{"fv.patch_pressure=true"};
  EXPECT_GT(plate("lagrange", same + of_ratio(0.499)), 0.2);
  for (const Settings& cure : {crossed, patches}) {
    const double helped = plate("lagrange", cure + of_ratio(0.499));
    EXPECT_GE(helped, 0);
    EXPECT_LT(helped, 0.1);
  }
}

// ---- Pressures of a plate that has none, and what a skewed mesh leaves: configs/bench/chequerboard.toml, imprint.toml

/// Over the largest shear stress, after a quarter of a period.
double pressure(const Settings& settings) {
  constexpr double shear_stress = 184.2;  // [Pa m], in L2
  const Settings quarter{"time.end=9.68625465 ms", "exact_motion.swing.amplitude=0.005 mm",
                         "initial.swing.rate=0.0008108378218", "mesh.cells=[16, 16]"};
  return run("lagrange/swinging_plate", quarter + settings).errors.at("pressure_L2") / shear_stress;
}

TEST(Chequerboard, IsThereAlongOneDiagonalAndGoneWithPatches) {
  EXPECT_GT(pressure({"mesh.cuts=same"}), 0.25);
  EXPECT_LT(pressure({}), 0.016);
  EXPECT_LT(pressure({"fv.patch_pressure=true"}), 1e-5);
}

TEST(Imprint, IsLessenedByRestAndByLimitedSlopes) {
  constexpr double momentum = 0.02;  // of the shocked gas at one density, in L1 [m^3/s/m]
  const auto noise = [](const std::string& setting) {
    return run("lagrange/saltzman", {"mesh.cells=[50, 5]", setting}).errors.at("velocity_L1") / momentum;
  };
  EXPECT_GT(noise("fv.rest=0"), 0.09);
  EXPECT_LT(noise("fv.rest=80"), 0.075);
  EXPECT_LT(noise("fv.limiter=barth_jespersen"), 0.04);
}

// ---- Angular momentum of the L-shaped block, 15 s after the last force: configs/bench/angular_momentum.toml

TEST(AngularMomentum, IsKeptBySlopesAndLostWithout) {
  constexpr double kept = -142766.1;  // [kg m^2/s] about z, by finite elements
  const auto part = [](const Settings& settings) {
    return run("lagrange/l_block", Settings{"mesh.refine=0"} + settings).last.at("angular_momentum_z") / kept;
  };
  EXPECT_NEAR(part({}), 1, 0.08);
  EXPECT_LT(std::abs(part({"fv.order=1"})), 0.1);
}

Settings skewed(double skew) { return {"mesh.cells=[8, 8]", fmt::format("mesh.shape.skew={} m", skew)}; }

TEST(Distortion, IsBorneUntilCellsAreInsideOutAndThenSaysSo) {
  for (const char* model : {"muscle", "lagrange"}) {
    EXPECT_GE(plate(model, skewed(0.6)), 0) << model;
    EXPECT_EQ(plate(model, skewed(0.8)), -1) << model;
  }
}

TEST(Distortion, IsWarnedOfWhereACornerIsInsideOut) {
  const auto warnings = [](const char* skew) {
    const int before = logging::warnings();
    Scene::read(TITIN_TEST_DATA "/../../configs/muscle/swinging_plate.toml",
                {"mesh.cells=[16, 16]", "muscle.order=1", fmt::format("mesh.shape.skew={}", skew)});
    return logging::warnings() - before;
  };
  EXPECT_EQ(warnings("0.6 m"), 0);
  EXPECT_EQ(warnings("0.65 m"), 1);
}

// ---- A branch that relaxes: configs/bench/relaxation.toml; the numbers are of tests/data/exact/relaxing.py

constexpr double share = 1.2718;  // [N] what the branch can add

double relaxing(const std::string& step, const Settings& settings, double exact) {
  const Ran ran = run("muscle/relaxing", Settings{"time.step=" + step} + settings);
  EXPECT_EQ(ran.failure, "");
  if (!ran.failure.empty()) return 1e300;
  fmt::print("step {}, {}: {:.2e}\n", step, fmt::join(settings, " "), (ran.last.at("reaction_x+_x") - exact) / share);
  return std::abs(ran.last.at("reaction_x+_x") - exact) / share;
}

TEST(Relaxation, TakesStepsOfTenThousandTimesItsTimeAndOfItsTenThousandthPart) {
  const Settings prony{"~materials.gel.terms.base", "~materials.gel.terms.branch.maxwell",
                       "materials.gel.terms.branch.mu=10 kPa"};
  const auto time = [](const char* tau) {
    return Settings{fmt::format("materials.gel.terms.branch.prony={{ strength = [3], time = \"{}\" }}", tau)};
  };
  const auto viscosity = [](const char* eta) {
    return Settings{fmt::format("materials.gel.terms.branch.maxwell.viscosity={}", eta)};
  };
  for (const char* step : {"1 s", "0.1 s"}) {
    EXPECT_LT(relaxing(step, prony + time("1e-4 s"), 4.590674483), 1e-3);
    EXPECT_LT(relaxing(step, prony + time("1e4 s"), 5.862455982), 1e-3);
    EXPECT_LT(relaxing(step, viscosity("3 Pa s"), 4.590723797), 1e-3);
    EXPECT_LT(relaxing(step, viscosity("300 MPa s"), 5.862449665), 1e-3);
  }
}

TEST(Relaxation, IsMissedByMaxwellElementsInStepsOfItsOwnTime) {
  EXPECT_GT(relaxing("1 s", {"materials.gel.terms.branch.maxwell.viscosity=30 kPa s"}, 5.289724092), 0.05);
  EXPECT_LT(relaxing("0.1 s", {"materials.gel.terms.branch.maxwell.viscosity=30 kPa s"}, 5.289724092), 0.05);
}

// ---- The tumbling bar: configs/bench/tumbling.toml, tumbling_momentum.toml

/// Of energy and angular momentum in some turns, over what there is; negative when the run ends before.
struct Changes {
  double energy = -1, spin = -1;
};

Changes tumbled(const std::string& scheme, const std::string& step) {
  const Ran ran = run("muscle/tumbling_bar", {"time.scheme=" + scheme, "time.step=" + step, "time.end=2 s"});
  Changes changes;
  if (ran.failure.empty())
    changes = {
        ran.range("energy_balance_error") / 128.5333333,
        std::hypot(ran.range("angular_momentum_x"), ran.range("angular_momentum_y"), ran.range("angular_momentum_z")) /
            43.92640310};
  fmt::print("{}, {}: energy {:.2e}, angular momentum {:.2e} {}\n", scheme, step, changes.energy, changes.spin,
             ran.failure);
  return changes;
}

TEST(Tumbling, KeepsEnergyAndAngularMomentumInTheConservingSchemeWithElevenStepsATurn) {
  for (const char* step : {"50 ms", "100 ms"}) {
    const Changes changes = tumbled("energy_momentum", step);
    EXPECT_GE(changes.energy, 0);
    EXPECT_LT(changes.energy, 1e-8);
    EXPECT_LT(changes.spin, 1e-8);
  }
}

TEST(Tumbling, LosesBothInBackwardEuler) {
  const Changes changes = tumbled("backward_euler", "50 ms");
  EXPECT_GT(changes.energy, 0.2);
  EXPECT_GT(changes.spin, 0.2);
}

// ---- Fibres that go slack: configs/bench/slack_fibres.toml, slack_rounding.toml

/// The block sheared to and fro, both families of this law.
Ran sheared(const std::string& law, const std::string& step) {
  const Ran ran =
      run("muscle/slack_fibres", {"time.step=" + step, "time.max_cuts=4", "materials.wall.terms.up={" + law + "}",
                                  "materials.wall.terms.down={" + law + ", family=\"second\"}"});
  fmt::print("{}, {}: {:.8f} N {}\n", law, step, ran.last.at("reaction_x+_y"), ran.failure);
  return ran;
}

constexpr const char* sharp = "law=\"goh\", k1=\"2.5 MPa\", k2=1";

TEST(SlackFibres, GoSlackAndTautInStepsOfAnyLengthAndGiveTheSameForce) {
  for (const std::string law : {"law=\"linear_fibre\", stiffness=\"10 MPa\"", sharp}) {
    const Ran coarse = sheared(law, "0.3 s"), fine = sheared(law, "30 ms");
    EXPECT_EQ(coarse.failure + fine.failure, "");
    const double force = fine.last.at("reaction_x+_y");
    EXPECT_NEAR(coarse.last.at("reaction_x+_y"), force, 1e-5 * std::abs(force));
  }
}

TEST(SlackFibres, WhoseStressJumpsEndTheRun) {
  EXPECT_NE(sheared(std::string(sharp) + ", kappa=0.1, switch=\"I4\"", "30 ms").failure, "");
  EXPECT_EQ(sheared(std::string(sharp) + ", kappa=0.1", "30 ms").failure, "");
}

TEST(SlackFibres, RoundedOffPullWhereTheyWereSlack) {
  const double force = sheared(sharp, "0.1 s").last.at("reaction_x+_y");
  const auto error = [&](const char* width) {
    const Ran ran = sheared(std::string(sharp) + ", switch_width=" + width, "0.1 s");
    return ran.last.at("reaction_x+_y") / force - 1;
  };
  EXPECT_LT(error("1e-3"), 2e-3);
  EXPECT_GT(error("1e-2"), 0.01);
}

// ---- Wall heating: configs/bench/wall_heating.toml

TEST(WallHeating, MakesGasThinAtTheOriginOfNohsImplosion) {
  const Ran ran =
      run("lagrange/noh", {"mesh.cells=[20, 20]", "averages.origin={ lower = \"0, 0 m\", upper = \"0.1, 0.1 m\" }"});
  ASSERT_EQ(ran.failure, "");
  const double error = ran.last.at("mean_density_origin") / 16 - 1;
  fmt::print("density at the origin off by {:.3f}\n", error);
  EXPECT_LT(error, -0.05);
  EXPECT_GT(error, -0.6);
}

}  // namespace
}  // namespace titin
