// Numbers of laws that are curves in time or fields in space: every number of every law gives what a constant would.
#include <fmt/format.h>

#include "materials/spatial_field.hpp"
#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;  // sums of a dozen weighted values, and a plane through them

SpatialField::Data cloud(int n, double size, const std::function<double(const Vec3&)>& f, Vec3 stretch = {1, 1, 1}) {
  SpatialField::Data data;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k) {
        const double wobble = 0.2 * std::sin(12.0 * i + 7 * j + 3 * k);  // no grid: no three places on a line
        const Vec3 x{stretch[0] * size / n * (i + wobble), stretch[1] * size / n * (j - wobble),
                     stretch[2] * size / n * k};
        data.places.push_back(x);
        data.values.push_back({f(x), 0, 0});
      }
  return data;
}

TEST(SpatialField, IsExactWhereItsValuesAreLinear) {
  const auto linear = [](const Vec3& x) { return 3 + 40 * x[0] - 25 * x[1] + 60 * x[2]; };
  for (const Vec3& stretch : {Vec3{1, 1, 1}, Vec3{1, 30, 1}, Vec3{1, 0, 1}, Vec3{0, 0, 1}}) {
    auto data = cloud(6, 0.1, linear, stretch);
    data.reach = 1;  // flattened, places come to lie on each other: no spacing to go by
    const SpatialField field(data);
    const Vec3 x{stretch[0] * 0.031, stretch[1] * 0.057, stretch[2] * 0.044};
    EXPECT_NEAR(field.value(x).value()[0], linear(x), round_off * 10) << stretch[0] << stretch[1] << stretch[2];
  }
}

TEST(SpatialField, GoesThroughItsValuesAndIsOfSecondOrderBetweenThem) {
  const auto curved = [](const Vec3& x) { return std::sin(20 * x[0]) * std::cos(15 * x[1]) + std::exp(10 * x[2]); };
  const auto error = [&](int n) {
    auto data = cloud(n, 0.1, curved);
    const SpatialField field(data);
    EXPECT_NEAR(field.value(data.places[n + 7]).value()[0], data.values[n + 7][0], round_off);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 x{0.02 + 3e-4 * i, 0.08 - 3e-4 * i, 0.05 + 2e-4 * (i % 50)};
      worst = std::max(worst, std::abs(field.value(x).value()[0] - curved(x)));
    }
    return worst;
  };
  const double coarse = error(8), fine = error(16);
  fmt::print("scattered values: error {:.2e}, half the spacing {:.2e}, order {:.2f}\n", coarse, fine,
             std::log2(coarse / fine));
  EXPECT_GT(std::log2(coarse / fine), 1.6) << "2, but for the places' irregular spacing";
}

TEST(SpatialField, AveragesDirectionsWithoutTheirSense) {
  SpatialField::Data data;
  data.directions = true;
  for (int i = 0; i <= 10; ++i) {
    const double angle = 0.05 * i, sense = i % 2 ? -2.0 : 1.0;
    data.places.push_back({0.01 * i, 0, 0});
    data.values.push_back({sense * std::cos(angle), sense * std::sin(angle), 0});
  }
  const SpatialField field(data);
  const Vec3 a = field.value({0.045, 0, 0}).value();
  EXPECT_NEAR(norm(a), 1, round_off);
  EXPECT_NEAR(std::abs(a[0] * std::sin(0.225) - a[1] * std::cos(0.225)), 0, 1e-4);
  EXPECT_FALSE(field.value({0.05, 0.031, 0})) << "three spacings away";
}

std::shared_ptr<const SpatialField> read_number(const std::string& table) {
  Config config("mu = " + table, std::string(TITIN_TEST_DATA) + "/fields/test.toml");
  auto field = SpatialField::read_number(config.root().section("mu"), {.unit = "Pa", .range = positive});
  config.finish();
  return field;
}

TEST(SpatialField, IsReadByTheNamesAndUnitsOfItsColumns) {
  const auto field = read_number(R"({ field = "muscle.csv", column = "peak_stress" })");
  EXPECT_NEAR(field->value({0.005, 0.002, 0.001}).value()[0], 100e3 + 0.2 * 200e3, 1e-6);
}

TEST(SpatialField, SaysWhatIsWrongWithItsTable) {
  const auto message = [](const std::string& table) -> std::string {
    try {
      read_number(table);
    } catch (const InputError& error) {
      const std::string text = error.what();
      return text.substr(text.find("mu."));
    }
    return "";
  };
  EXPECT_EQ(message(R"({ field = "muscle.csv", column = "peak_stres" })"),
            "mu.column: file \"muscle.csv\": no column \"peak_stres\"; did you mean \"peak_stress\"? it has: x, y, z, "
            "peak_stress, ax, ay, az");
  EXPECT_EQ(
      message(R"({ field = "muscle.csv" })"),
      "mu.field: file \"muscle.csv\": has 4 columns of values, not 1; name it: column = \"...\"; it has: x, y, z, "
      "peak_stress, ax, ay, az");
  EXPECT_EQ(message(R"({ field = "muscle.csv", column = "ax", between = "nearst" })"),
            "mu.between: \"nearst\" is not known here; did you mean \"nearest\"? allowed: linear, nearest");
}

/// What a number of a law is without saying: its own constant.
struct Number {
  std::string name, value;
};

/// The numbers "name = value" of a parameter set that are no lists.
std::vector<Number> numbers_of(const std::string& parameters, const LawInfo& law) {
  std::vector<Number> list;
  for (const KeyRecord& key : law.parameters) {
    if (key.type != "number") continue;
    const auto at = (" " + parameters).find(" " + key.path + " = ");
    if (at == std::string::npos) continue;
    const auto begin = at + key.path.size() + 3, end = parameters.find(',', begin);
    list.push_back({key.path, parameters.substr(begin, end - begin)});
  }
  return list;
}

TEST(EveryLaw, TakesCurvesForItsNumbers) {
  int tried = 0;
  for (const LawInfo& law : laws()) {
    if (law.kind == "volumetric" || law.kind == "fluid" || law.published.empty() || law.name == "ogden") continue;
    const std::string& constants = law.published.front().parameters;
    for (const Number& number : numbers_of(constants, law)) {
      SCOPED_TRACE(law.name + "." + number.name);
      // at 1 s the published value; before and after it another one
      const std::string bare =
          number.value.front() == '"' ? number.value.substr(1, number.value.size() - 2) : number.value;
      const auto gap = std::min(bare.find(' '), bare.size());
      const double value = std::stod(bare.substr(0, gap));
      const std::string list = fmt::format("{0}, {1}, {0}{2}", value * 1.01, value, bare.substr(gap));
      const std::string curve = fmt::format("{} = {{ time = \"0, 1, 2 s\", value = {} }}", number.name,
                                            bare.size() > gap ? '"' + list + '"' : '[' + list + ']');
      std::string varying = constants;
      varying.replace(varying.find(number.name + " = " + number.value), number.name.size() + 3 + number.value.size(),
                      curve);
      MaterialPointer plain, varied;
      try {
        plain = material_of(law.name, constants);
        varied = material_of(law.name, varying);
      } catch (const InputError& error) {
        const std::string what = error.what();
        const bool refused = what.find("is no number") != std::string::npos && law.name == "hencky";
        EXPECT_TRUE(refused || what.find("lies below") != std::string::npos ||
                    what.find("out of range") != std::string::npos)
            << what;  // or depends on another number
        continue;
      }
      Point at{.F = general_F, .F_old = general_F_old, .rate = FibreRate::stretch_difference, .time = 1};
      EXPECT_EQ(distance(stress(*plain, at), stress(*varied, at)), 0);
      EXPECT_EQ(distance(tangent(*plain, at), tangent(*varied, at)), 0);
      EXPECT_EQ(energy(*plain, at), energy(*varied, at));
      EXPECT_EQ(plain->terms().front().has_curves, false);
      EXPECT_EQ(varied->terms().front().has_curves, true);
      ++tried;
    }
  }
  fmt::print("{} numbers of laws as curves\n", tried);
  EXPECT_GT(tried, 25);
}

TEST(Fields, GiveEachPointItsOwnNumbers) {
  Config config(R"([m]
density = "1000 kg/m^3"
fibre = [1, 0, 0]
volumetric = { law = "simo", bulk_modulus = "1 MPa" }
[m.terms]
a = { law = "hill_passive", peak_stress = { field = "muscle.csv", column = "peak_stress" } }
b = { law = "neo_hookean", mu = { time = "0, 2 s", value = "10, 30 kPa" } }
)",
                std::string(TITIN_TEST_DATA) + "/fields/test.toml");
  const auto varied = Material::read(config.root().section("m"));
  config.finish();
  ASSERT_EQ(varied->fields().numbers.size(), 1u);
  constexpr int n = 40;  // more than a block
  std::vector<Mat3> F(n, general_F), P(n);
  std::vector<Mat9> A(n);
  std::vector<double> numbers(n), W(n);
  for (int p = 0; p < n; ++p) numbers[p] = 1e3 * (50 + 7 * p);
  PointInput in;
  in.n = n, in.F = in.F_old = F.data(), in.fields = numbers.data(), in.time = 1;
  varied->stress(in, P.data(), A.data());
  varied->term_energy(0, in, W.data());
  for (int p : {0, 17, n - 1}) {
    const MaterialPointer same = material(fmt::format(
        "density = \"1000 kg/m^3\"\nfibre = [1, 0, 0]\nvolumetric = {{ law = \"simo\", bulk_modulus = \"1 MPa\" }}\n"
        "[materials.m.terms]\na = {{ law = \"hill_passive\", peak_stress = \"{} Pa\" }}\nb = {{ law = \"neo_hookean\", "
        "mu "
        "= \"20 kPa\" }}\n",
        numbers[p]));
    const Point at{.F = general_F, .fibre = {1, 0, 0}};
    EXPECT_EQ(distance(P[p], stress(*same, at)), 0);
    EXPECT_EQ(distance(A[p], tangent(*same, at)), 0);
    double expected = 0;
    same->term_energy(0, at.input(), &expected);
    EXPECT_EQ(W[p], expected);
  }
  in.fields = nullptr;
  varied->stress(in, P.data(), nullptr);
  EXPECT_TRUE(std::isnan(P[0][0])) << "nobody says where the point is";
}

}  // namespace
}  // namespace titin::testing
