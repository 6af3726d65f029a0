// Growth of a material: what holds for every law inside, and how it meets formulations with a separate volume.
#include <fmt/format.h>

#include "math/symmetric.hpp"
#include "memory_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;

const std::string elastic =
    "fibre = [0.8, 0.36, 0.48]\nfibre_invariants = \"full\"\nvolumetric = { law = \"simo\", bulk_modulus = \"1 MPa\" "
    "}\n";
const std::string terms =
    "[materials.m.terms]\nm = { law = \"mooney_rivlin\", c1 = \"6 kPa\", c2 = \"2 kPa\" }\n"
    "f = { law = \"goh\", k1 = \"24 kPa\", k2 = 0.84, kappa = 0.1, switch = \"none\" }\n";

MaterialPointer grown(const std::string& growth, const std::string& inside = terms) {
  const std::string line = growth.empty() ? "" : "growth = { " + growth + " }\n";
  return material("density = \"1000 kg/m^3\"\n" + elastic + line + inside);
}

struct Case {
  const char* growth;
  Mat3 Fg;
  double ratio;  // det Fg
};

Mat3 stretched(const Vec3& a, double across, double along) {
  Mat3 F = dyad(a, a);
  for (double& x : F) x *= along - across;
  for (int i = 0; i < 9; i += 4) F[i] += across;
  return F;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {R"(law = "isotropic", stretch = 1.1)", stretched({1, 0, 0}, 1.1, 1.1), 1.331},
      {R"(law = "area", stretch = 1.44, normal = [0, 3, 4])", stretched({0, 0.6, 0.8}, 1.2, 1), 1.44},
      {R"(law = "fibre", stretch = 1.15)", stretched({0.8, 0.36, 0.48}, 1, 1.15), 1.15},
      {R"(law = "fibre", stretch = 0.8, direction = [0, 2, 0])", stretched({0, 1, 0}, 1, 0.8), 0.8}};
  return all;
}

TEST(Growth, IsFreeOfStressWhereNothingHoldsItBack) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.growth);
    const MaterialPointer m = grown(c.growth);
    const Point free{.F = c.Fg};
    Mat3 P;
    whole_stress(*m, free.input(), &P, nullptr);
    EXPECT_LT(size_of(P), round_off * size_of(tangent(*m, free)) + round_off * 1e6);
    EXPECT_NEAR(determinant(c.Fg), c.ratio, round_off);
  }
}

TEST(Growth, StressesAndEnergiesAreThoseOfTheElasticPart) {
  const MaterialPointer inside = grown("");
  for (const Case& c : cases())
    for (const char* per : {"intermediate", "reference"}) {
      SCOPED_TRACE(fmt::format("{} per {}", c.growth, per));
      const MaterialPointer m = grown(fmt::format("{}, per = \"{}\"", c.growth, per));
      const double w = std::string(per) == "intermediate" ? c.ratio : 1;
      const Mat3 G = inverse(c.Fg);
      const Point at{.F = general_F}, elastic_part{.F = multiply(general_F, G)};
      Mat3 P, Pe;
      whole_stress(*m, at.input(), &P, nullptr);
      whole_stress(*inside, elastic_part.input(), &Pe, nullptr);
      const Mat3 expected = scaled(w, multiply(Pe, transpose(G)));
      EXPECT_LT(distance(P, expected), round_off * size_of(expected));
      double W = 0, We = 0;
      whole_energy(*m, at.input(), &W);
      whole_energy(*inside, elastic_part.input(), &We);
      EXPECT_NEAR(W, w * We, round_off * We);
      EXPECT_NEAR(m->density(), w * 1000, 1e-9);
    }
}

TEST(Growth, TangentIsTheDerivativeOfTheStressWithTheVolumeAndWithout) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.growth);
    const MaterialPointer m = grown(c.growth);
    for (bool whole : {false, true}) {
      const auto stress_at = [&](const Mat3& F, Mat9* A) {
        const Point at{.F = F};
        Mat3 P;
        whole ? whole_stress(*m, at.input(), &P, A) : m->stress(at.input(), &P, A);
        return P;
      };
      Mat9 A;
      stress_at(general_F, &A);
      const auto error = [&](double h) {
        Mat9 difference;
        for (int q = 0; q < 9; ++q) {
          Mat3 above = general_F, below = general_F;
          above[q] += h, below[q] -= h;
          const Mat3 P1 = stress_at(above, nullptr), P0 = stress_at(below, nullptr);
          for (int p = 0; p < 9; ++p) difference[9 * p + q] = (P1[p] - P0[p]) / (2 * h);
        }
        return distance(difference, A);
      };
      EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2, 0.1);
    }
  }
}

/// What a three-field element asks for: U, U', U'' of its own volume ratio.
TEST(Growth, VolumetricLawOfTheWholeRatioRestsAtTheGrownVolume) {
  for (const char* per : {"intermediate", "reference"}) {
    const MaterialPointer m = grown(fmt::format(R"(law = "isotropic", stretch = 1.1, per = "{}")", per));
    EXPECT_NEAR(m->volumetric(1.331).dU, 0, 1e-6);
    const double D = 1.2, h = 1e-4;
    const auto above = m->volumetric(D + h), below = m->volumetric(D - h), at = m->volumetric(D);
    EXPECT_NEAR((above.U - below.U) / (2 * h) / at.dU, 1, 1e-6);
    EXPECT_NEAR((above.dU - below.dU) / (2 * h) / at.d2U, 1, 1e-6);
  }
}

TEST(Growth, KeepsTheMemoryOfWhatIsInside) {
  const std::string viscous =
      "[materials.m.terms]\nm = { law = \"neo_hookean\", mu = \"5 Pa\", maxwell = { viscosity = \"10 Pa s\" } }\n";
  const MaterialPointer m = grown(R"(law = "isotropic", stretch = 1.1)", viscous);
  RememberingPoint point(m), plain(grown("", viscous));
  EXPECT_EQ(m->history_size(), 7);
  point.step(general_F, 0.0), plain.step(general_F, 0.0);
  for (int n = 0; n < 3; ++n) {  // the spring is blind to volume: isotropic growth changes its weight only
    const Mat3 P = point.step(general_F, 0.5), expected = scaled(1.331, plain.step(general_F, 0.5));
    EXPECT_LT(distance(P, expected), 1e-10 * size_of(expected));
  }
  EXPECT_NEAR(point.dissipated(), 1.331 * plain.dissipated(), 1e-10);
}

TEST(Growth, SaysWhatIsMissing) {
  const auto message = [](const std::string& growth) {
    try {
      material("density = \"1000 kg/m^3\"\nvolumetric = { bulk_modulus = \"1 MPa\" }\ngrowth = { " + growth +
               " }\n[materials.m.terms]\nm = { law = \"neo_hookean\", mu = \"5 Pa\" }\n");
    } catch (const InputError& e) {
      return e.messages().front();
    }
    return std::string();
  };
  EXPECT_NE(message(R"(law = "area", stretch = 1.2)").find("normal"), std::string::npos);
  EXPECT_NE(message(R"(law = "fibre", stretch = 1.2)").find("there is none"), std::string::npos);
  EXPECT_NE(message(R"(law = "isotropic", stretch = 0)").find("stretch"), std::string::npos);
  EXPECT_EQ(message(R"(law = "isotropic", stretch = 1.2)"), "");
}

}  // namespace
}  // namespace titin::testing
