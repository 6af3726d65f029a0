// What single laws promise beyond what every law must keep.
#include <filesystem>
#include <sstream>

#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;

std::string message(const std::string& law, const std::string& parameters, const std::string& more = "") {
  try {
    material_of(law, parameters, more);
  } catch (const InputError& error) {
    return error.messages().front();
  }
  return "";
}
void expect_message(const std::string& text, const char* law, const std::string& parameters) {
  EXPECT_NE(message(law, parameters).find(text), std::string::npos) << message(law, parameters);
}

Mat3 cauchy(const Mat3& P, const Mat3& F) { return scaled(1 / determinant(F), multiply(P, transpose(F))); }

Mat3 active(const std::string& options, const char* measure) {
  const MaterialPointer m = material_of("active_stress", "peak_stress = \"50 kPa\", activation = 0.8, " + options,
                                        std::string("fibre_invariants = \"") + measure + "\"\n");
  return cauchy(stress(*m, {.F = general_F}), general_F);
}

TEST(ActiveStress, IsTheStressThatItsMeasureNames) {
  const Vec3 a0{0.8, 0.36, 0.48}, a = multiply(general_F, a0);
  const double J = determinant(general_F), l = norm(a), t = 40e3;
  const Mat3 nn = scaled(1 / (l * l), dyad(a, a)), b = multiply(general_F, transpose(general_F));
  const auto shares = [&](double along, double across, const Mat3& isotropic) {
    Mat3 s = scaled(along - across, nn);
    add(s, across, isotropic);
    return s;
  };
  Mat3 pk2 = scaled(0.9 * t * l * l / J, nn);  // along 1, across 0.1: S = t (0.9 a0 (x) a0 + 0.1 I)
  add(pk2, 0.1 * t / J, b);
  const std::pair<const char*, Mat3> expected[] = {
      {R"(measure = "cauchy")", scaled(t, nn)},
      {R"(measure = "cauchy", along = 0.5, across = 0.25)", scaled(t, shares(0.5, 0.25, identity))},
      {R"(measure = "kirchhoff", across = 0.25)", scaled(t / J, shares(1, 0.25, identity))},
      {R"(measure = "pk1")", scaled(t * l / J, nn)},
      {R"(measure = "pk2", across = 0.1)", pk2}};
  for (const auto& [options, sigma] : expected)
    for (const char* measure : {"isochoric", "full"}) {
      SCOPED_TRACE(std::string(options) + measure);
      EXPECT_LT(distance(active(options, measure), sigma), round_off * size_of(sigma));
      Mat3 deviator = sigma;
      for (int i = 0; i < 9; i += 4) deviator[i] -= trace(sigma) / 3;
      EXPECT_LT(distance(active(std::string(options) + R"(, projection = "deviator")", measure), deviator),
                round_off * size_of(sigma));
    }
}

TEST(ActiveStress, RefusesAShareAcrossTheFibreInPk1) {
  expect_message("pk1", "active_stress", R"(peak_stress = "1 kPa", activation = 1, measure = "pk1", across = 0.1)");
}

TEST(Fung, IsGuccioneForTransverselyIsotropicExponents) {
  for (const char* measure : {"fibre_invariants = \"full\"\n", ""}) {
    const MaterialPointer one = material_of("guccione", R"(c = "2 kPa", bf = 8, bt = 2, bfs = 4)", measure);
    const MaterialPointer other =
        material_of("fung", R"(c = "2 kPa", bff = 8, bss = 2, bnn = 2, bfs = 4, bsn = 2, bfn = 4)", measure);
    const Mat3 P = stress(*one, {.F = general_F});
    EXPECT_LT(distance(stress(*other, {.F = general_F}), P), round_off * size_of(P));
  }
}

TEST(Fung, RefusesExponentsThatAreNotPositiveDefinite) {
  const std::string shear = "bfs = 4, bsn = 2, bfn = 4";
  expect_message("not positive definite", "fung", R"(c = "2 kPa", bff = 8, bss = 2, bnn = 2, bffss = 4.1, )" + shear);
  expect_message("not positive definite", "fung",
                 R"(c = "2 kPa", bff = 1, bss = 1, bnn = 1, bffss = -0.6, bssnn = -0.6, bnnff = -0.6, )" + shear);
  expect_message("bss", "fung", R"(c = "2 kPa", bff = 8, bss = -2, bnn = 2, )" + shear);
}

TEST(Fung, NeedsAxesAtRightAngles) {
  const std::string lines =
      "density = \"1000 kg/m^3\"\nfibre = [1, 0, 0]\nsecond_fibre = [1, 1, 0]\nvolumetric = { bulk_modulus = \"1 MPa\" "
      "}\n[materials.m.terms]\nt = { law = \"fung\", c = \"2 kPa\", bff = 8, bss = 2, bnn = 2, bfs = 4, bsn = 2, bfn = "
      "4 }\n";
  try {
    material(lines);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.messages().front().find("right angle"), std::string::npos);
  }
}

TEST(Goh, RoundedSwitchTendsToTheSharpOneAndHasASmoothTangent) {
  const std::string fibres = R"(k1 = "2 kPa", k2 = 2, kappa = 0.1)";
  const MaterialPointer sharp = material_of("goh", fibres);
  const Mat3 P = stress(*sharp, {.F = general_F});
  double last = 0;
  for (double w : {1e-2, 1e-3}) {
    const MaterialPointer smooth = material_of("goh", fibres + ", switch_width = " + std::to_string(w));
    const double off = distance(stress(*smooth, {.F = general_F}), P);
    if (last > 0) EXPECT_NEAR(std::log10(last / off), 2, 0.1);  // second order in the width, away from the switch
    last = off;
    Mat3 below = identity, above = identity;
    below[0] -= 1e-9, above[0] += 1e-9;
    const Mat9 A = tangent(*smooth, {.F = below});
    EXPECT_LT(distance(tangent(*smooth, {.F = above}), A), 1e-4 * size_of(A));
  }
  const Mat3 pushed{0.5, 0, 0, 0, 0.9, 0, 0, 0, 0.9};
  const MaterialPointer smooth = material_of("goh", R"(k1 = "2 kPa", k2 = 2, switch_width = 1e-4)");
  EXPECT_LT(size_of(stress(*smooth, {.F = pushed})), 1e-3);
  expect_message("rounded off", "goh", fibres + R"(, switch = "none", switch_width = 1e-4)");
}

/// The page that shows how a law is added shows this one, as it is.
TEST(Demiray, StandsInTheHowtoAsInItsFile) {
  const auto text = [](const char* path) {
    std::stringstream whole;
    whole << std::ifstream(std::string(TITIN_TEST_DATA) + "/../../" + path).rdbuf();
    return whole.str();
  };
  const std::string law = text("src/materials/demiray.hpp");
  ASSERT_FALSE(law.empty());
  EXPECT_NE(text("docs/howto/add_a_material.md").find(law), std::string::npos) << "copy the file into the page again";
  EXPECT_NE(text("src/materials/laws.cpp").find("#include \"materials/demiray.hpp\"\n"), std::string::npos);
}

TEST(Hencky, IsTheLimitOfOgdenPowersAlsoAtEqualStretches) {
  const MaterialPointer hencky = material_of("hencky", R"(mu = "1 kPa")");
  const MaterialPointer powers =
      material_of("ogden", R"(mu = "1, 1 kPa", alpha = [1e-3, -1e-3], normalisation = "abaqus")");
  for (const Mat3& F : {general_F, identity, Mat3{1.2, 0, 0, 0, 0.9, 0, 0, 0, 0.9}}) {
    const Mat3 P = stress(*powers, {.F = F});
    EXPECT_LT(distance(scaled(2.0, stress(*hencky, {.F = F})), P), 1e-5 * size_of(P) + 1e-9);
    const Mat9 A = tangent(*powers, {.F = F});
    Mat9 twice = tangent(*hencky, {.F = F});
    for (double& x : twice) x *= 2;
    EXPECT_LT(distance(twice, A), 1e-5 * size_of(A));
  }
}

TEST(BlemkerShear, DoesNotSeeTheVolume) {
  const char* moduli = R"(g1 = "1 kPa", g2 = "2 kPa")";
  const MaterialPointer split = material_of("blemker_shear", moduli);
  const MaterialPointer full = material_of("blemker_shear", moduli, "fibre_invariants = \"full\"\n");
  const Mat3 F = scaled(1.3, general_F), P = stress(*split, {.F = F});
  EXPECT_LT(distance(stress(*full, {.F = F}), P), round_off * size_of(P));
  EXPECT_LT(size_of(stress(*full, {.F = scaled(1.3, identity)})), 1e-9);
}

class TrainedWeights : public ::testing::Test {
 protected:
  /// A file of this content, and the key that names it.
  std::string file(const std::string& content) {
    std::ofstream(path_) << content;
    return "file = \"" + path_.string() + "\"";
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / "titin_test_trained_weights.json";
};

TEST_F(TrainedWeights, InAFileAreThoseOfTheScene) {
  const MaterialPointer said = material_of(
      "icnn", R"(amplitude = "1, 0.7 kPa", weight_1 = [0.9, 0.3], weight_2 = [0.1, 0.25], bias = [-0.4, 0.1])");
  const MaterialPointer read = material_of(
      "icnn",
      file(R"({"amplitude": "1, 0.7 kPa", "weight_1": [0.9, 0.3], "weight_2": [0.1, 0.25], "bias": [-0.4, 0.1]})"));
  EXPECT_EQ(stress(*said, {.F = general_F}), stress(*read, {.F = general_F}));
}

TEST_F(TrainedWeights, ThatWouldSoftenAreRefusedWhereverTheyStand) {
  expect_message("weight_1", "icnn", R"(amplitude = "1 kPa", weight_1 = [-0.9], weight_2 = [0.1], bias = [0])");
  expect_message("out of range", "icnn",
                 file(R"({"amplitude": "1 kPa", "weight_1": [-0.9], "weight_2": [0.1], "bias": [0]})"));
  expect_message("no shear modulus", "cann", R"(moduli_1 = "0, 0, 1, 0 kPa")");
}

TEST_F(TrainedWeights, SayWhatIsWrongWithTheirFile) {
  expect_message("not a JSON object", "icnn", file("[1, 2"));
  expect_message("\"bias\" of", "icnn", file(R"({"amplitude": "1 kPa", "weight_1": [0.9], "weight_2": [0.1]})"));
  expect_message("no unit", "icnn", file(R"({"amplitude": [1], "weight_1": [0.9], "weight_2": [0.1], "bias": [0]})"));
  expect_message("for every neuron", "icnn",
                 file(R"({"amplitude": "1 kPa", "weight_1": [0.9, 1], "weight_2": [0.1], "bias": [0]})"));
  expect_message("has the lists", "cann", "moduli_1 = \"1, 0, 0, 0 Pa\", " + file(R"({"moduli_1": "1, 0, 0, 0 Pa"})"));
}

}  // namespace
}  // namespace titin::testing
