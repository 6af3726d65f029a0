/// Laws where they are hard to evaluate: equal and nearly equal stretches, tiny volumes, steep exponentials, fibres at
/// the edge of tension. Right, or clearly refused (not a number), never quietly wrong.
#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;

MaterialPointer ogden(double alpha) {
  const double mu = alpha > 0 ? 2 : -2;
  return material_of("ogden", "mu = \"" + std::to_string(mu) + " kPa\", alpha = [" + std::to_string(alpha) + "]");
}

/// Q diag(a, a (1 + split), b) Q^T.
Mat3 nearly_equibiaxial(double a, double split, double b) {
  const Mat3 Q = rotation(0.6);
  return multiply(multiply(Q, {a, 0, 0, 0, a * (1 + split), 0, 0, 0, b}), transpose(Q));
}

/// The tangent is a smooth function of F: across equal stretches it changes by no more than the distance allows.
TEST(Ogden, TangentIsContinuousThroughEqualStretches) {
  for (double alpha : {-20.0, -2.0, 1.3, 20.0})
    for (double a : {1.0, 1.3, 0.8}) {
      const MaterialPointer m = ogden(alpha);
      const Mat9 A = tangent(*m, {.F = nearly_equibiaxial(a, 0, 1.1)});
      for (double split : {1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15}) {
        const Mat9 B = tangent(*m, {.F = nearly_equibiaxial(a, split, 1.1)});
        // d ln A / d ln lambda is of the order of |alpha| + a few.
        EXPECT_LT(distance(A, B), (10 * (std::abs(alpha) + 10) * split + 10 * round_off) * size_of(A))
            << alpha << ' ' << split;
      }
    }
}

TEST(Ogden, TangentIsExactAtThreeEqualStretches) {
  for (double alpha : {-20.0, 20.0}) {
    const MaterialPointer m = ogden(alpha);
    const Mat9 A = tangent(*m, {});
    Mat9 expected{};  // 2 mu0 times the deviatoric symmetric projector, mu0 = mu alpha / 2
    const double mu0 = 20e3;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        expected[9 * (3 * i + j) + 3 * i + j] += mu0;
        expected[9 * (3 * i + j) + 3 * j + i] += mu0;
        expected[9 * (4 * i) + 4 * j] -= 2 * mu0 / 3;
      }
    EXPECT_LT(distance(A, expected), round_off * size_of(expected));
  }
}

/// Isochoric laws do not see the volume: P F^T stays the same when F is scaled. Strains lose the digits by which C is
/// smaller than I, twice as many in I2: at a thousandth of the volume four of sixteen.
TEST(IsochoricLaws, AreExactAtTinyAndHugeVolumes) {
  const char* laws[][2] = {{"neo_hookean", "mu = \"1 kPa\""},
                           {"mooney_rivlin", "c1 = \"1 kPa\", c2 = \"1 kPa\""},
                           {"ogden", "mu = \"1 kPa\", alpha = [3]"},
                           {"goh", "k1 = \"1 kPa\", k2 = 1, kappa = 0.1"}};
  for (const auto& [law, parameters] : laws) {
    const MaterialPointer m = material_of(law, parameters);
    const Mat3 tau = multiply(stress(*m, {.F = general_F}), transpose(general_F));
    for (double scale : {0.03, 0.1, 10.0, 1e3}) {
      const double lost = std::pow(std::min(scale, 1.0), -4);
      Mat3 F = general_F;
      for (double& x : F) x *= scale;
      EXPECT_LT(distance(multiply(stress(*m, {.F = F}), transpose(F)), tau), round_off * lost * size_of(tau))
          << law << scale;
    }
  }
}

/// As the volume vanishes, functions without bound push back ever harder; the quadratic one stops at K, and says so in
/// its documentation. No digit is lost on the way.
TEST(EveryVolumetricLaw, PushesBackAsTheVolumeVanishes) {
  for (const VolumetricEntry& entry : volumetric_entries()) {
    const double K = 1e6;
    const MaterialPointer m = material("density = \"1 kg/m^3\"\nvolumetric = { law = \"" + entry.info.name +
                                       "\", bulk_modulus = \"1 MPa\" }\n[materials.m.terms]\nt = { law = "
                                       "\"neo_hookean\", mu = \"1 kPa\" }\n");
    double last = 0;
    for (double J = 0.1; J > 1e-12; J /= 10) {
      SCOPED_TRACE(entry.info.name + " at J = " + std::to_string(J));
      const auto U = m->volumetric(J);
      EXPECT_TRUE(std::isfinite(U.U) && std::isfinite(U.dU) && std::isfinite(U.d2U));
      EXPECT_LT(U.dU, last);
      last = U.dU;
    }
    EXPECT_EQ(last > -1.001 * K, entry.info.name == "quad");
  }
}

/// exp(k2 E^2) runs out of numbers at k2 E^2 = 709: right below, not finite above.
TEST(Goh, IsFiniteUpToTheLargestExponentialAndRefusesBeyond) {
  const MaterialPointer m = material_of("goh", "k1 = \"1 kPa\", k2 = 524.6", "fibre_invariants = \"full\"\n");
  for (double k2E2 : {1e-6, 1.0, 200.0, 300.0, 720.0}) {
    const double E = std::sqrt(k2E2 / 524.6);
    Point p;
    const double stretch = std::sqrt(1 + E);
    p.F = dyad(p.fibre, p.fibre);
    for (double& x : p.F) x *= stretch - 1;
    for (int i = 0; i < 9; i += 4) p.F[i] += 1;
    const double along = size_of(stress(*m, p));
    const double exact = 2 * stretch * 1e3 * E * std::exp(k2E2);  // P = 2 psi' lambda a (x) a
    if (k2E2 < 700)
      EXPECT_NEAR(along / exact, 1, 1e-10) << k2E2;  // the exponential multiplies the rounding of its argument
    else
      EXPECT_FALSE(std::isfinite(along));
  }
}

/// Across the edge of tension the stress moves by no more than the stiffness allows, in steps too small for a solver to
/// see.
TEST(EveryTensionOnlyFibre, HasAContinuousStressAtTheEdge) {
  const char* laws[][2] = {
      {"goh", "k1 = \"2.4 kPa\", k2 = 0.84, kappa = 0.1"},
      {"goh", "k1 = \"2.4 kPa\", k2 = 0.84, switch = \"I4\""},
      {"weiss_fibre", "c3 = \"0.57 MPa\", c4 = 48, c5 = \"467.1 MPa\", lambda_straight = 1.062"},
      {"linear_fibre", "stiffness = \"200 kPa\""},
      {"hill_passive", "peak_stress = \"200 kPa\""},
      {"collagen_table", "stress_scale = \"200 kPa\", stress_free_rest = true"},
      {"holzapfel_ogden",
       "a = \"59 Pa\", b = 8, af = \"18 kPa\", bf = 16, as = \"2.5 kPa\", bs = 11, afs = \"216 Pa\", bfs = 11"}};
  for (const auto& [law, parameters] : laws) {
    const MaterialPointer m = material_of(law, parameters, "fibre_invariants = \"full\"\n");
    for (double h : {1e-4, 1e-8, 1e-12}) {
      Mat3 longer = identity, shorter = identity;
      for (int i = 0; i < 9; i += 4) longer[i] += h, shorter[i] -= h;
      const double stiffness = size_of(tangent(*m, {.F = longer})) + size_of(tangent(*m, {.F = shorter}));
      const double jump = distance(stress(*m, {.F = longer}), stress(*m, {.F = shorter}));
      EXPECT_LE(jump, 4 * h * stiffness) << law << ' ' << h;
    }
  }
}

}  // namespace
}  // namespace titin::testing
