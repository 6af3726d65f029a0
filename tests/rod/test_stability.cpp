// The descending limb: growth rates of small motions from eigenvalues, by hand and from time integration; the base that
// makes it stable.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/hill_curves.hpp"
#include "rod/rod_stability.hpp"
#include "rods.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double held_stretch = 1.25, peak = 2e5;

/// Fully active fibres, held at a stretch, on a base of shear modulus `mu` [Pa].
std::string limb(double mu, const std::string& max_strain_rate) {
  return fmt::format(R"(
[rod]
kind = "chain"
masses = 8
length = "100 mm"
area = "1 cm^2"
start.stretch = {0}
[time]
scheme = "newmark"
[solver]
tolerance = 1e-13
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = {{ law = "simo", bulk_modulus = "10 MPa" }}
{1}
terms.active = {{ law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "{2}", activation = 1, stress = "nominal" }}
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = "{3} mm"
)",
                     held_stretch,
                     mu > 0 ? fmt::format("terms.base = {{ law = \"neo_hookean\", mu = \"{} Pa\" }}", mu) : "",
                     max_strain_rate, 100 * (held_stretch - 1));
}

/// Slope of the active curve at the held stretch, and of a base of 1 Pa.
double active_slope() {
  return peak * hill::active_force(HillCurve::flexodeal, Dual<1, 1>::variable(held_stretch, 0)).gradient[0];
}
double base_slope() { return 1 + 2 / std::pow(held_stretch, 3); }

double growth(Rod& rod) { return growth_rates(rod.system(), rod.displacement(), 0).front().real(); }

/// Growth of the displacement of one mass out of its place, from t = from to t = to.
double seen_growth(Rod& rod, double dt, double from, double to) {
  const double place = (held_stretch - 1) * rod.system().lattice().X()[1];
  double first = 0, last = 0;
  for (int n = 1; n * dt < to + 0.5 * dt; ++n) {
    const Step step = rod.advance(dt);
    EXPECT_TRUE(step.ok()) << step.failure;
    if (!step.ok()) return NAN;
    rod.accept();
    last = std::abs(rod.displacement()(1) - place);
    if (std::abs(n * dt - from) < 0.5 * dt) first = last;
  }
  return std::log(last / first) / (to - from);
}

/// m s^2 + c s + k = 0 for the wave of `mode` half waves: with k < 0, the fastest one is the shortest.
struct ByHand {
  double faster, slower;  // [1/s]
  ByHand(double stiffness, double viscosity, int mode) {
    constexpr int masses = 8;
    const double m = rod_density * rod_area * rod_length / masses;
    const double shape = 4 * std::pow(std::sin(mode * M_PI / (2 * masses)), 2) * rod_area * masses / rod_length;
    const double k = stiffness * shape, c = viscosity * shape, root = std::sqrt(c * c - 4 * m * k);
    slower = -(c + root) / (2 * m);
    faster = k / (m * slower);
  }
  /// Of a wave that is released from rest, between two times.
  double growth(double from, double to) const {
    const auto u = [this](double t) { return faster * std::exp(slower * t) - slower * std::exp(faster * t); };
    return std::log(u(to) / u(from)) / (to - from);
  }
};

double viscosity(double max_strain_rate) {
  return peak * hill::active_force(HillCurve::flexodeal, held_stretch) *
         hill::force_velocity(HillCurve::flexodeal, Dual<1, 1>::variable(0.0, 0)).gradient[0] / max_strain_rate;
}

TEST(DescendingLimb, GrowsAsItsEigenvaluesSay) {
  struct Case {
    const char* rate;
    double max_strain_rate, dt, from, to, displacement;
  };
  // Fibres that resist their rate grow slowly; those that do not, at the pace of waves.
  for (const Case& c : {Case{"5 1/s", 5, 5e-3, 0.2, 1.0, 1e-8}, Case{"1e7 1/s", 1e7, 5e-6, 1e-3, 2e-3, 1e-9}})
    for (int mode : {1, 8}) {
      const auto rod = make_rod(limb(0, c.rate), {fmt::format("rod.start.displacement={} m", c.displacement),
                                                  fmt::format("rod.start.mode={}", mode)});
      const double fastest = growth(*rod), seen = seen_growth(*rod, c.dt, c.from, c.to);
      const ByHand exact(active_slope(), viscosity(c.max_strain_rate), mode);
      fmt::print("max rate {}, mode {}: seen {:.4f} 1/s, by hand {:.4f}; fastest growth rate {:.4f}\n", c.rate, mode,
                 seen, exact.growth(c.from, c.to), fastest);
      EXPECT_NEAR(fastest, ByHand(active_slope(), viscosity(c.max_strain_rate), 8).faster, 1e-4 * fastest);
      EXPECT_NEAR(seen, exact.growth(c.from, c.to), 0.01 * seen);
      if (mode == 8) {
        EXPECT_NEAR(seen, fastest, 0.02 * fastest);
      }
    }
}

TEST(DescendingLimb, IsNeutralOnItsCriticalBase) {
  const double critical = -active_slope() / base_slope();
  const auto rate_at = [&](double part) {
    const auto rod = make_rod(limb(part * critical, "5 1/s"));
    return growth(*rod);
  };
  const double free = ByHand(active_slope(), viscosity(5), 8).faster;
  fmt::print("critical base {:.1f} Pa; growth at 0.99, 1 and 1.01 of it: {:.2e} {:.2e} {:.2e} 1/s, without it {:.3f}\n",
             critical, rate_at(0.99), rate_at(1), rate_at(1.01), free);
  EXPECT_NEAR(rate_at(1), 0, 1e-8 * free);
  EXPECT_NEAR(rate_at(0.99), 0.01 * free, 2e-3 * free);
  EXPECT_NEAR(rate_at(1.01), -0.01 * free, 2e-3 * free);
}

/// The border between growth and decay, from steps in time alone, halving the interval.
TEST(DescendingLimb, HasTheSameBorderInTime) {
  const double critical = -active_slope() / base_slope();
  double unstable = 0.5, stable = 1.5;
  for (int k = 0; k < 6; ++k) {
    const double part = 0.5 * (unstable + stable);
    const auto rod = make_rod(limb(part * critical, "5 1/s"), {"rod.start.displacement=1e-8 m", "rod.start.mode=8"});
    (seen_growth(*rod, 0.02, 0.2, 1.0) > 0 ? unstable : stable) = part;
  }
  fmt::print("border in time between {:.4f} and {:.4f} of the critical base\n", unstable, stable);
  EXPECT_LT(unstable, 1.001);
  EXPECT_GT(stable, 0.999);
}

/// What the continuum says: any number of elements, the same bound on growth, k / c.
TEST(DescendingLimb, GrowsNoFasterThanItsFibresLet) {
  const double bound = -active_slope() / viscosity(5);
  for (int masses : {4, 32, 128}) {
    const auto rod = make_rod(limb(0, "5 1/s"), {fmt::format("rod.masses={}", masses)});
    EXPECT_LE(growth(*rod), bound * (1 + 1e-9));
    EXPECT_GT(growth(*rod), 0.999 * bound);
  }
}

}  // namespace
}  // namespace titin
