// Time integration on a pendulum, u'' + sin u = 0: orders, energy, and motions that are given.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solve/integrator.hpp"

namespace titin {
namespace {

constexpr double quarter_turn = 1.5, end = 4;  // start at rest; less than a period, 7.3
constexpr double newton_accuracy = 1e-14;

/// Energy per mass.
double energy(double u, double v) { return 0.5 * v * v + 1 - std::cos(u); }

struct Pendulum {
  explicit Pendulum(const IntegratorConfig& config) : integrator(config, 1) {
    mfem::Vector u(1), v(1), a(1);
    u(0) = quarter_turn, v(0) = 0, a(0) = -std::sin(quarter_turn);
    integrator.start(u, v, a);
  }
  double u() const { return integrator.u()(0); }
  double v() const { return integrator.v()(0); }

  /// Force of the balance and its derivative: at the end of the step, or the discrete gradient.
  std::pair<double, double> force(double x) const {
    if (integrator.config().scheme != Scheme::energy_momentum) return {std::sin(x), std::cos(x)};
    const double d = 0.5 * (x - u()), mean = 0.5 * (x + u());  // (cos u_n - cos u) / (u - u_n)
    if (std::abs(d) < 1e-4) return {std::sin(mean), 0.5 * std::cos(mean)};
    const double sinc = std::sin(d) / d, slope = (std::cos(d) - sinc) / d;
    return {std::sin(mean) * sinc, 0.5 * (std::cos(mean) * sinc + std::sin(mean) * slope)};
  }
  void step(double dt) {
    const mfem::Array<int> none;
    mfem::Vector nothing, x(integrator.u());
    integrator.begin(dt, {none, nothing, nothing});
    const StepRule& rule = integrator.rule();
    const double w = rule.force_weight, f_old = std::sin(u());
    for (int i = 0; i < 20; ++i) {
      const auto [f, df] = force(x(0));
      const double a = integrator.inertia_factor() * (x(0) - u()) + integrator.known_inertia()(0);
      const double change = (a + w * f + (1 - w) * f_old) / (integrator.inertia_factor() + w * df);
      x(0) -= change;
      if (std::abs(change) < newton_accuracy) break;
    }
    integrator.accept(x);
  }
  Integrator integrator;
};

/// By Runge and Kutta's method in steps that leave round-off only.
double exact() {
  constexpr int steps = 20000;
  constexpr double h = end / steps;
  double u = quarter_turn, v = 0;
  for (int i = 0; i < steps; ++i) {
    const double k1 = v, l1 = -std::sin(u), k2 = v + h / 2 * l1, l2 = -std::sin(u + h / 2 * k1);
    const double k3 = v + h / 2 * l2, l3 = -std::sin(u + h / 2 * k2), k4 = v + h * l3, l4 = -std::sin(u + h * k3);
    u += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return u;
}

struct Case {
  const char* name;
  IntegratorConfig config;
  double order, uneven_order;
};

const std::vector<Case> cases = {
    {"backward_euler", {.scheme = Scheme::backward_euler}, 1, 1},
    {"semi_implicit", {.scheme = Scheme::semi_implicit}, 1, 1},
    {"newmark", {.scheme = Scheme::newmark}, 2, 2},
    {"hht_alpha", {.scheme = Scheme::hht_alpha, .alpha = 0.2}, 2, 2},
    {"generalised_alpha", {.scheme = Scheme::generalised_alpha, .spectral_radius = 0.6}, 2, 2},
    {"generalised_alpha_0", {.scheme = Scheme::generalised_alpha, .spectral_radius = 0}, 2, 1},
    {"bdf2", {.scheme = Scheme::bdf2}, 2, 2},
    {"energy_momentum", {.scheme = Scheme::energy_momentum}, 2, 2},
};

class Schemes : public testing::TestWithParam<Case> {};

/// `uneven`: how much longer every other step is than the mean.
double error(const IntegratorConfig& config, int steps, double uneven) {
  Pendulum pendulum(config);
  for (int i = 0; i < steps; ++i) pendulum.step(end / steps * (i % 2 == 0 ? 1 + uneven : 1 - uneven));
  return std::abs(pendulum.u() - exact());
}

TEST_P(Schemes, HaveTheirOrder) {
  for (double uneven : {0.0, 0.3}) {
    const double e1 = error(GetParam().config, 160, uneven), e2 = error(GetParam().config, 320, uneven),
                 e4 = error(GetParam().config, 640, uneven);
    fmt::print("{}, steps uneven by {}: errors {:.2e} {:.2e} {:.2e}, slopes {:.3f} {:.3f}\n", GetParam().name, uneven,
               e1, e2, e4, std::log2(e1 / e2), std::log2(e2 / e4));
    EXPECT_NEAR(std::log2(e2 / e4), uneven > 0 ? GetParam().uneven_order : GetParam().order, 0.1);
  }
}

TEST_P(Schemes, StartOverWithTheSameNumbersAfterAStepThatWasNotAccepted) {
  Pendulum once(GetParam().config), twice(GetParam().config);
  const mfem::Array<int> none;
  const mfem::Vector nothing;
  for (int i = 0; i < 5; ++i) {
    twice.integrator.begin(0.7, {none, nothing, nothing});
    once.step(0.1), twice.step(0.1);
    EXPECT_EQ(once.u(), twice.u());
    EXPECT_EQ(once.v(), twice.v());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Schemes, testing::ValuesIn(cases), [](const auto& info) { return info.param.name; });

/// Energy at the end of 1000 steps over that at the start.
double energy_left(const IntegratorConfig& config) {
  Pendulum pendulum(config);
  for (int i = 0; i < 1000; ++i) pendulum.step(0.3);
  return energy(pendulum.u(), pendulum.v()) / energy(quarter_turn, 0);
}

TEST(Energy, StaysToRoundOffInTheConservingScheme) {
  EXPECT_NEAR(energy_left({.scheme = Scheme::energy_momentum}), 1, 1e-12);
}

TEST(Energy, LeavesTheDissipatingSchemesMoreOrLess) {
  const double be = energy_left({.scheme = Scheme::backward_euler}), bdf2 = energy_left({.scheme = Scheme::bdf2});
  const double hht = energy_left({.scheme = Scheme::hht_alpha, .alpha = 0.1});
  fmt::print("energy left after 1000 steps: backward Euler {:.1e}, BDF2 {:.1e}, HHT {:.2f}\n", be, bdf2, hht);
  EXPECT_LT(be, 1e-10);
  EXPECT_GT(bdf2, be);
  EXPECT_GT(hht, bdf2);
  EXPECT_LT(hht, 1);
}

TEST(Energy, OfTheTrapezoidalRuleOscillatesAndIsNotKept) {
  Pendulum pendulum({.scheme = Scheme::newmark});
  double lowest = 1, highest = 1;
  for (int i = 0; i < 1000; ++i) {
    pendulum.step(0.3);
    const double part = energy(pendulum.u(), pendulum.v()) / energy(quarter_turn, 0);
    lowest = std::min(lowest, part), highest = std::max(highest, part);
  }
  fmt::print("energy of the trapezoidal rule: {:.6f} to {:.6f}\n", lowest, highest);
  EXPECT_GT(highest - lowest, 1e-3);
  EXPECT_LT(highest - lowest, 0.1);
}

mfem::Array<int> first() {
  mfem::Array<int> dofs;
  dofs.Append(0);
  return dofs;
}

/// Velocity of a dof that starts to move at unit speed, after each step.
std::vector<double> velocities_of_a_ramp(const IntegratorConfig& config) {
  Integrator integrator(config, 1);
  const mfem::Array<int> dofs = first();
  mfem::Vector u(1), v(1);
  std::vector<double> seen;
  for (int i = 1; i <= 6; ++i) {
    u(0) = 0.1 * i, v(0) = 1;
    integrator.begin(0.1, {dofs, u, v});
    integrator.accept(u);
    seen.push_back(integrator.v()(0));
  }
  return seen;
}

TEST(PrescribedMotion, RingsOnlyWhereTheSchemeMakesItsVelocityOfDisplacements) {
  for (const double v : velocities_of_a_ramp({.scheme = Scheme::newmark, .velocity = VelocityForm::lines}))
    EXPECT_NEAR(v, 1, 1e-12);
  for (const double v : velocities_of_a_ramp({.scheme = Scheme::backward_euler})) EXPECT_NEAR(v, 1, 1e-12);
  const auto ringing = velocities_of_a_ramp({.scheme = Scheme::newmark});
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(ringing[i], i % 2 == 0 ? 2 : 0, 1e-12);
}

TEST(PrescribedMotion, PassesOnTheWholeImpulseOfAKink) {
  for (const Case& c : cases) {
    IntegratorConfig config = c.config;
    config.velocity = VelocityForm::lines;
    Integrator integrator(config, 1);
    const mfem::Array<int> dofs = first();
    mfem::Vector u(1), v(1);
    double impulse = 0;
    for (int i = 1; i <= 6; ++i) {
      u(0) = 0.1 * i, v(0) = 1;
      integrator.begin(0.1, {dofs, u, v});
      impulse += 0.1 * (integrator.inertia_factor() * (u(0) - integrator.u()(0)) + integrator.known_inertia()(0));
      integrator.accept(u);
    }
    EXPECT_NEAR(impulse, 1, 1e-12) << c.name;
  }
}

}  // namespace
}  // namespace titin
