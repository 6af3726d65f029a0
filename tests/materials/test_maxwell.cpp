// Finite viscoelasticity: a Maxwell branch with a neo-Hookean spring against accurate integrations of its flow
// equations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "math/spectral.hpp"
#include "math/symmetric.hpp"
#include "memory_for_tests.hpp"

namespace titin {
namespace {

using namespace testing;

const std::string branch = "mu = \"5 Pa\", maxwell = { viscosity = \"10 Pa s\" }";

Mat3 kirchhoff(const Mat3& P, const Mat3& F) { return multiply(P, transpose(F)); }

Mat3 tau_of(const nlohmann::json& entry) { return mat3(entry.contains("tau_neq") ? entry["tau_neq"] : entry); }

double distance(const Mat3& a, const Mat3& b) {
  double d = 0;
  for (int i = 0; i < 9; ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

/// A deformation in which a logarithmic spring of mu = 5 Pa has this Kirchhoff stress: F = exp(tau/(2 mu)) Q.
Mat3 of_stress(const Mat3& tau) {
  const Eigenpairs e = eigenpairs(tau);
  Mat3 V{};
  for (int a = 0; a < 3; ++a) add(V, std::exp(e.values[a] / 10), dyad(e.vectors[a], e.vectors[a]));
  return multiply(V, rotation(0.7));
}

using Path = Mat3 (*)(double t);
Mat3 uniaxial(double) { return diagonal(1.3, 1 / std::sqrt(1.3), 1 / std::sqrt(1.3)); }
Mat3 cyclic_shear(double t) { return {1, 0.4 * std::sin(2 * M_PI * t), 0, 0, 1, 0, 0, 0, 1}; }
Mat3 general(double) {
  static const Mat3 F = of_stress(tau_of(time_dependent()["rg_hencky_step"]["tau_neq"]["general_B"]["0.0"]));
  return F;
}

/// Kirchhoff stress at `end`; the deformation steps to path(0) at the start.
Mat3 run(Path path, double end, int steps) {
  RememberingPoint point(material_of("neo_hookean", branch));
  point.step(path(0), 0.0);
  Mat3 P{};
  for (int n = 1; n <= steps; ++n) P = point.step(path(end * n / steps), end / steps);
  return kirchhoff(P, path(end));
}

struct Case {
  const char* entry;
  Path path;
  const char* time;
};

class Branch : public ::testing::TestWithParam<Case> {};

TEST_P(Branch, ConvergesAtFirstOrderToTheReference) {
  const auto reference = time_dependent()[GetParam().entry]["values"][GetParam().time];
  const Mat3 exact = tau_of(reference);
  const double end = std::stod(GetParam().time);
  const double coarse = distance(run(GetParam().path, end, 200), exact),
               fine = distance(run(GetParam().path, end, 400), exact);
  EXPECT_LT(fine, 0.02);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.05);
  // Richardson's extrapolation of a first-order scheme leaves the second order
  const Mat3 a = run(GetParam().path, end, 200), b = run(GetParam().path, end, 400);
  Mat3 extrapolated;
  for (int i = 0; i < 9; ++i) extrapolated[i] = 2 * b[i] - a[i];
  EXPECT_LT(distance(extrapolated, exact), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(All, Branch,
                         ::testing::Values(Case{"rg_neohooke_step_uniax", uniaxial, "1"},
                                           Case{"rg_neohooke_step_uniax", uniaxial, "5"},
                                           Case{"rg_neohooke_step_generalB", general, "1"},
                                           Case{"rg_neohooke_step_generalB", general, "2"},
                                           Case{"rg_neohooke_cyclic_shear", cyclic_shear, "0.25"},
                                           Case{"rg_neohooke_cyclic_shear", cyclic_shear, "0.5"},
                                           Case{"rg_neohooke_cyclic_shear", cyclic_shear, "2.0"}),
                         [](const auto& info) { return "case_" + std::to_string(info.index); });

/// A logarithmic spring relaxes by exactly 1/(1 + dt mu/eta_D) in every step, whatever the deformation.
TEST(HenckyBranch, RelaxesByTheSameFactorInEveryStep) {
  const auto reference = time_dependent()["rg_hencky_step"];
  const std::vector<std::pair<const char*, Mat3>> deformations{
      {"uniax_1.3_incomp", uniaxial(0)},
      {"shear_0.4", {1, 0.4, 0, 0, 1, 0, 0, 0, 1}},
      {"general_B", of_stress(tau_of(reference["tau_neq"]["general_B"]["0.0"]))}};
  for (const auto& [name, F] : deformations)
    for (int steps : {20, 200}) {
      SCOPED_TRACE(fmt::format("{}, {} steps", name, steps));
      const double dt = 2.0 / steps, factor = 1 / (1 + dt * 5 / 10);
      RememberingPoint point(material_of("hencky", branch));
      Mat3 expected = tau_of(reference["tau_neq"][name]["0.0"]);
      EXPECT_LT(distance(kirchhoff(point.step(F, 0.0), F), expected), 1e-12);
      Mat3 tau{};
      for (int n = 0; n < steps; ++n) tau = kirchhoff(point.step(F, dt), F);
      for (double& x : expected) x *= std::pow(factor, steps);
      EXPECT_LT(distance(tau, expected), 1e-12);
    }
}

TEST(HenckyBranch, ConvergesAtFirstOrderToItsExponential) {
  const auto reference = time_dependent()["rg_hencky_step"];
  const Mat3 exact = tau_of(reference["tau_neq"]["uniax_1.3_incomp"]["2.0"]);
  const auto error = [&](int steps) {
    RememberingPoint point(material_of("hencky", branch));
    point.step(uniaxial(0), 0.0);
    Mat3 P{};
    for (int n = 0; n < steps; ++n) P = point.step(uniaxial(0), 2.0 / steps);
    return distance(kirchhoff(P, uniaxial(0)), exact);
  };
  EXPECT_NEAR(std::log2(error(100) / error(200)), 1.0, 0.02);
}

TEST(Branch, StepIsTakenAtOnce) {
  const auto reference = time_dependent()["rg_neohooke_step_uniax"]["values"]["0"];
  RememberingPoint point(material_of("neo_hookean", branch));
  EXPECT_LT(distance(kirchhoff(point.step(uniaxial(0), 0.0), uniaxial(0)), tau_of(reference)), 1e-12);
}

TEST(Branch, TangentIsExact) {
  for (double dt : {1e-6, 0.5, 1e6}) {
    RememberingPoint point(
        material_of("ogden", "mu = \"2, -1 Pa\", alpha = [2, -3], maxwell = { viscosity = \"10 Pa s\" }"));
    point.step({1.1, 0.2, 0, 0.05, 0.95, 0, 0, 0.1, 1.0}, 0.5);
    EXPECT_NEAR(tangent_order(point, {1.2, 0.3, 0.05, 0.0, 0.9, 0.1, 0.05, 0.1, 1.05}, dt), 2.0, 0.1) << dt;
  }
  RememberingPoint at_rest(material_of("neo_hookean", branch));  // three equal stretches
  EXPECT_NEAR(tangent_order(at_rest, identity, 0.5), 2.0, 0.1);
}

TEST(Branch, DissipatesWhatItDoesNotStore) {
  RememberingPoint point(material_of("neo_hookean", branch));
  Mat3 F_old = identity, P_old{};
  double work = 0, last = 0;
  const int steps = 4000;
  for (int n = 1; n <= steps; ++n) {
    const Mat3 F = cyclic_shear(1.25 * n / steps), P = point.stress(F, 1.25 / steps);
    for (int i = 0; i < 9; ++i) work += 0.5 * (P[i] + P_old[i]) * (F[i] - F_old[i]);
    EXPECT_GE(point.dissipated(), last);
    last = point.dissipated();
    if (n == steps) EXPECT_NEAR(work, point.stored() + last, 2e-3 * work);  // first order in the step
    point.take();
    F_old = F;
    P_old = P;
  }
}

TEST(Branch, HoldsFromTinyToHugeSteps) {
  for (double dt : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    RememberingPoint point(material_of("neo_hookean", branch));
    const Mat3 tau = kirchhoff(point.step(uniaxial(0), dt), uniaxial(0));
    EXPECT_GT(tau[0], 0) << dt;
    EXPECT_LE(tau[0], 3.0693) << dt;
    if (dt > 1e5) EXPECT_LT(tau[0], 1e-4);
    EXPECT_NEAR(trace(tau), 0, 1e-10);
  }
}

const std::string fibre_branch = "k1 = \"3 Pa\", k2 = 2, maxwell = { viscosity = \"20 Pa s\" }";

/// Stretch by l along the fibre (0.8, 0.36, 0.48) at constant volume.
Mat3 along_fibre(double l) {
  const Vec3 a{0.8, 0.36, 0.48};
  const double m = 1 / std::sqrt(l);
  Mat3 F;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[3 * i + j] = (i == j) * m + (l - m) * a[i] * a[j];
  return F;
}

/// Tension tau = 3/2 a . tau a of a deviatoric stress.
double tension(const Mat3& tau) {
  const Vec3 a{0.8, 0.36, 0.48};
  return 1.5 * dot(a, multiply(tau, a));
}

TEST(FibreBranch, RelaxesAHeldStretchAsIntegrated) {
  const auto reference = time_dependent()["fibre_maxwell_step"]["tau"];
  const Mat3 F = along_fibre(1.2);
  const auto run = [&](double end, int steps) {
    RememberingPoint point(material_of("goh", fibre_branch));
    Mat3 P = point.step(F, 0.0);
    for (int n = 0; n < steps && end > 0; ++n) P = point.step(F, end / steps);
    return tension(kirchhoff(P, F));
  };
  EXPECT_NEAR(run(0, 0), reference["0"].get<double>(), 1e-12);
  for (const char* time : {"1", "2", "5"}) {
    const double exact = reference[time], end = std::stod(time);
    const double coarse = run(end, 400) - exact, fine = run(end, 800) - exact;
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.05) << time;
    EXPECT_NEAR(2 * run(end, 800) - run(end, 400), exact, 1e-4) << time;
  }
}

/// Points without directions of their own have the material's.
TEST(FibreBranch, RunsAlongTheMaterialsFibres) {
  const MaterialPointer m = material_of("goh", fibre_branch);
  Point own{.F = along_fibre(1.2), .dt = 0.5};
  PointInput none = own.input();
  none.fibre = nullptr;
  Mat3 P;
  m->stress(none, &P, nullptr);
  EXPECT_LT(distance(P, titin::testing::stress(*m, own)), 1e-12);
}

/// The same branch along the second family relaxes as along the first, when the two directions are exchanged.
TEST(FibreBranch, RunsAlongEitherFamily) {
  const std::string second = std::string(fibre_branch) + ", family = \"second\"";
  const auto run = [](const MaterialPointer& m) {
    RememberingPoint point(m);
    point.step(general_F_old, 0.5);
    return point.step(general_F, 0.5);
  };
  const char* exchanged =
      "density = \"1000 kg/m^3\"\nfibre = [0.36, -0.8, 0]\nsecond_fibre = [0.8, 0.36, 0.48]\n"
      "volumetric = { law = \"simo\", bulk_modulus = \"1 MPa\" }\n[materials.m.terms]\nt = { law = \"goh\", ";
  const Mat3 P = run(material_of("goh", fibre_branch));
  EXPECT_GT(size_of(P), 0);
  EXPECT_LE(distance(run(material(exchanged + second + " }\n")), P), 1e-14 * size_of(P));
}

TEST(FibreBranch, TangentIsExactAndStepsMayBeHuge) {
  for (const char* measure : {"", "fibre_invariants = \"full\"\n"})
    for (double dt : {1e-6, 0.5, 1e6}) {
      RememberingPoint point(material_of("goh", fibre_branch, measure));
      point.step({1.2, 0.2, 0, 0.05, 1.0, 0, 0, 0.1, 1.1}, 0.5);
      const Mat3 F{1.4, 0.3, 0.05, 0.0, 1.0, 0.1, 0.05, 0.1, 1.15};
      if (dt < 1) EXPECT_NEAR(tangent_order(point, F, dt), 2.0, 0.15) << measure << dt;
      EXPECT_TRUE(std::isfinite(point.step(F, dt)[0]));
      EXPECT_GE(point.dissipated(), 0);
    }
}

}  // namespace
}  // namespace titin
