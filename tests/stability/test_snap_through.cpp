// Clamped arches that snap through: half of one, in plane strain, its crown (a plane of symmetry) pushed down. Given
// displacements and inertia pass. Under a dead load the quasi-static path ends at its limit point: Newton's method
// finds the far side, where there is one in reach, or stops with the reason.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../fe/blocks.hpp"
#include "solve/clock.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double span = 50e-3, thickness = 1e-3;  // [m]; span of the half
constexpr double shallow = 2.5e-3, steep = 5e-3;  // [m], rise

std::unique_ptr<Muscle> arch(double rise, const std::string& inertia, const std::string& crown) {
  Parts parts = read_block("[muscle]\ninertia = \"" + inertia + "\"\n" + R"(
[materials.soft]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "neo_hookean", mu = "1 MPa" }
[boundary."x-"]
clamp = true
[boundary."x+"]
)" + crown + "\n",
                           false, {"mesh.box=\"50, 1 mm\"", "mesh.cells=[12, 1]", "mesh.thickness=\"1 m\""});
  mfem::VectorFunctionCoefficient place(2, [rise](const mfem::Vector& x, mfem::Vector& y) {
    y = x;
    y(1) += 0.5 * rise * (1 - std::cos(std::numbers::pi * x(0) / span));
  });
  parts.named.mesh->Transform(place);
  return std::make_unique<Muscle>(std::move(parts.named), std::move(parts.muscle));
}

struct Path {
  bool finished = false;
  double largest = 0, least_after = 1e300;  // of the reaction (downward) at the crown [N], and after its maximum
  double sunk = 0, time = 0;                // of the crown, at the end [m], [s]
  std::string failure;
};

double crown_height(Muscle& model) {
  double lowest = 1e300;
  const mfem::Vector& u = model.displacement();
  for (int dof : model.system().constraints().boundary_dofs(1)[1]) lowest = std::min(lowest, u(dof));
  return lowest;
}

Path follow(Muscle& model, const ClockConfig& config) {
  Clock clock(config);
  Path path;
  while (!clock.done()) {
    const Step step = model.advance(clock.dt());
    if (!step.ok()) {
      model.rewind();
      path.failure = step.failure;
      if (!clock.cut(step)) break;
      continue;
    }
    model.accept();
    clock.accept(step, model.largest_dt());
    const double force = -quantity(model, "reaction_x+_y");
    if (force > path.largest) path.largest = force, path.least_after = force;
    path.least_after = std::min(path.least_after, force);
  }
  path.finished = clock.done();
  path.time = clock.time();
  path.sunk = -crown_height(model);
  fmt::print("{} at {:.4f} s: reaction up to {:.4f} N, then down to {:.4f} N; crown sank by {:.3f} mm; {}\n",
             path.finished ? "finished" : "stopped", clock.time(), path.largest, path.least_after, 1e3 * path.sunk,
             path.failure);
  return path;
}

std::string pushed(double depth) {
  return fmt::format("displacement = {{ x = \"0 mm\", y = {{ time = \"0, 1 s\", value = \"0, {:.6g} m\" }} }}", -depth);
}
std::string loaded(double pressure) {
  return fmt::format(
      "displacement.x = \"0 mm\"\ntraction = \"0, {:.6g} Pa\"\ntraction_scale = {{ time = \"0, 1 s\", value = [0, 1] "
      "}}",
      -pressure);
}

constexpr double overload = 1.3;  // of the dead load, over what the arch can carry

/// Traction at the limit point [Pa], from a path of given displacements to `depth` behind it.
double limit(double rise, double depth) {
  const auto model = arch(rise, "quasi-static", pushed(depth));
  const Path path = follow(*model, {.end = 1, .step = 0.05});
  EXPECT_TRUE(path.finished);
  EXPECT_LT(path.least_after, 0.7 * path.largest) << "no limit point";
  return path.largest / thickness;
}

TEST(SnapThrough, OfAShallowArchEndsOnTheFarSideWithAndWithoutInertia) {
  const std::string load = loaded(overload * limit(shallow, 2 * shallow));
  const auto still = arch(shallow, "quasi-static", load), moving = arch(shallow, "dynamic", load);
  const Path jump = follow(*still, {.end = 1, .step = 0.025}), swing = follow(*moving, {.end = 1, .step = 0.01});
  EXPECT_TRUE(jump.finished);
  EXPECT_TRUE(swing.finished);
  EXPECT_GT(jump.sunk, 2 * shallow);
  EXPECT_NEAR(swing.sunk, jump.sunk, 1e-3 * jump.sunk) << "it still swings a little, and the load still grows";
}

TEST(SnapThrough, OfASteepArchStopsADeadLoadAndSaysWhyUnlessInertiaCarriesItOn) {
  const std::string load = loaded(overload * limit(steep, steep));
  const auto still = arch(steep, "quasi-static", load), moving = arch(steep, "dynamic", load);
  const Path stop = follow(*still, {.end = 1, .step = 0.05}), swing = follow(*moving, {.end = 1, .step = 0.01});
  EXPECT_FALSE(stop.finished);
  EXPECT_LE(overload * stop.time, 1) << "more than it can carry";
  EXPECT_GT(overload * stop.time, 0.7);
  EXPECT_LT(stop.sunk, 0.5 * steep) << "on the near side";
  EXPECT_NE(stop.failure.find("residual"), std::string::npos) << stop.failure;
  EXPECT_TRUE(swing.finished);
  EXPECT_GT(swing.sunk, 2 * steep) << "on the far side";
}

}  // namespace
}  // namespace titin
