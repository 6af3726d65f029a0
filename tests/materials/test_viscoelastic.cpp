// Quasi-linear and fractional viscoelasticity against closed forms; orders; energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/viscoelastic.hpp"
#include "math/symmetric.hpp"
#include "memory_for_tests.hpp"

namespace titin {
namespace {

using namespace testing;

constexpr double round_off = 1e-12;        // of updates that are exact for what they are given
constexpr double printed = 1e-10;          // the references were computed to 13 digits or so
constexpr double series_tolerance = 2e-4;  // of the kernel t^-alpha by a sum of exponentials over its window

/// Stretch along 1 whose Green strain is E.
Mat3 strained(double E) { return diagonal(std::sqrt(1 + 2 * E), 1, 1); }

/// S_11 of a St Venant-Kirchhoff solid (M = lambda + 2 mu = 100 Pa) is M E: linear, so ramps are exact.
constexpr double M = 100, peak = 0.05;
const std::string linear = "lambda = \"40 Pa\", mu = \"30 Pa\"";

double ramp(double t) { return peak * std::min(t / 0.5, 1.0); }

/// S_11 / (M peak) at the times of a ramp in 0.5 s and a hold.
double ramp_hold(const std::string& wrapper, double end, double dt) {
  RememberingPoint point(material_of("st_venant_kirchhoff", linear + ", " + wrapper));
  double S = 0;
  const int steps = static_cast<int>(std::lround(end / dt));
  for (int n = 1; n <= steps; ++n) {
    const Mat3 F = strained(ramp(n * dt));
    S = point.step(F, dt)[0] / F[0];
  }
  return S / (M * peak);
}

const std::string prony = "prony = { strength = [0.3, 0.2], time = \"0.1, 1 s\" }";

TEST(Prony, LinearRampAndHoldAreExactForAnyStep) {
  const auto reference = time_dependent()["prony_linear_ramp_hold"]["S_over_Seinf"];
  for (const auto& [time, value] : reference.items())
    for (double dt : {0.1, 0.05, 0.01}) {
      const double end = std::stod(time);
      if (std::abs(end / dt - std::round(end / dt)) > 1e-9) continue;
      EXPECT_NEAR(ramp_hold(prony, end, dt), value.get<double>(), round_off * 10) << "t " << time << " dt " << dt;
    }
}

TEST(Prony, NeoHookeanRampConvergesAtSecondOrderToItsExactStress) {
  const auto reference = time_dependent()["qlv_neohookean_uniaxial"];
  const auto run = [&](int steps) {
    RememberingPoint point(material_of("compressible_neo_hookean", "lambda = \"0 Pa\", mu = \"0.5 Pa\", " + prony));
    double S = 0;
    for (int n = 1; n <= steps; ++n) {
      const double l = 1 + 0.3 * n / steps;
      S = point.step(diagonal(l, 1, 1), 0.5 / steps)[0] / l;
    }
    return S;
  };
  EXPECT_NEAR(run(10), reference["eq13_n10_S11_at_0.5"].get<double>(), printed);
  EXPECT_NEAR(run(20), reference["eq13_n20_S11_at_0.5"].get<double>(), printed);
  const double exact = reference["exact"]["0.5"]["S11"];
  EXPECT_NEAR(std::log2((run(20) - exact) / (run(40) - exact)), 2.0, 0.05);
}

TEST(Prony, InstantaneousReferenceIsTheSameLawInOtherNumbers) {
  // g = gamma / (1 + sum gamma) over the instantaneous stress, which is 1.5 times the long-term one
  const std::string other =
      "prony = { reference = \"instantaneous\", strength = [0.2, 0.13333333333333333], time = \"0.1, 1 s\" }";
  EXPECT_NEAR(1.5 * ramp_hold(other, 1.0, 0.05), ramp_hold(prony, 1.0, 0.05), round_off * 10);
}

TEST(Prony, IsStableAndRightFromTinyToHugeSteps) {
  for (double tau : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    RememberingPoint point(material_of("st_venant_kirchhoff",
                                       linear + fmt::format(", prony = {{ strength = [0.5], time = \"{} s\" }}", tau)));
    const double S = point.step(strained(peak), 1.0)[0] / strained(peak)[0], x = 1 / tau;
    EXPECT_NEAR(S / (M * peak), 1 + 0.5 * -std::expm1(-x) / x, round_off) << tau;
  }
}

TEST(Spectrum, RelaxesByFungsFunction) {
  const auto reference = time_dependent()["fung_spectrum_G"];
  const auto series = RelaxationSeries::fung(0.1, 0.01, 100).instantaneous();
  EXPECT_NEAR(series.relaxation(0), 1, round_off);
  EXPECT_NEAR(series.elastic, reference["G_inf"].get<double>(), printed);
  constexpr double quadrature = 1e-6;  // Gauss points at 0.4 in ln tau
  for (const auto& [time, value] : reference["G"].items())
    EXPECT_NEAR(series.relaxation(std::stod(time)), value.get<double>(), quadrature) << time;
}

TEST(Fractional, RampAndHoldFollowCaputo) {
  const auto reference = time_dependent()["caputo_ramp_hold"]["values"];
  for (const auto& [alpha, values] : reference.items())
    for (const auto& [time, value] : values.items()) {
      const double end = std::stod(time), dt = end > 10 ? 0.5 : 0.05;
      if (end < 0.25) continue;
      const std::string law = fmt::format("fractional = {{ order = {}, modulus = 1, window = \"50 s\" }}", alpha);
      const double elastic = end < 0.5 ? end / 0.5 : 1.0;
      EXPECT_NEAR(ramp_hold(law, end, dt) - elastic, value.get<double>(), series_tolerance * 5)
          << alpha << " at " << time;
    }
}

TEST(Fractional, CreepFollowsMittagLeffler) {
  const auto reference = time_dependent()["fractional_creep"];
  for (const auto& [alpha, values] : reference["Se"].items()) {
    RememberingPoint point(
        material_of("st_venant_kirchhoff",
                    linear + fmt::format(", fractional = {{ order = {}, modulus = 0.5, window = \"10 s\" }}", alpha)));
    double t = 0, E = 0;
    constexpr double load = 1e-3 * M;  // S_11 held from t = 0
    for (const auto& [time, value] : values.items()) {
      const double end = std::stod(time), growth = 1.01;
      while (t < end * (1 - 1e-12)) {
        const double dt = std::min(std::max(1e-7, (growth - 1) * t), end - t);
        // the step is linear in E: two evaluations give it
        const auto S = [&](double strain) { return point.stress(strained(strain), dt)[0] / strained(strain)[0]; };
        const double S0 = S(E), slope = (S(E + 1e-3) - S0) / 1e-3;
        E += (load - S0) / slope;
        point.step(strained(E), dt);
        t += dt;
      }
      EXPECT_NEAR(E * M / load, value.get<double>(), series_tolerance) << alpha << " at " << time;
    }
  }
}

TEST(Viscoelastic, TangentIsExactWithinAStep) {
  for (const std::string& wrapper :
       {prony, std::string("fractional = { order = 0.3, modulus = 0.2, window = \"1 s\" }"),
        std::string("spectrum = { c = 0.2, shortest = \"10 ms\", longest = \"10 s\" }")}) {
    RememberingPoint point(material_of("neo_hookean", "mu = \"10 Pa\", " + wrapper));
    point.step({1.1, 0.1, 0, 0.02, 0.95, 0, 0, 0.1, 1.0}, 0.05);
    EXPECT_NEAR(tangent_order(point, {1.15, 0.2, 0.05, 0.0, 0.9, 0.1, 0.05, 0.1, 1.05}, 0.05), 2.0, 0.1) << wrapper;
  }
}

/// One step from rest with times about 1 s: stress over the elastic one, from dt/tau = 1e-6 to 1e6.
TEST(EveryMemory, HoldsFromTinyToHugeSteps) {
  struct Wrapped {
    const char* wrapper;
    double least, most;  // of the ratio
  };
  const Wrapped wrapped[] = {{R"(prony = { strength = [0.5], time = "1 s" })", 1, 1.5},
                             {R"(prony = { reference = "instantaneous", strength = [0.5], time = "1 s" })", 0.5, 1},
                             {R"(spectrum = { c = 0.2, shortest = "0.1 s", longest = "10 s" })", 0.5, 1},
                             {R"(fractional = { order = 0.2, modulus = 0.5, window = "1 s" })", 1, 100},
                             {R"(maxwell = { viscosity = "10 Pa s" })", 0, 1},
                             {R"(damage = { law = "exponential", scale = "3 J/m^3", time = "1 s" })", 0.01, 1}};
  const Mat3 F{1.15, 0.2, 0.05, 0.0, 0.9, 0.1, 0.05, 0.1, 1.05};
  const MaterialPointer elastic = material_of("neo_hookean", "mu = \"10 Pa\"");
  const double P_elastic = size_of(titin::testing::stress(*elastic, {.F = F}));
  for (const auto& [wrapper, least, most] : wrapped) {
    double last = 0;
    for (double dt = 1e6; dt > 0.5e-6; dt /= 10) {
      SCOPED_TRACE(fmt::format("{} dt {}", wrapper, dt));
      RememberingPoint point(material_of("neo_hookean", std::string("mu = \"10 Pa\", ") + wrapper));
      const double ratio = size_of(point.stress(F, dt)) / P_elastic;
      EXPECT_GE(ratio, least - round_off);
      EXPECT_LE(ratio, most + round_off);
      EXPECT_GE(ratio, last * (1 - round_off));  // the shorter the step, the stiffer
      EXPECT_GE(point.dissipated(), 0);
      last = ratio;
    }
  }
}

TEST(Viscoelastic, WorkIsStoredOrDissipatedAndDissipationOnlyGrows) {
  RememberingPoint point(material_of("neo_hookean", "mu = \"10 Pa\", " + prony));
  const int steps = 2000;
  const double dt = 2.0 / steps;
  Mat3 F_old = identity, P_old{};
  double work = 0, last = 0;
  for (int n = 1; n <= steps; ++n) {
    const double g = 0.3 * std::sin(2 * M_PI * n * dt);
    const Mat3 F{1 + 0.2 * g, g, 0, 0, 1, 0, 0, 0, 1};
    const Mat3 P = point.stress(F, dt);
    for (int i = 0; i < 9; ++i) work += 0.5 * (P[i] + P_old[i]) * (F[i] - F_old[i]);
    EXPECT_GE(point.dissipated(), last - round_off);
    last = point.dissipated();
    if (n == steps) {
      constexpr double trapezoid = 1e-5;  // of P : dF at this step
      EXPECT_NEAR(work, point.stored() + point.dissipated(), trapezoid * work);
      EXPECT_GT(point.dissipated(), 0.05 * work);
    }
    point.take();
    P_old = P;
    F_old = F;
  }
}

}  // namespace
}  // namespace titin
