// Time integration of whole bodies: orders of every scheme, with and without active fibres; what they keep of energy
// and of angular momentum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

using namespace test;

// Far below the errors that are measured, above the round-off of stresses under the first, small loads.
const std::string exactly = "[solver]\ntolerance = 1e-9\nlinear_tolerance = 1e-8\n";

/// sin^2 from 0 to `top`, at `end` [s], in pieces that no step can see.
std::string smooth_rise(double top, double end, const std::string& unit) {
  constexpr int pieces = 1600;
  std::string time = "0", value = "0";
  for (int i = 1; i <= pieces; ++i) {
    const double t = end / pieces * i, s = std::sin(M_PI / 2 * t / end);
    time += fmt::format(", {}", t);
    value += fmt::format(", {}", top * s * s);
  }
  const std::string values = unit.empty() ? "[" + value + "]" : "\"" + value + " " + unit + "\"";
  return "{ time = \"" + time + " s\", value = " + values + " }";
}

/// A soft block, clamped at one end, that a growing body force bends.
const std::string bending_block = soft_material +
                                  "[boundary.\"x-\"]\nclamp = true\n[body]\nacceleration = \"0, 0, 150 m/s^2\"\n" +
                                  "scale = " + smooth_rise(1, 0.008, "") + "\n" + exactly;
constexpr double bending_time = 0.008;

/// A muscle that is pulled while its fibres become active.
/// Fibres resist fast changes of length the more the lower `max_strain_rate` [1/s].
std::string contraction(const char* max_strain_rate) {
  return R"(
[muscle]
fibre_rate = "velocity_gradient"
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8660254037844386, 0, 0.5]
volumetric = { law = "simo", bulk_modulus = "1 MPa" }
[materials.muscle.terms]
base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = ")" +
         std::string(max_strain_rate) + R"( 1/s"
curve = "degroote"
activation = )" +
         smooth_rise(0.3, 0.04, "") +
         "\n[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement.x = " + smooth_rise(1, 0.04, "mm") +
         "\ndisplacement.y = \"0 mm\"\ndisplacement.z = \"0 mm\"\n" + exactly;
}
constexpr double contraction_time = 0.04;

/// Displacement at `end` after `count` steps; every other one is longer by `uneven`.
mfem::Vector displacement_at(const std::string& text, double end, int count, double uneven) {
  const auto model = make_block(text);
  for (int n = 0; n < count; ++n) {
    const Step step = model->advance(end / count * (n % 2 == 0 ? 1 + uneven : 1 - uneven));
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) break;
    model->accept();
  }
  return model->displacement();
}

double distance(const mfem::Vector& a, const mfem::Vector& b) {
  mfem::Vector d = a;
  d -= b;
  return std::sqrt(sum(d * d));
}

/// Order from three runs, each with half the steps of the one before.
double order(const std::string& text, double end, int count, double uneven) {
  const mfem::Vector u1 = displacement_at(text, end, count, uneven), u2 = displacement_at(text, end, 2 * count, uneven),
                     u4 = displacement_at(text, end, 4 * count, uneven);
  const double slope = std::log2(distance(u1, u2) / distance(u2, u4));
  fmt::print("  differences over the displacement {:.2e} {:.2e}, slope {:.3f}\n",
             distance(u1, u2) / std::sqrt(sum(u4 * u4)), distance(u2, u4) / std::sqrt(sum(u4 * u4)), slope);
  return slope;
}

struct Case {
  const char* name;
  const char* time;
  double order, active_order;  // expected
  const char* max_strain_rate = "5";
};

const std::vector<Case> cases = {
    {"backward_euler", "scheme = \"backward_euler\"", 1, 1},
    {"semi_implicit", "scheme = \"semi_implicit\"", 1, 1, "2000"},  // unstable where the rate matters more
    {"newmark", "scheme = \"newmark\"", 2, 2},
    {"newmark_rothe", "scheme = \"newmark\"\nvelocity = \"rothe\"", 2, 1},
    {"hht_alpha", "scheme = \"hht_alpha\"\nalpha = 0.1", 2, 2},
    {"generalised_alpha", "scheme = \"generalised_alpha\"\nspectral_radius = 0.7", 2, 2},
    {"bdf2", "scheme = \"bdf2\"", 2, 2},
    {"energy_momentum", "scheme = \"energy_momentum\"", 2, 2},
};

class Schemes : public testing::TestWithParam<Case> {
 protected:
  std::string time() const { return std::string("[time]\n") + GetParam().time + "\n"; }
};

TEST_P(Schemes, HaveTheirOrderInAnElasticBody) {
  fmt::print("{}, bending, equal steps:\n", GetParam().name);
  EXPECT_NEAR(order(time() + bending_block, bending_time, 20, 0), GetParam().order, 0.25);
  fmt::print("{}, bending, uneven steps:\n", GetParam().name);
  EXPECT_NEAR(order(time() + bending_block, bending_time, 20, 0.25), GetParam().order, 0.25);
}

TEST_P(Schemes, HaveTheirOrderInActiveMuscle) {
  fmt::print("{}, active muscle:\n", GetParam().name);
  EXPECT_NEAR(order(time() + contraction(GetParam().max_strain_rate), contraction_time, 20, 0), GetParam().active_order,
              0.25);
}

INSTANTIATE_TEST_SUITE_P(All, Schemes, testing::ValuesIn(cases), [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace titin
