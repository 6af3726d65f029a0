// Rods against exact answers: frequencies of chains, forces of Hill elements, energies, messages.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/hill_curves.hpp"
#include "rod/rod_stability.hpp"
#include "rods.hpp"

namespace titin {
namespace {

using namespace test;

const std::string held = R"(
[boundary."x-"]
displacement.x = "0 mm"
[boundary."x+"]
displacement.x = "0 mm"
)";

/// Eigenfrequencies of N masses m between N + 1 springs with k inside: 2 sqrt(k/m) sin(j pi / (2 M)).
TEST(Chain, HasTheEigenfrequenciesOfItsSprings) {
  for (const int masses : {1, 2, 7, 64, 1024})
    for (const bool centred : {true, false}) {
      const auto rod = make_rod(linear_rod + held, {"rod.kind=chain", fmt::format("rod.masses={}", masses),
                                                    fmt::format("rod.spacing={}", centred ? "centred" : "even")});
      const std::vector<double> squares = squared_frequencies(rod->system(), rod->displacement(), 0);
      ASSERT_EQ(static_cast<int>(squares.size()), masses);
      const double parts = centred ? masses : masses + 1;
      const double k = rod_modulus * rod_area * parts / rod_length;
      const double m = rod_density * rod_area * rod_length / masses;
      double worst = 0;
      for (int j = 1; j <= masses; ++j) {
        const double exact = 4 * k / m * std::pow(std::sin(j * M_PI / (2 * parts)), 2);
        worst = std::max(worst, std::abs(squares[j - 1] - exact) / (4 * k / m));
      }
      EXPECT_LT(worst, 1e-12) << masses << (centred ? " centred" : " even");
    }
}

/// What both routines say of the same small motions.
TEST(Chain, HasGrowthRatesThatAreItsFrequencies) {
  const auto rod = make_rod(linear_rod + held, {"rod.kind=chain", "rod.masses=20"});
  const auto rates = growth_rates(rod->system(), rod->displacement(), 0);
  const auto squares = squared_frequencies(rod->system(), rod->displacement(), 0);
  ASSERT_EQ(rates.size(), 2 * squares.size());
  std::vector<double> found;
  for (const auto& s : rates) {
    EXPECT_NEAR(s.real(), 0, 1e-8 * std::abs(s));
    if (s.imag() > 0) found.push_back(s.imag() * s.imag());
  }
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), squares.size());
  for (std::size_t j = 0; j < squares.size(); ++j) EXPECT_NEAR(found[j], squares[j], 1e-10 * squares.back());
}

const std::string hill = R"(
[rod]
kind = "massless"
length = "100 mm"
area = "2 cm^2"
[materials.muscle]
density = "1060 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.passive = { law = "hill_passive", peak_stress = "200 kPa", stress = "nominal" }
terms.active = { law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.7, stress = "nominal" }
[boundary."x-"]
displacement.x = "0 mm"
)";
constexpr double peak_force = 40;  // [N]

/// F = F0 [a f_l(l) f_v(l'/eps) + f_p(l)], pulled at a constant rate.
TEST(Massless, HasTheForceOfAHillElement) {
  const auto rod = make_rod(hill + "[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 1 s\", value = \"0, 40 mm\" }\n");
  constexpr double dt = 0.05;
  for (int n = 1; n <= 20; ++n) {
    const Step step = rod->advance(dt);
    ASSERT_TRUE(step.ok()) << step.failure;
    rod->accept();
    const double l = 1 + 0.4 * dt * n;
    const double force =
        0.7 * hill::active_force(HillCurve::flexodeal, l) * hill::force_velocity(HillCurve::flexodeal, 0.4 / 5) +
        hill::passive_force(HillCurve::flexodeal, l);
    EXPECT_NEAR(quantity(*rod, "reaction_x+_x"), peak_force * force, 1e-9 * peak_force);
  }
}

/// Fibres of constant distance: F = F0 (...) cos(alpha), alpha from the muscle's length.
TEST(Massless, TurnsItsFibresAsTheyShorten) {
  const auto rod = make_rod(hill + "[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 1 s\", value = \"0, -20 mm\" }\n",
                            {"rod.pennation=20 degree"});
  constexpr double dt = 0.05, angle = 20 * M_PI / 180;
  double before = 1;
  for (int n = 1; n <= 20; ++n) {
    ASSERT_TRUE(rod->advance(dt).ok());
    rod->accept();
    const double length = (1 - 0.2 * dt * n) * std::cos(angle), l = std::hypot(length, std::sin(angle));
    const double force = 0.7 * hill::active_force(HillCurve::flexodeal, l) *
                             hill::force_velocity(HillCurve::flexodeal, (l - before) / dt / 5) +
                         hill::passive_force(HillCurve::flexodeal, l);
    EXPECT_NEAR(quantity(*rod, "reaction_x+_x"), peak_force * force * length / l, 1e-9 * peak_force);
    before = l;
  }
}

/// Under a load that it can hold, a muscle comes to rest where its force is the load; mass fixed to its end or not.
TEST(Massless, CarriesALoad) {
  for (const char* mass : {"0 kg", "500 g"}) {
    const auto rod = make_rod(hill + "[boundary.\"x+\"]\nforce = \"20 N\"\nmass = \"" + mass + "\"\n");
    for (int n = 0; n < 400; ++n) {
      const Step step = rod->advance(0.01);
      ASSERT_TRUE(step.ok()) << step.failure;
      rod->accept();
    }
    const double l = quantity(*rod, "mean_stretch_muscle");
    EXPECT_NEAR(
        peak_force * (0.7 * hill::active_force(HillCurve::flexodeal, l) + hill::passive_force(HillCurve::flexodeal, l)),
        20, 1e-3);
    EXPECT_LT(l, 1);
  }
}

/// The tendon's and the muscle's force are one.
TEST(Massless, SharesItsLengthWithATendon) {
  const auto rod = make_rod(hill + R"(
[materials.tendon]
regions = "tendon"
density = "1100 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "neo_hookean", mu = "100 MPa" }
[boundary."x+"]
displacement.x = "0 mm"
)",
                            {"rod.tendon.length=50 mm", "rod.tendon.area=0.1 cm^2", "materials.muscle.regions=muscle"});
  for (int n = 0; n < 200; ++n) {
    const Step step = rod->advance(0.01);
    ASSERT_TRUE(step.ok()) << step.failure;
    rod->accept();
  }
  const double l = quantity(*rod, "mean_stretch_muscle"), t = quantity(*rod, "mean_stretch_tendon");
  EXPECT_NEAR(0.1 * l + 0.05 * t, 0.15, 1e-12);
  const double muscle = peak_force * 0.7 * hill::active_force(HillCurve::flexodeal, l);
  EXPECT_NEAR(quantity(*rod, "reaction_x+_x"), muscle, 1e-4 * muscle);
  EXPECT_NEAR(1e8 * 1e-5 * (t - 1 / (t * t)), muscle, 1e-4 * muscle);
  EXPECT_GT(t, 1.005);
}

/// A standing wave without dissipation keeps its energy with energy_momentum, whatever the step.
TEST(Continuum, KeepsItsEnergyWithTheConservingScheme) {
  for (const char* order : {"1", "2"}) {
    const auto rod = make_rod(linear_rod + held, {"time.scheme=energy_momentum", "rod.start.velocity=4 m/s",
                                                  fmt::format("rod.order={}", order), "solver.tolerance=1e-11"});
    const auto energy = [&] { return quantity(*rod, "energy_kinetic") + quantity(*rod, "energy_base"); };
    const double start = energy();
    double least_kinetic = start;
    for (int n = 0; n < 200; ++n) {
      const Step step = rod->advance(3e-4);
      ASSERT_TRUE(step.ok()) << step.failure;
      EXPECT_LE(step.newton, 7);
      rod->accept();
      EXPECT_NEAR(energy(), start, 1e-9 * start);
      EXPECT_NEAR(quantity(*rod, "energy_balance_error"), 0, 1e-9 * start);
      least_kinetic = std::min(least_kinetic, quantity(*rod, "energy_kinetic"));
    }
    EXPECT_LT(least_kinetic, 0.3 * start);
  }
}

/// The tangent is the derivative of the residual: Newton's method is of second order at the end of a step.
TEST(Continuum, HasAnExactTangent) {
  for (const char* scheme :
       {"backward_euler", "newmark", "hht_alpha", "generalised_alpha", "bdf2", "energy_momentum", "semi_implicit"})
    for (const char* pennation : {"0 degree", "25 degree"}) {
      const auto rod =
          make_rod(hill + "[boundary.\"x+\"]\ndisplacement.x = { time = \"0, 1 s\", value = \"0, 0.3 mm\" }\n",
                   {"rod.kind=continuum", "rod.order=2", "rod.cells=4", fmt::format("time.scheme={}", scheme),
                    fmt::format("rod.pennation={}", pennation)});
      Step step = rod->advance(0.02);
      ASSERT_TRUE(step.ok()) << scheme << ": " << step.failure;
      rod->accept();
      step = rod->advance(0.02);
      ASSERT_TRUE(step.ok()) << scheme << ": " << step.failure;
      RodSystem& system = rod->system();
      const int n = system.lattice().nodes();
      mfem::Vector u(rod->displacement()), R(n), above(n), below(n);
      for (int i = 0; i < n; ++i) u(i) += 1e-3 * std::sin(3.0 * i);
      ASSERT_TRUE(system.residual(u, R));
      const BandMatrix K = system.tangent(u);
      double worst = 0, largest = 0;
      for (int j = 1; j + 1 < n; ++j) {
        constexpr double h = 1e-8;
        mfem::Vector moved(u);
        moved(j) += h;
        system.residual(moved, above);
        moved(j) -= 2 * h;
        system.residual(moved, below);
        for (int i = 1; i + 1 < n; ++i) {
          worst = std::max(worst, std::abs((above(i) - below(i)) / (2 * h) - K(i, j)));
          largest = std::max(largest, std::abs(K(i, j)));
        }
      }
      EXPECT_LT(worst, 2e-6 * largest) << scheme << ", " << pennation;
    }
}

}  // namespace
}  // namespace titin
