/// What the point driver understands, and what it answers when it does not.
#include <filesystem>
#include <fstream>

#include "point/named_columns.hpp"
#include "points_for_tests.hpp"

namespace titin::testing {
namespace {

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
std::string refusal_of_laws(const Words& laws, const Words& overrides) {
  return refusal([&] { PointScene::read(point_text_of_laws(laws, overrides)); });
}
void expect_words(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

const std::string gel = R"(
[materials.gel]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "100 kPa" }
terms.m = { law = "neo_hookean", mu = "10 kPa" }
)";
std::string refusal_of(const std::string& point) {
  return refusal([&] { PointScene::read({gel + "[point]\n" + point, "test.toml", {}}); });
}

TEST(PointScene, TakesAWholeSceneAndItsOnlyMaterial) {
  const PointScene scene =
      PointScene::read({gel + "regions = [\"body\"]\n[mesh]\nbox = 3\n[point]\nstretch = 1.2\n", "test.toml", {}});
  EXPECT_EQ(scene.material_name, "gel");
  EXPECT_EQ(scene.loading.volume, Volume::compressible);
}

TEST(PointScene, SaysWhatIsMissingOrTooMuch) {
  expect_words(refusal_of(""), "point: nothing drives the point; add stretch = 1.5, or stress = \"10 kPa\"");
  expect_words(refusal_of("stretch = 1.2\nstress = \"1 kPa\""), "stretch drives the point already; drop one of them");
  expect_words(refusal_of("shear = 1.2"), "this loading is driven by stretch; write stretch = ... instead");
  expect_words(refusal_of("stretch = -1"), "out of range");
  expect_words(refusal_of("strech = 1"), "did you mean \"stretch\"?");
  expect_words(refusal_of("stretch = 1.2\nmaterial = \"gell\""),
               "no material is called \"gell\"; write material = \"NAME\" with one of: gel");
  expect_words(refusal_of("stretch = 1.2\nloading = \"confined\"\nvolume = \"incompressible\""),
               "nothing is left free");
  expect_words(refusal_of("stretch = 1.2\nrise = \"0 s\""), "no time to rise in");
  expect_words(refusal_of("program = \"isotonic\"\nrelease = \"1 s\"\nend = \"1 s\""), "not after the release");
  expect_words(refusal_of("program = \"cycle\"\nstretch = { time = \"0, 1 s\", value = [1, 2] }"),
               "the drive is a curve already");
  expect_words(refusal_of("loading = \"components\"\nF.xx = 1.1\nP.xx = \"1 kPa\""),
               "F is given for this component as well");
}

TEST(CommandLine, FindsThePlaceOfEachKey) {
  const PointText text = point_text_of_laws({"neo_hookean", "hill_passive"},
                                            {"mu=10 kPa", "peak_stress=1 kPa", "fibre=[0, 1, 0]", "stretch=1.1"});
  EXPECT_EQ(text.overrides, (Words{"materials.material.terms.neo_hookean.mu=10 kPa",
                                   "materials.material.terms.hill_passive.peak_stress=1 kPa",
                                   "materials.material.fibre=[0, 1, 0]", "point.stretch=1.1"}));
  const PointScene scene = PointScene::read(text);
  EXPECT_EQ(scene.loading.volume, Volume::incompressible);
  EXPECT_EQ(scene.material->fibre()[1], 1);
}

TEST(CommandLine, AsksWhereTwoLawsShareAKey) {
  expect_words(refusal_of_laws({"hill_active", "hill_passive"}, {"peak_stress=1 kPa"}),
               "hill_active and hill_passive have this key; write hill_active.peak_stress");
  expect_words(refusal_of_laws({"neo_hookean"}, {"mu=1 kPa", "strech=2"}), "did you mean \"stretch\"?");
}

TEST(CommandLine, TakesAVolumetricLaw) {
  const Words keys{"mu=10 kPa", "stretch=1.1", "volumetric.bulk_modulus=1 MPa"};
  EXPECT_EQ(PointScene::read(point_text_of_laws({"neo_hookean"}, keys)).loading.volume, Volume::compressible);
}

TEST(NamedColumns, AreReadWithTheirUnits) {
  const NamedColumns table = parse_named_columns("# measured\ntime [ms], P_xx [kPa]\n0, 1.5\n\n10, -2e1 # last\n");
  ASSERT_EQ(table.problem, "");
  std::string problem;
  EXPECT_EQ(in_si(*table.find("P_xx"), "Pa", problem), (std::vector<double>{1500, -2e4}));
  EXPECT_EQ(problem, "");
  in_si(*table.find("time"), "Pa", problem);
  expect_words(problem, "column time");
  expect_words(parse_named_columns("a, b\n1, 2\n3\n").problem, "line 3 is no row of 2 numbers");
  expect_words(parse_named_columns("a, b\n").problem, "holds no rows");
}

TEST(Table, DrivesComponentsFromAFile) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "titin_components.csv";
  std::ofstream(file) << "time [ms],F_xx,P_yy [kPa]\n0,1,0\n10,1.2,1\n";
  const Curves c = run_scene(gel + "[point]\nloading = \"components\"\ntable = \"" + file.string() + "\"\n");
  std::filesystem::remove(file);
  EXPECT_DOUBLE_EQ(c["F_xx"].back(), 1.2);
  EXPECT_NEAR(c["P_yy"].back(), 1e3, 1e-8);
  EXPECT_NEAR(c["time"].back(), 0.01, 1e-17);
}

}  // namespace
}  // namespace titin::testing
