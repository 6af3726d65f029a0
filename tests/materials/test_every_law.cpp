/// What every law must keep beside its derivatives: the symmetry of its fibres, waves with real speeds, and a memory
/// that is all in its history.
#include "every_law.hpp"
#include "materials/compressible.hpp"
#include "materials/ellipticity.hpp"
#include "memory_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr Vec3 first_family{0.8, 0.36, 0.48};  // as in material_of

Vec3 unit(Vec3 a) {
  const double length = size_of(a);
  for (double& x : a) x /= length;
  return a;
}

/// Rotation by `angle` about a unit axis.
Mat3 turn(const Vec3& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Mat3 cross{0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0};
  Mat3 Q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q[3 * i + j] = (i == j) * c + s * cross[3 * i + j] + (1 - c) * n[i] * n[j];
  return Q;
}

bool runs_along_second(const Case& c) { return c.parameters.find("family = \"second\"") != std::string::npos; }

/// Turned before it is deformed, a body whose fibres then lie as before behaves as before: P(F Q) = P(F) Q.
TEST(EveryLaw, WithFibresKeepsTheirSymmetry) {
  const Vec3 second = unit({0.36, -0.8, 0});
  for (FibreRate rate : rates)
    for_each_case([&](const Case& c) {
      if (!c.law.needs_fibre) return;
      const MaterialPointer m = c.material();
      const Point at = general_point(rate);
      const Mat3 P = stress(*m, at);
      const auto error = [&](const Mat3& Q) {
        Point turned = at;
        turned.F = multiply(at.F, Q), turned.F_old = multiply(at.F_old, Q);
        return distance(stress(*m, turned), multiply(P, Q));
      };
      for (const Vec3& axis : {first_family, second}) EXPECT_LE(error(turn(axis, M_PI)), round_off * size_of(P));
      if (c.law.needs_second_fibre) return;
      const bool along_second = runs_along_second(c);
      EXPECT_LE(error(turn(along_second ? second : first_family, 0.7)), round_off * size_of(P));
      // A turn across the fibres must be felt, or the test sees nothing; slack fibres feel none, nor does all-round
      // stress.
      const bool all_round = c.parameters.find("across = 1") != std::string::npos;
      if (size_of(P) > 0 && !all_round)
        EXPECT_GT(error(turn(along_second ? first_family : second, 0.7)), 1e-6 * size_of(P));
    });
}

/// One pass over the points gives what stress, potential and volumetric law give apart; more points than a block holds.
TEST(EveryLaw, GivesCauchyStressAndEnergyInOnePass) {
  constexpr int n = 37;
  for_each_case([](const Case& c) {
    const MaterialPointer m = c.material();
    std::array<Mat3, n> F, P;
    for (int p = 0; p < n; ++p) F[p] = stretched_along(identity, first_family, 0.9 + 0.01 * p), F[p][1] += 0.1;
    const PointInput in{.n = n, .F = F.data()};
    std::array<Sym3, n> T;
    std::array<double, n> W, whole;
    m->cauchy_stress(in, T.data(), W.data());
    whole_stress(*m, in, P.data(), nullptr);
    whole_energy(*m, in, whole.data());
    for (int p = 0; p < n; ++p) {
      const Sym3 expected = cauchy(P[p], F[p]);
      const double size = std::sqrt(contract(expected, expected));
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(T[p][k], expected[k], round_off * size) << p;
      EXPECT_NEAR(W[p], whole[p], round_off * std::abs(whole[p])) << p;
    }
  });
}

// Of the search for the smallest value, times the bulk modulus of material_of.
constexpr double search_error = 1e-10 * 1e6;

/// Fibres that push when shortened (goh with switch none, which warns of it) lose theirs beside a fibre that is pulled.
/// Zero is real: fibres alone carry no shear. Active fibres may lose theirs, and that is muscle's own affair
/// (test_ellipticity.cpp).
TEST(EveryLaw, ThatStoresEnergyHasRealWaveSpeedsAtRestAndWhenPulled) {
  for_each_case([](const Case& c) {
    if (!c.law.stores_energy || c.parameters.find("\"none\"") != std::string::npos) return;
    const MaterialPointer m = c.material();
    for (double stretch : {1.0, 1.02}) {
      SCOPED_TRACE(stretch);
      Point at{.F = stretched_along(identity, first_family, stretch)};
      AcousticValue smallest;
      double fastest = 0;
      legendre_hadamard(*m, at.input(), &smallest);
      wave_speed(*m, at.input(), &fastest);
      EXPECT_GE(smallest.value, -search_error);
      if (!c.law.needs_fibre) EXPECT_GT(smallest.value, search_error);
      EXPECT_GT(fastest, 0);
    }
  });
}

/// Every law inside of every wrapper that takes it.
void for_each_memory(
    const std::function<void(const MaterialPointer&, const std::function<MaterialPointer()>&)>& check) {
  for_each_case([&](const Case& c) {
    for (const auto& [wrapper, takes] : std::initializer_list<std::pair<const char*, bool>>{
             {R"(prony = { strength = [0.5, 0.2], time = "0.1, 1 s" })", true},
             {R"(spectrum = { c = 0.2, shortest = "0.1 s", longest = "10 s" })", true},
             {R"(fractional = { order = 0.2, modulus = 0.5, window = "1 s" })", true},
             {R"(maxwell = { viscosity = "10 kPa s" })", c.law.stores_energy && !c.law.needs_second_fibre},
             {R"(damage = { law = "exponential", scale = "3 kJ/m^3", time = "1 s" })", c.law.stores_energy}}) {
      if (!takes) continue;
      SCOPED_TRACE(wrapper);
      const auto make = [&c, wrapper = wrapper] {
        return material_of(c.law.name, c.parameters + ", " + wrapper, c.more);
      };
      check(make(), make);
    }
  });
}

const Mat3 path[] = {
    {1.05, 0.1, 0, 0.02, 0.98, 0, 0, 0.03, 1.0}, {1.1, 0.05, 0.02, 0, 0.96, 0, 0.01, 0.02, 0.99}, general_F};

TEST(EveryMemory, IsAllInItsHistory) {
  for_each_memory([](const MaterialPointer& m, const std::function<MaterialPointer()>& make) {
    RememberingPoint point(m), fresh(make());
    point.step(path[0], 0.05), point.step(path[1], 0.02);
    fresh.restore(point.saved());
    EXPECT_EQ(fresh.step(path[2], 0.03), point.step(path[2], 0.03));
    EXPECT_EQ(fresh.saved().history, point.saved().history);
  });
}

TEST(EveryMemory, ForgetsWhatWasOnlyTried) {
  for_each_memory([](const MaterialPointer& m, const std::function<MaterialPointer()>&) {
    RememberingPoint straight(m), trying(m);
    straight.step(path[0], 0.05), trying.step(path[0], 0.05);
    trying.stress(general_F, 0.5), trying.stress(path[0], 0.001);
    EXPECT_EQ(trying.step(path[1], 0.02), straight.step(path[1], 0.02));
  });
}

}  // namespace
}  // namespace titin::testing
