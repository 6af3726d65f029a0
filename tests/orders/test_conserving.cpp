// What time integration keeps of a free body's energy and momenta.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double solver = 1e-8;  // relative, after hundreds of steps of solver.tolerance = 1e-11

/// Linear and angular momentum [kg m/s], [kg m^2/s].
std::array<double, 6> momenta(Model& model) {
  std::array<double, 6> all;
  for (int i = 0; i < 3; ++i) {
    all[i] = quantity(model, fmt::format("momentum_{}", "xyz"[i]));
    all[3 + i] = quantity(model, fmt::format("angular_momentum_{}", "xyz"[i]));
  }
  return all;
}

/// A soft block thrown and spinning about a slanting axis: it stretches by a few percent and wobbles.
std::string tumbling(const std::string& scheme) {
  return "[time]\nscheme = \"" + scheme + "\"\n[initial]\nvelocity = \"1, 0, 0.5 m/s\"\nspin = \"60, 200, 120 1/s\"\n" +
         "centre = \"15, 5, 5 mm\"\n[muscle]\norder = 1\n[solver]\ntolerance = 1e-11\nlinear_tolerance = 1e-10\n" +
         soft_material;
}

struct Drift {
  double energy = 0, momentum = 0, spin = 0, lowest = 1e300, highest = 0;  // largest so far, relative
  int newton = 0;
};

Drift tumble(const std::string& scheme, double dt, int steps) {
  const auto model = make_block(tumbling(scheme));
  const auto start = momenta(*model);
  const auto energy = [&] {
    return quantity(*model, "energy_kinetic") + quantity(*model, "energy_base") + quantity(*model, "energy_volumetric");
  };
  const double energy_at_start = energy();
  const auto size = [](const std::array<double, 6>& m, int first) {
    return std::sqrt(m[first] * m[first] + m[first + 1] * m[first + 1] + m[first + 2] * m[first + 2]);
  };
  Drift drift;
  for (int n = 0; n < steps; ++n) {
    const Step step = model->advance(dt);
    EXPECT_TRUE(step.ok()) << scheme << ": " << step.failure;
    if (!step.ok()) return drift;
    model->accept();
    const auto now = momenta(*model);
    for (int i = 0; i < 3; ++i) {
      drift.momentum = std::max(drift.momentum, std::abs(now[i] - start[i]) / size(start, 0));
      drift.spin = std::max(drift.spin, std::abs(now[3 + i] - start[3 + i]) / size(start, 3));
    }
    drift.newton = std::max(drift.newton, step.newton);
    const double part = energy() / energy_at_start;
    drift.energy = std::max(drift.energy, std::abs(part - 1));
    drift.lowest = std::min(drift.lowest, part), drift.highest = std::max(drift.highest, part);
  }
  fmt::print(
      "{}: energy off by {:.1e} ({:.6f} to {:.6f}), momentum by {:.1e}, angular momentum by {:.1e}; newton <= {}\n",
      scheme, drift.energy, drift.lowest, drift.highest, drift.momentum, drift.spin, drift.newton);
  return drift;
}

TEST(Momenta, OfARigidMotionAreThoseOfMassAndInertia) {
  const auto model = make_block(tumbling("energy_momentum"));
  constexpr double m = 3e-3, along = m / 12 * 2e-4, across = m / 12 * 1e-3;  // [kg], [kg m^2]
  const std::array<double, 6> exact{
      m, 0, 0.5 * m, 0.0025 * m + along * 60, (0.005 - 0.0075) * m + across * 200, -0.005 * m + across * 120};
  const auto start = momenta(*model);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(start[i], exact[i], 1e-12) << i;
}

TEST(Momenta, OfAPlaneBodyAreInItsPlaneAndOfItsThickness) {
  const auto model = make_block(
      "[initial]\nvelocity = \"2, 1 m/s\"\nspin = \"0, 0, 100 1/s\"\ncentre = \"15, 5 mm\"\n" + soft_material, false,
      {"mesh.box=\"30, 10 mm\"", "mesh.cells=[2, 2]", "mesh.thickness=20 mm"});
  constexpr double m = 6e-3;
  EXPECT_NEAR(quantity(*model, "momentum_x"), 2 * m, 1e-12);
  EXPECT_NEAR(quantity(*model, "momentum_y"), m, 1e-12);
  EXPECT_NEAR(quantity(*model, "angular_momentum_z"), (0.015 - 0.01) * m + m / 12 * 1e-3 * 100, 1e-12);
  for (const char* other : {"momentum_z", "angular_momentum_x"})
    EXPECT_THROW(quantity(*model, other), std::out_of_range) << other;
}

TEST(Tumbling, KeepsEnergyAndMomentaInTheConservingScheme) {
  const Drift drift = tumble("energy_momentum", 2e-3, 300);  // a turn takes 26 ms
  EXPECT_LT(drift.energy, solver);
  EXPECT_LT(drift.momentum, solver);
  EXPECT_LT(drift.spin, solver);
  EXPECT_LE(drift.newton, 6);  // 28 degrees a step
}

TEST(Tumbling, LosesOrGainsEnergyInTheOthers) {
  EXPECT_LT(tumble("backward_euler", 1e-3, 100).lowest, 0.9);
  const Drift newmark = tumble("newmark", 1e-3, 100);
  EXPECT_GT(newmark.energy, 1e-4);
  EXPECT_LT(newmark.energy, 0.2);
  EXPECT_GT(newmark.spin, 1e-6);
}

}  // namespace
}  // namespace titin
