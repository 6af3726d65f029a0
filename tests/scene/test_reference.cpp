#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/parallel.hpp"
#include "scene/reference.hpp"

namespace titin {
namespace {

class References : public testing::Test {
 protected:
  std::string file = testing::TempDir() + "titin_reference_np" + std::to_string(ranks()) + ".csv";
  Config config{"[reference]\nhistory = \"" + file + "\"\n", "scene.toml"};
  Reference reference;

  void TearDown() override {
    any_of(false);
    if (is_root()) std::remove(file.c_str());
  }
  Reference& read(const std::string& text) {
    if (is_root()) std::ofstream(file) << text;
    any_of(false);  // waits for rank 0
    Section section = config.root().section("reference");
    reference.bind(section);
    reference.match({{"force", "N", 0}, {"length", "m", 0}, {"shift", "m", 0}, {"turn", "rad", 0}}, section);
    return reference;
  }
  std::string error() {
    try {
      config.finish();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void add(double time, double force, double length, double shift, double turn) {
    reference.add(time, {{"force", "N", force}, {"length", "m", length}, {"shift", "m", shift}, {"turn", "rad", turn}});
  }
};

TEST_F(References, AreComparedByNameAtTheirOwnTimesUpToTheEnd) {
  read("time [ms],length [mm],force\n0,10,4\n500,20,0\n1000,20,0\n2000,1e9,1e9\n");
  EXPECT_EQ(error(), "");
  add(0, 4, 0.010, 0, 0);
  add(1, 2, 0.030, 0, 0);
  const auto errors = reference.errors();
  ASSERT_EQ(errors.size(), 4u);
  // force: 4, 3, 2 against 4, 0, 0; weights 1/4, 1/2, 1/4
  EXPECT_DOUBLE_EQ(errors.at("force_l2"), std::sqrt((9.0 / 2 + 4.0 / 4) / (16.0 / 4)));
  EXPECT_DOUBLE_EQ(errors.at("force_max"), 3.0 / 4);
  // length: 10, 20, 30 mm against 10, 20, 20 mm
  EXPECT_NEAR(errors.at("length_l2"), std::sqrt(100.0 / 4 / (100.0 / 4 + 400.0 / 2 + 400.0 / 4)), 1e-14);
  EXPECT_NEAR(errors.at("length_max"), 0.5, 1e-14);
}

TEST_F(References, ThatVanishTakeTheScaleOfTheirUnit) {
  read("time [s],length,shift,turn\n0,2,0,0\n1,2,0,0\n");
  add(0, 0, 2, 0.1, 0.3);
  add(1, 0, 2, 0.1, 0.3);
  const auto errors = reference.errors();
  EXPECT_EQ(errors.at("length_l2"), 0);
  EXPECT_NEAR(errors.at("shift_l2"), 0.05, 1e-15);
  EXPECT_NEAR(errors.at("shift_max"), 0.05, 1e-15);
  EXPECT_NEAR(errors.at("turn_l2"), 0.3, 1e-15);
}

TEST_F(References, MayBeOneRow) {
  read("time [s],force\n1,2\n");
  add(0, 0, 0, 0, 0);
  add(1, 3, 0, 0, 0);
  EXPECT_EQ(reference.errors().at("force_l2"), 0.5);
}

TEST_F(References, MustNameWhatTheRunFollows) {
  read("time [s],forse,length [kg]\n0,0,0\n");
  const std::string head = "scene.toml:2:11: reference.history: file \"" + file.substr(0, 51), text = error();
  EXPECT_NE(text.find("this run follows no \"forse\"; did you mean \"force\"?"), std::string::npos) << text;
  EXPECT_NE(text.find("column \"length\": \"kg\" is not the unit of a length; this run has it in m"), std::string::npos)
      << text;
  EXPECT_EQ(text.substr(0, head.size()), head);
}

TEST_F(References, MustHaveTimesThatIncrease) {
  read("time [s],force\n0,0\n0,1\n");
  EXPECT_NE(error().find("line 3: time 0 s does not come after 0 s of line 2; write a first line of names"),
            std::string::npos);
}

TEST_F(References, WithoutNamesAreRefused) {
  read("0,0\n1,1\n");
  EXPECT_NE(error().find("has no column \"time\"; write a first line of names, such as time [s], volume [m^3]"),
            std::string::npos);
}

TEST(Reference, MayBeNone) { EXPECT_TRUE(Reference().errors().empty()); }

}  // namespace
}  // namespace titin
