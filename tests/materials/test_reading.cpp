/// Materials from scenes: what a scene may say, and what it is told when it is wrong.
#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;

const std::string head = "density = \"1060 kg/m^3\"\nvolumetric = { law = \"simo\", bulk_modulus = \"10 MPa\" }\n";
const std::string base = "[materials.m.terms]\nbase = { law = \"neo_hookean\", mu = \"1 kPa\" }\n";
const std::string passive = "[materials.m.terms]\np = { law = \"hill_passive\", peak_stress = \"200 kPa\" }\n";

std::vector<std::string> messages(const std::string& lines) {
  try {
    material(lines);
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

TEST(ReadMaterial, HoldsWhatTheSceneSays) {
  const MaterialPointer m =
      material(head +
               "fibre = [3, 0, 4]\n"
               "[materials.m.terms]\n"
               "base = { law = \"yeoh\", c1 = \"39.811 kPa\", c2 = \"73.247 kPa\" }\n"
               "active = { law = \"hill_active\", peak_stress = \"200 kPa\", max_strain_rate = \"5 1/s\", "
               "activation = { time = \"0, 0.1, 0.3 s\", value = [0, 0, 1] } }\n");
  EXPECT_EQ(m->density(), 1060);
  EXPECT_TRUE(m->has_fibres());
  EXPECT_NEAR(distance(m->fibre(), Vec3{0.6, 0, 0.8}), 0, round_off);
  ASSERT_EQ(m->terms().size(), 2u);
  EXPECT_EQ(m->terms()[0].name, "base");
  EXPECT_EQ(m->terms()[0].law, "yeoh");
  EXPECT_TRUE(m->terms()[0].stores_energy);
  EXPECT_FALSE(m->terms()[1].stores_energy);
  EXPECT_EQ(m->volumetric(1).d2U, 10e6);
  EXPECT_TRUE(m->symmetric_tangent(FibreRate::stretch_difference));
  EXPECT_FALSE(m->symmetric_tangent(FibreRate::velocity_gradient));
  EXPECT_TRUE(m->symmetric_tangent(FibreRate::velocity_gradient_symmetric));
  double stretch, rate, activation;
  Point p{.time = 0.2};
  m->fibre_state(p.input(), &stretch, &rate, &activation);
  EXPECT_NEAR(activation, 0.5, round_off);
}

TEST(ReadMaterial, RunsAFibreLawAlongEitherFamily) {
  const std::string law = "law = \"goh\", k1 = \"1 kPa\", k2 = 1, kappa = 0.1";
  const std::string directions = "fibre = [1, 0, 0]\nsecond_fibre = [0, 1, 0]\n[materials.m.terms]\n";
  const MaterialPointer second = material(head + directions + "t = { " + law + ", family = \"second\" }\n");
  const MaterialPointer first = material(head + "fibre = [0, 2, 0]\n[materials.m.terms]\nt = { " + law + " }\n");
  const Mat3 F{0.95, 0.1, 0, 0.2, 1.2, 0.1, 0, 0, 1};
  Mat3 P, Q;
  second->stress({.n = 1, .F = &F}, &P, nullptr);  // without directions of the points: the material's own
  first->stress({.n = 1, .F = &F}, &Q, nullptr);
  EXPECT_GT(size_of(P), 0);
  EXPECT_LE(distance(P, Q), round_off * size_of(P));
  const Vec3 own{0, 1, 0}, other{1, 0, 0};
  second->stress({.n = 1, .F = &F, .fibre = &other, .second_fibre = &own}, &Q, nullptr);
  EXPECT_EQ(P, Q);
}

TEST(ReadMaterial, MixesByWeight) {
  const std::string fat = "{ law = \"neo_hookean\", mu = \"260 kPa\" }\n";
  const MaterialPointer own = material(head + base);
  const MaterialPointer mixed = material(head + base +
                                         "[materials.m.mix]\nfraction = 0.1\ndensity = \"920 kg/m^3\"\n"
                                         "volumetric = { law = \"simo\", bulk_modulus = \"20 MPa\" }\nterms.fat = " +
                                         fat);
  EXPECT_NEAR(mixed->density(), 0.9 * 1060 + 0.1 * 920, round_off * 1e3);
  EXPECT_NEAR(mixed->volumetric(1).d2U, 0.9 * 10e6 + 0.1 * 20e6, round_off * 1e7);
  const Point p{.F = general_F};
  // Both are neo-Hookean: stresses are as their moduli.
  const double factor = 0.9 + 0.1 * 260;
  Mat3 expected = stress(*own, p);
  for (double& x : expected) x *= factor;
  EXPECT_LT(distance(stress(*mixed, p), expected), round_off * size_of(expected));
  EXPECT_NEAR(energy(*mixed, p), factor * energy(*own, p), round_off * energy(*mixed, p));
  Mat3 of_term;
  mixed->term_stress(1, p.input(), &of_term);
  EXPECT_NEAR(size_of(of_term), 26 / factor * size_of(expected), round_off * size_of(expected));
}

struct Wrong {
  std::string lines, message;
};

TEST(ReadMaterial, SaysWhatIsWrongAndWhatToDo) {
  const Wrong inputs[] = {
      {head + "fibre = [0, 0, 0]\n" + passive,
       "test.toml:4:9: materials.m.fibre: a fibre of zero length has no direction; give one such as [1, 0, 0]\n"},
      {head + passive,
       "test.toml:1:1: materials.m: term \"p\" (hill_passive) needs fibres; add fibre = [1, 0, 0], say\n"},
      {head + "fibre = [1, 0]\n" + passive, "test.toml:4:9: materials.m.fibre: has 2 numbers; give 3\n"},
      {"density = \"0 kg/m^3\"\nvolumetric = { bulk_modulus = \"1 MPa\" }\n" + base,
       "test.toml:2:11: materials.m.density: \"0 kg/m^3\" is out of range; allowed: > 0 kg/m^3\n"},
      {"density = \"nan kg/m^3\"\nvolumetric = { bulk_modulus = \"1 MPa\" }\n" + base,
       "test.toml:2:11: materials.m.density: \"nan kg/m^3\" is not a finite number; write a density, such as \"1060 "
       "kg/m^3\"\n"},
      {"density = \"1 kg/m^3\"\n" + base,
       "test.toml:1:1: materials.m: no volumetric law; add volumetric = { law = \"simo\", bulk_modulus = \"10 MPa\" "
       "}\n"},
      {head, "test.toml:1:1: materials.m: no terms, no strength; add [materials.m.terms] with at least one law\n"},
      {head + "[materials.m.terms]\nt = { law = \"neo_hookean\", mu = \"-1 kPa\" }\n",
       "test.toml:5:33: materials.m.terms.t.mu: \"-1 kPa\" is out of range; allowed: > 0 Pa\n"},
      {head + "[materials.m.terms]\nt = { law = \"neo_hookean\", mu = \"1 kPa\", nu = 0.4 }\n",
       "test.toml:5:42: materials.m.terms.t.nu: unknown key; did you mean \"mu\"?\n"},
      {head + base +
           "[materials.m.mix]\nfraction = 1.5\ndensity = \"1 kg/m^3\"\nvolumetric.bulk_modulus = \"1 MPa\"\n"
           "terms.base = { law = \"neo_hookean\", mu = \"1 kPa\" }\n",
       "test.toml:7:12: materials.m.mix.fraction: 1.5 is out of range; allowed: 0 to 1\n"
       "test.toml:10:14: materials.m.mix.terms.base: this material has another term called \"base\"; terms of a "
       "material "
       "and of its mix share names: choose another\n"},
      {head + "[materials.m.terms]\nt = { law = \"ogden\", mu = \"1, 2 kPa\", alpha = [2] }\n",
       "test.toml:5:47: materials.m.terms.t.alpha: 1 exponents for 2 moduli; give one for each modulus\n"},
      {head + "fibre = [1, 0, 0]\n[materials.m.terms]\n"
              "t = { law = \"goh\", k1 = \"1 kPa\", k2 = 1, kappa = 0.4, family = \"second\" }\n",
       "test.toml:1:1: materials.m: term \"t\" (goh) needs fibres; add second_fibre = [1, 0, 0], say\n"
       "test.toml:6:50: materials.m.terms.t.kappa: 0.4 is out of range; allowed: 0 to 0.3333333333333333\n"},
  };
  for (const Wrong& w : inputs) {
    SCOPED_TRACE(w.lines);
    std::string all;
    for (const std::string& m : messages(w.lines)) all += m + "\n";
    EXPECT_EQ(all, w.message);
  }
}

std::string warnings(const std::string& lines) {
  ::testing::internal::CaptureStderr();
  material(lines);
  return ::testing::internal::GetCapturedStderr();
}

/// Of the material as a whole and of what is wrapped around its terms; laws: test_registry.cpp.
TEST(ReadMaterial, WarnsOfWhatIsSeldomMeant) {
  const auto of_bulk_modulus = [](const char* value) {
    return warnings("density = \"1 kg/m^3\"\nvolumetric.bulk_modulus = \"" + std::string(value) + "\"\n" + base);
  };
  EXPECT_EQ(of_bulk_modulus("99 MPa"), "");
  EXPECT_NE(of_bulk_modulus("1 GPa").find("materials.m: the bulk modulus is 1e+06 times the shear modulus"),
            std::string::npos);
  const auto wrapped = [](const std::string& wrapper) {
    return warnings(head + "[materials.m.terms]\nt = { law = \"neo_hookean\", mu = \"1 kPa\", " + wrapper + " }\n");
  };
  EXPECT_EQ(wrapped("prony = { strength = [0.1, 0.2], time = \"3, 1 s\" }"), "");
  EXPECT_NE(wrapped("prony = { strength = [0.1, 0.2], time = \"1.4, 1 s\" }").find("t.prony.time: 1 s and 1.4 s"),
            std::string::npos);
  const std::string damage = "damage = { law = \"exponential\", scale = \"1 kJ/m^3\"";
  EXPECT_EQ(wrapped(damage + ", time = \"1 s\" }"), "");
  EXPECT_NE(wrapped(damage + " }").find("t.damage.time: without a relaxation time"), std::string::npos);
}

/// The list of laws grows; what must be there is the advice.
TEST(ReadMaterial, SuggestsTheLawThatWasMeant) {
  const auto said = messages(head + "[materials.m.terms]\nt = { law = \"neo_hokean\", mu = \"1 kPa\" }\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].find("test.toml:5:13: materials.m.terms.t.law: \"neo_hokean\" is not known here; did you mean "
                         "\"neo_hookean\"? allowed: "),
            0u)
      << said[0];
}

}  // namespace
}  // namespace titin::testing
