/// What every law must keep, whichever it is: the tests walk the registry, so that no law escapes them.
#include <fmt/format.h>

#include <set>

#include "every_law.hpp"
#include "materials/fluid.hpp"

namespace titin::testing {
namespace {

// Measured orders of central differences (2 in theory) may lie a little low: the next term of the series.
constexpr double order_of_central_differences = 1.9;
// Central differences of quadratic functions are exact but for the rounding of P, divided by the step.
constexpr double exact_difference = 1e-11;
/// Smallest order with which an error falls when its step is halved, from three steps.
double order(const std::function<double(double h)>& error, double h = 8e-3) {
  const double e[] = {error(h), error(h / 2), error(h / 4)};
  if (e[0] == 0) return std::numeric_limits<double>::infinity();  // a slack fibre
  return std::min(std::log2(e[0] / e[1]), std::log2(e[1] / e[2]));
}

TEST(EveryLaw, StressIsTheDerivativeOfItsEnergyAtTheOrderOfCentralDifferences) {
  for_each_case([](const Case& c) {
    if (!c.law.stores_energy) return;
    const MaterialPointer m = c.material();
    const Point at = general_point(FibreRate::none);
    const Mat3 P = stress(*m, at);
    const auto error = [&](double h) {
      Mat3 difference;
      for (int q = 0; q < 9; ++q) {
        Point above = at, below = at;
        above.F[q] += h, below.F[q] -= h;
        difference[q] = (energy(*m, above) - energy(*m, below)) / (2 * h);
      }
      return distance(difference, P);
    };
    EXPECT_GT(order(error), order_of_central_differences);
  });
}

TEST(EveryLaw, TangentIsTheDerivativeOfItsStressAtTheOrderOfCentralDifferences) {
  for (FibreRate rate : rates)
    for_each_case([&](const Case& c) {
      SCOPED_TRACE(fmt::format("rate {}", static_cast<int>(rate)));
      const MaterialPointer m = c.material();
      const Point at = general_point(rate);
      const Mat9 A = tangent(*m, at);
      const auto error = [&](double h) {
        Mat9 difference;
        for (int q = 0; q < 9; ++q) {
          Point above = at, below = at;
          above.F[q] += h, below.F[q] -= h;
          const Mat3 P = stress(*m, above), P_below = stress(*m, below);
          for (int p = 0; p < 9; ++p) difference[9 * p + q] = (P[p] - P_below[p]) / (2 * h);
        }
        return distance(difference, A);
      };
      if (error(8e-3) <= exact_difference * size_of(A)) return;  // P is of second degree in F
      EXPECT_GT(order(error), order_of_central_differences);
    });
}

TEST(EveryLaw, StressIsTheSameWithAndWithoutTheTangent) {
  for_each_case([](const Case& c) {
    const Point at = general_point(FibreRate::stretch_difference);
    Mat3 P;
    Mat9 A;
    const MaterialPointer m = c.material();
    m->stress(at.input(), &P, &A);
    EXPECT_LE(distance(P, stress(*m, at)), round_off * size_of(P));
  });
}

TEST(EveryLaw, IsObjective) {
  const Mat3 Q = rotation(0.7);
  for (FibreRate rate : rates)
    for_each_case([&](const Case& c) {
      const MaterialPointer m = c.material();
      const Point at = general_point(rate);
      Point turned = at;
      turned.F = multiply(Q, at.F), turned.F_old = multiply(Q, at.F_old);
      const Mat3 P = stress(*m, at);
      EXPECT_LE(distance(stress(*m, turned), multiply(Q, P)), round_off * size_of(P));
    });
}

TEST(EveryLaw, WithoutFibresIsIsotropic) {
  const Mat3 Q = rotation(-1.1);
  for_each_case([&](const Case& c) {
    if (c.law.needs_fibre) return;
    const MaterialPointer m = c.material();
    Point at = general_point(FibreRate::none);
    const Mat3 P = stress(*m, at);
    at.F = multiply(at.F, Q);
    EXPECT_LT(distance(stress(*m, at), multiply(P, Q)), round_off * size_of(P));
  });
}

TEST(EveryLaw, IsFreeOfStressInARigidRotationUnlessItDeclaresOtherwise) {
  for_each_case([](const Case& c) {
    if (!c.published) return;  // options may pull at rest: the De Groote passive curve does
    const MaterialPointer m = c.material();
    for (FibreRate rate : rates) {
      Point at{.F = rotation(0.9), .rate = rate};
      at.F_old = at.F;
      const double P = size_of(stress(*m, at)), stiffness = size_of(tangent(*m, at));
      if (c.law.pulls_at_rest.empty())
        EXPECT_LE(P, round_off * stiffness);
      else
        EXPECT_GT(P, round_off * stiffness);
    }
  });
}

TEST(EveryLaw, SaysExactlyWhetherItsTangentIsSymmetric) {
  for (FibreRate rate : rates)
    for_each_case([&](const Case& c) {
      const MaterialPointer m = c.material();
      const Mat9 A = tangent(*m, general_point(rate));
      Mat9 transposed;
      for (int p = 0; p < 9; ++p)
        for (int q = 0; q < 9; ++q) transposed[9 * p + q] = A[9 * q + p];
      if (m->symmetric_tangent(rate))
        EXPECT_LE(distance(A, transposed), round_off * size_of(A));
      else
        EXPECT_GT(distance(A, transposed), 1e-3 * size_of(A));
    });
}

TEST(EveryLaw, IsNotANumberWhereThePointIsInvertedAndOnlyThere) {
  for_each_case([](const Case& c) {
    const MaterialPointer m = c.material();
    const Mat3 F[3] = {general_F, {-1, 0, 0, 0, 1, 0, 0, 0, 1}, identity};
    const Vec3 a[3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    const PointInput in{3, F, F, a, 0, 0.01, FibreRate::none};
    Mat3 P[3];
    whole_stress(*m, in, P, nullptr);
    EXPECT_FALSE(std::isnan(P[0][0]));
    EXPECT_TRUE(std::isnan(P[1][0]));
    EXPECT_FALSE(std::isnan(P[2][0]));
  });
}

TEST(EveryLaw, TreatsTheSamePointAlikeInAnyBatch) {
  for_each_case([](const Case& c) {
    const MaterialPointer m = c.material();
    constexpr int n = 2 * block_size + 3;
    std::vector<Mat3> F(n), F_old(n, general_F_old), P(n);
    std::vector<Vec3> a(n, Vec3{0.8, 0.36, 0.48});
    for (int p = 0; p < n; ++p) F[p] = stretched_along(general_F, a[p], 1 + 0.01 * p / n);
    m->stress({n, F.data(), F_old.data(), a.data(), 0, 0.5, FibreRate::velocity_gradient}, P.data(), nullptr);
    for (int p = 0; p < n; ++p) {
      const Point alone{.F = F[p], .F_old = general_F_old, .rate = FibreRate::velocity_gradient, .dt = 0.5};
      EXPECT_EQ(stress(*m, alone), P[p]) << p;
    }
  });
}

TEST(Registry, ListsEveryLawWithFormulaSourceAndDocumentedKeys) {
  std::map<std::string, int> seen;
  for (const LawInfo& law : laws()) {
    SCOPED_TRACE(law.name);
    EXPECT_EQ(seen[law.name]++, 0);
    EXPECT_FALSE(law.formula.empty());
    EXPECT_FALSE(law.source.empty());
    EXPECT_FALSE(law.parameters.empty());
    for (const KeyRecord& key : law.parameters) EXPECT_FALSE(key.doc.empty()) << key.path;
    for (const ParameterSet& p : law.published) {
      EXPECT_FALSE(p.tissue.empty());
      EXPECT_FALSE(p.source.empty());
    }
    EXPECT_NE(law.published.empty(), law.unpublished.empty()) << "a traceable set, or why there is none";
  }
  EXPECT_EQ(seen.count("yeoh"), 1u);
  EXPECT_EQ(seen.count("simo"), 1u);
}

/// Laws that are no terms; the others read theirs in every test above.
TEST(Registry, ReadsThePublishedSetsOfVolumesAndFluids) {
  const auto read = [](const auto& entry) {
    for (const ParameterSet& set : entry.info.published) {
      Config config("law = { name = 0, " + set.parameters + " }", entry.info.name);
      Section law = config.root().section("law");
      law.leave("name");
      EXPECT_NE(entry.read(law), nullptr);
      EXPECT_NO_THROW(config.finish()) << entry.info.name << " " << set.parameters;
    }
  };
  for (const VolumetricEntry& entry : volumetric_entries()) read(entry);
  for (const FluidEntry& entry : fluid_entries()) read(entry);
}

std::string warnings(const std::string& law, const std::string& parameters) {
  ::testing::internal::CaptureStderr();
  material_of(law, parameters);
  return ::testing::internal::GetCapturedStderr();
}

/// Allowed numbers that a law warns of, and a part of what it says.
struct Warned {
  const char *law, *parameters, *words;
};
constexpr Warned warned[] = {
    {"active_stress", R"(peak_stress = "1 kPa", activation = 1, measure = "pk2", along = 0.2, across = 0.5)",
     "t.across: "},
    {"arruda_boyce", R"(mu = "1 kPa", locking_stretch = 1.1)", "t.locking_stretch: "},
    {"cann_fibre", R"(w1 = "1 kPa", w2 = "1 kPa", b = 500)", "t.b: its exponential overflows"},
    {"compressible_neo_hookean", R"(mu = "1 kPa", lambda = "100 kPa")", "t.lambda: Poisson's ratio"},
    {"demiray", R"(a = "1 kPa", b = 2000)", "t.b: its exponential overflows"},
    {"fung", R"(c = "1 kPa", bff = 2000, bss = 2, bnn = 2, bfs = 1, bsn = 1, bfn = 1)", "t.bff: its exponential"},
    {"gent", R"(mu = "1 kPa", limit = 0.01)", "t.limit: "},
    {"goh", R"(k1 = "1 kPa", k2 = 500)",
     "t.k2: its exponential overflows before a stretch of 1.5, at a strain of 1.19"},
    {"goh", R"(k1 = "1 kPa", k2 = 1, kappa = 0.3333)", "t.kappa: 1/3 makes the fibres isotropic"},
    {"goh", R"(k1 = "1 kPa", k2 = 1, kappa = 0.1, switch = "I4")", "t.switch: with I4 and dispersion the stress jumps"},
    {"goh", R"(k1 = "1 kPa", k2 = 1, switch = "none")", "t.switch: with none, fibres push"},
    {"guccione", R"(c = "1 kPa", bf = 2000, bt = 2, bfs = 4)", "t.bf: its exponential overflows"},
    {"holmes_mow", R"(mu = "1 kPa", lambda = "100 kPa", beta = 1)", "t.lambda: Poisson's ratio"},
    {"holzapfel_ogden", R"(a = "1 kPa", b = 8, af = "1 kPa", bf = 16, as = "1 kPa", bs = 500, afs = "1 kPa", bfs = 11)",
     "t.bs: its exponential"},
    {"mooney_rivlin", R"(c1 = "2 kPa", c2 = "-1 kPa")", "t.c2: a negative coefficient"},
    {"ogden", R"(mu = "1 kPa", alpha = [1.3])", "t.alpha: the term with alpha = 1.3 is not rank-one convex"},
    {"st_venant_kirchhoff", R"(mu = "1 kPa", lambda = "100 kPa")", "t.lambda: Poisson's ratio"},
    {"veronda_westmann", R"(c1 = "1 kPa", c2 = 0.1)", "t.c2: so small, the energy turns negative"},
    {"weiss_fibre", R"(c3 = "1 MPa", c4 = 50, c5 = "1 MPa", lambda_straight = 1.05)", "t.c5: "},
    {"yeoh", R"(c1 = "1 kPa", c2 = "-1 kPa")", "t.c2: with a negative c2"},
};

TEST(EveryLaw, SaysWhatIsAllowedButSeldomMeant) {
  std::set<std::string> exercised, advising;
  for (const auto& [law, parameters, words] : warned) {
    const std::string said = warnings(law, parameters);
    EXPECT_NE(said.find(words), std::string::npos) << law << " { " << parameters << " } says: " << said;
    exercised.insert(law);
  }
  for (const LawInfo& law : laws())
    if (law.advises) advising.insert(law.name);
  EXPECT_EQ(exercised, advising);
}

TEST(EveryLaw, IsSilentAboutPublishedNumbersButOgdensRubber) {
  for_each_case([](const Case& c) {
    if (!c.published) return;
    const bool rubber = c.law.name == "ogden" && c.parameters.find("630") != std::string::npos;
    EXPECT_EQ(warnings(c.law.name, c.parameters).find("rank-one") != std::string::npos, rubber);
    if (!rubber) EXPECT_EQ(warnings(c.law.name, c.parameters), "");
  });
}

TEST(EveryVolumetricLaw, HasItsDerivativesAndRestsAtOne) {
  for (const VolumetricEntry& entry : volumetric_entries()) {
    SCOPED_TRACE(entry.info.name);
    const double K = 2e6;
    const MaterialPointer m = material(
        "density = \"1000 kg/m^3\"\nvolumetric = { law = \"" + entry.info.name +
        "\", bulk_modulus = \"2 MPa\" }\n[materials.m.terms]\nt = { law = \"neo_hookean\", mu = \"1 kPa\" }\n");
    EXPECT_NEAR(m->volumetric(1).U, 0, round_off * K);
    EXPECT_NEAR(m->volumetric(1).dU, 0, round_off * K);
    EXPECT_NEAR(m->volumetric(1).d2U, K, round_off * K);
    const double J = 1.2, h = 1e-4, second_order = 1e-6 * K;
    const auto above = m->volumetric(J + h), below = m->volumetric(J - h), at = m->volumetric(J);
    EXPECT_NEAR((above.U - below.U) / (2 * h), at.dU, second_order);
    EXPECT_NEAR((above.dU - below.dU) / (2 * h), at.d2U, second_order);
  }
}

}  // namespace
}  // namespace titin::testing
