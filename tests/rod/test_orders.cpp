// Orders of the rod in space and time against a solution that its body force makes one; of its eigenfrequencies, and
// from chain to continuum.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/hill_curves.hpp"
#include "rod/rod_stability.hpp"
#include "rods.hpp"

namespace titin {
namespace {

using namespace test;

const std::string ends_held = R"(
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = "0 mm"
)";

// A muscle that is active all the time: its force depends on stretch and rate, smoothly.
const std::string muscle = R"(
[rod]
length = "100 mm"
area = "1 cm^2"
[solver]
tolerance = 1e-11
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "neo_hookean", mu = "200 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
curve = "degroote"
stress = "nominal"
activation = 0.5
)" + ends_held;

/// u = U (1 - cos w t) (sin(pi X / L) + sin(2 pi X / L) / 2), at rest at t = 0.
struct Wave {
  static inline double max_strain_rate = 5;  // [1/s]
  static constexpr double U = 0.001, w = 60, L = rod_length, h = 1e-3 * rod_length;
  static double form(double X, int derivative) {
    const double k = M_PI / L, quarter = derivative * M_PI / 2;
    return std::pow(k, derivative) * std::sin(k * X + quarter) +
           0.5 * std::pow(2 * k, derivative) * std::sin(2 * k * X + quarter);
  }
  static double u(double X, double t) { return U * (1 - std::cos(w * t)) * form(X, 0); }
  static double stress(double X, double t) {
    const double l = 1 + U * (1 - std::cos(w * t)) * form(X, 1), rate = U * w * std::sin(w * t) * form(X, 1);
    return 2e5 * (l - 1 / (l * l)) + 0.5 * 2e5 * hill::active_force(HillCurve::degroote, l) *
                                         hill::force_velocity(HillCurve::degroote, rate / max_strain_rate);
  }
  /// rho u'' - dN/dX, by differences of sixth order [N/m^3].
  static double body(double X, double t) {
    const auto odd = [&](int k) { return stress(X + k * h, t) - stress(X - k * h, t); };
    return rod_density * U * w * w * std::cos(w * t) * form(X, 0) - (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
  }
};

/// Error of the displacement at the nodes at `end`, root mean square over that of the displacement.
double error_of_wave(int steps, double end, const Overrides& set) {
  Overrides all = {fmt::format("materials.muscle.terms.active.max_strain_rate={} 1/s", Wave::max_strain_rate)};
  all.insert(all.end(), set.begin(), set.end());
  RodParts parts = read_rod(muscle, all);
  parts.config.body = Wave::body;
  Rod rod(std::move(parts.mesh), std::move(parts.config));
  for (int n = 0; n < steps; ++n) {
    const Step step = rod.advance(end / steps);
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) return NAN;
    rod.accept();
  }
  // Between nodes too: nodal values of one-dimensional elements are better than the rest.
  double error = 0, size = 0;
  for (int i = 0; i < 997; ++i) {
    const double X = (i + 0.5) / 997 * rod_length;
    const RodElement& element = rod.system().lattice().element_at(X);
    const auto N = element.shape((X - element.begin) / element.length);
    double u = 0;
    for (int a = 0; a < element.nodes; ++a) u += N[a] * rod.displacement()(element.first + a);
    error += std::pow(u - Wave::u(X, end), 2);
    size += std::pow(Wave::u(X, end), 2);
  }
  return std::sqrt(error / size);
}

TEST(RodOrder, InSpaceIsOneMoreThanThatOfItsElements) {
  Wave::max_strain_rate = 5;
  for (int order : {1, 2}) {
    std::vector<double> errors;
    for (int cells : {16, 32, 64})
      errors.push_back(error_of_wave(
          800, 0.02, {fmt::format("rod.order={}", order), fmt::format("rod.cells={}", cells), "time.scheme=newmark"}));
    const double slope = std::log2(errors[1] / errors[2]);
    fmt::print("order {} in space: errors {:.2e} {:.2e} {:.2e}, slope {:.3f}\n", order, errors[0], errors[1], errors[2],
               slope);
    EXPECT_NEAR(slope, order + 1, 0.15);
  }
}

class Schemes : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(Schemes, HaveTheirOrderInTime) {
  const auto [scheme, order] = GetParam();
  // Rates of the step before are an explicit viscosity c: short waves survive it while c / dt is less than half of the
  // modulus, where its error of first order is less than that of second order. So few and large steps, and a c that
  // lets short waves grow from round-off in no more than twenty of them.
  const bool lagged = scheme == std::string("semi_implicit");
  Wave::max_strain_rate = lagged ? 500 : 5;
  std::vector<double> errors;
  for (int steps : lagged ? std::vector{5, 10, 20} : std::vector{20, 40, 80})
    errors.push_back(
        error_of_wave(steps, 0.02, {"rod.order=2", "rod.cells=96", fmt::format("time.scheme={}", scheme)}));
  const double slope = std::log2(errors[1] / errors[2]);
  fmt::print("{}: errors {:.2e} {:.2e} {:.2e}, slope {:.3f}\n", scheme, errors[0], errors[1], errors[2], slope);
  EXPECT_NEAR(slope, order, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Rod, Schemes,
                         testing::Values(std::pair{"backward_euler", 1}, std::pair{"semi_implicit", 1},
                                         std::pair{"newmark", 2}, std::pair{"hht_alpha", 2},
                                         std::pair{"generalised_alpha", 2}, std::pair{"bdf2", 2},
                                         std::pair{"energy_momentum", 2}),
                         [](const auto& info) { return std::string(info.param.first); });

/// Relative error of the third eigenfrequency of the rod between held ends.
double error_of_frequency(const Overrides& set) {
  const auto rod = make_rod(linear_rod + ends_held, set);
  const double exact = 3 * M_PI / rod_length * std::sqrt(rod_modulus / rod_density);
  return std::abs(std::sqrt(squared_frequencies(rod->system(), rod->displacement(), 0)[2]) / exact - 1);
}

TEST(RodOrder, OfEigenfrequenciesIsTwiceThatOfItsElements) {
  for (int order : {1, 2}) {
    const auto error = [&](int cells) {
      return error_of_frequency({fmt::format("rod.order={}", order), fmt::format("rod.cells={}", cells)});
    };
    const double slope = std::log2(error(16) / error(32));
    fmt::print("eigenfrequencies, order {}: {:.2e} {:.2e}, slope {:.3f}\n", order, error(16), error(32), slope);
    EXPECT_NEAR(slope, 2 * order, 0.05);
  }
}

TEST(RodOrder, OfChainsIsTwoWithCentredMassesAndOneWithEvenOnes) {
  for (const auto& [spacing, order] : {std::pair{"centred", 2}, std::pair{"even", 1}}) {
    const auto error = [&](int masses) {
      return error_of_frequency(
          {"rod.kind=chain", fmt::format("rod.masses={}", masses), fmt::format("rod.spacing={}", spacing)});
    };
    const double slope = std::log2(error(128) / error(256));
    fmt::print("chain, {}: {:.2e} {:.2e}, slope {:.3f}\n", spacing, error(128), error(256), slope);
    EXPECT_NEAR(slope, order, 0.1);
  }
}

/// The motion of an active chain against that of the continuum, both driven at one end, in waves: fibres that resist
/// their rate little. Backward Euler: what Newmark's scheme makes of the jumps in the end's velocity is the mesh's.
TEST(RodOrder, OfAChainsMotionIsTwo) {
  const std::string driven = R"(
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = { time = "0, 10, 20 ms", value = "0, 4, 1 mm" }
)";
  const auto force = [&](const Overrides& set) -> double {
    Overrides all = {"time.scheme=backward_euler", "materials.muscle.terms.active.max_strain_rate=500 1/s"};
    all.insert(all.end(), set.begin(), set.end());
    const auto rod = make_rod(muscle.substr(0, muscle.find("[boundary")) + driven, all);
    for (int n = 0; n < 100; ++n) {
      const Step step = rod->advance(2e-4);
      EXPECT_TRUE(step.ok()) << step.failure;
      if (!step.ok()) return NAN;
      rod->accept();
    }
    return quantity(*rod, "reaction_x-_x");
  };
  const double exact = force({"rod.order=2", "rod.cells=64"});
  const auto error = [&](int masses) {
    return std::abs(force({"rod.kind=chain", fmt::format("rod.masses={}", masses)}) / exact - 1);
  };
  const double coarse = error(32), fine = error(64), slope = std::log2(coarse / fine);
  fmt::print("force of a driven chain: {:.2e} {:.2e}, slope {:.3f}\n", coarse, fine, slope);
  EXPECT_NEAR(slope, 2, 0.3);
}

/// A pulse along a stretched rod: sqrt(dN/dl / rho).
TEST(Wave, TravelsAtTheSpeedOfItsTangent) {
  const std::string pulse = R"(
[rod]
length = "1 m"
area = "1 cm^2"
cells = 100
order = 2
start.stretch = 1.3
[time]
scheme = "newmark"
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
terms.passive = { law = "hill_passive", peak_stress = "200 kPa" }
[boundary."x-"]
displacement.x = { time = "0, 1, 2, 3, 4, 5, 6 ms", value = "0, 0.2, 1, 1.5, 1, 0.2, 0 um" }
[boundary."x+"]
displacement.x = "300 mm"
[markers]
a = "300 mm"
b = "700 mm"
)";
  const auto rod = make_rod(pulse);
  const double tangent = rod->system().parts()[0].law.linearise(1.3, 0, nullptr).stiffness;
  constexpr double dt = 1e-4;
  std::array<double, 2> weight{}, moment{};  // of the pulse's squared displacement, over time
  for (int n = 1; n * dt < 0.045; ++n) {
    const Step step = rod->advance(dt);
    ASSERT_TRUE(step.ok()) << step.failure;
    rod->accept();
    for (int k : {0, 1}) {
      const double X = k == 0 ? 0.3 : 0.7, u = quantity(*rod, k == 0 ? "marker_a_ux" : "marker_b_ux") - 0.3 * X;
      weight[k] += u * u;
      moment[k] += u * u * n * dt;
    }
  }
  const double speed = 0.4 / (moment[1] / weight[1] - moment[0] / weight[0]), exact = std::sqrt(tangent / rod_density);
  fmt::print("speed of a pulse {:.4f} m/s, exact {:.4f} m/s\n", speed, exact);
  EXPECT_NEAR(speed, exact, 2e-3 * exact);
}

}  // namespace
}  // namespace titin
