#include <gtest/gtest.h>

#include <numbers>

#include "base/units.hpp"

namespace titin {
namespace {

std::vector<double> si(const std::string& text, const std::string& unit) {
  const units::Parsed parsed = units::parse(text, unit);
  EXPECT_EQ(parsed.problem, "");
  return parsed.values;
}

std::string wrong(const std::string& text, const std::string& unit) {
  const units::Parsed parsed = units::parse(text, unit);
  EXPECT_TRUE(parsed.values.empty());
  return parsed.problem + " -> " + parsed.advice;
}

TEST(Units, TurnQuantitiesIntoSi) {
  EXPECT_EQ(si("200 kPa", "Pa"), std::vector<double>{200e3});
  EXPECT_EQ(si("0, 10, 30 mm", "m"), (std::vector<double>{0, 0.010, 0.030}));
  EXPECT_EQ(si("1 cm, 10 mm", "m"), (std::vector<double>{0.01, 0.01}));
  EXPECT_EQ(si("1060 kg/m^3", "kg/m^3"), std::vector<double>{1060.0});
  EXPECT_EQ(si("1.06 g/cm3", "kg/m^3"), std::vector<double>{1060.0});
  EXPECT_EQ(si("25ms", "s"), std::vector<double>{0.025});
  EXPECT_EQ(si("+5 1/s", "1/s"), std::vector<double>{5.0});
  EXPECT_EQ(si("-5e0 s^-1", "1/s"), std::vector<double>{-5.0});
  EXPECT_DOUBLE_EQ(si("30 degree", "rad").front(), std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(si("2 µm", "m").front(), 2e-6);
  EXPECT_DOUBLE_EQ(si("37 degC", "K").front(), 310.15);
}

TEST(Units, TakePureNumbersBareOrInPercent) {
  EXPECT_EQ(si("0.1", ""), std::vector<double>{0.1});
  EXPECT_EQ(si("0, 0.5, 1", ""), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(si("10 %", ""), std::vector<double>{0.1});
}

TEST(Units, TellMissingFromUnknownFromWrongDimension) {
  EXPECT_EQ(wrong("25", "s"), R"("25" has no unit -> write a time with its unit, such as "25 ms")");
  EXPECT_EQ(wrong("25 mss", "s"), R"("25 mss" has an unknown unit "mss" -> write a time, such as "25 ms")");
  EXPECT_EQ(wrong("25 mm", "s"),
            R"("25 mm" is not a time: "mm" cannot be converted to s -> write a time, such as "25 ms")");
  EXPECT_EQ(
      wrong("25 mm", ""),
      R"("25 mm" is not a pure number: "mm" cannot be converted to a number -> write a pure number, such as "0.3")");
  EXPECT_EQ(
      wrong("1, 2 m, 3 m", "m"),
      R"("1, 2 m, 3 m" gives a unit to some numbers only -> write one unit after the last number, or one after each)");
}

TEST(Units, RefuseWhatIsNoFiniteNumber) {
  EXPECT_EQ(wrong("fast", "s"), R"("fast" does not start with a number -> write a time, such as "25 ms")");
  EXPECT_EQ(wrong("", "s"), R"("" has an empty entry -> remove the comma too many)");
  EXPECT_EQ(wrong("1,,2 s", "s"), R"("1,,2 s" has an empty entry -> remove the comma too many)");
  EXPECT_EQ(wrong("nan s", "s"), R"("nan s" is not a finite number -> write a time, such as "25 ms")");
  EXPECT_EQ(wrong("inf", ""), R"("inf" is not a finite number -> write a pure number, such as "0.3")");
  EXPECT_EQ(wrong("1e999 s", "s"),
            R"("1e999 s" is too large or too small for a number -> write a time, such as "25 ms")");
  EXPECT_EQ(wrong("1e308 Gs", "s"), R"("1e308 Gs" is too large for a number in s -> write a time, such as "25 ms")");
}

// UDUNITS reads "10 30 mm" as ten times the unit "30 mm": a forgotten comma must not change a number silently.
TEST(Units, RefuseForgottenCommas) {
  EXPECT_EQ(wrong("0 10 30 mm", "m"),
            R"("0 10 30 mm" has an unknown unit "10 30 mm" -> write a length, such as "30 mm")");
  EXPECT_EQ(wrong("5 m*3", "m"), R"("5 m*3" has an unknown unit "m*3" -> write a length, such as "30 mm")");
}

TEST(Units, WriteWhatReadsBackToTheSameNumber) {
  for (const double x : {0.1, 1.0 / 3, 6.02e23, -1e-300, 0.0, 200e3})
    EXPECT_EQ(si(units::text(x, "Pa"), "Pa"), std::vector<double>{x});
}

}  // namespace
}  // namespace titin
