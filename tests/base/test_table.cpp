#include <gtest/gtest.h>

#include <numbers>

#include "base/table.hpp"
#include "base/text_file.hpp"

namespace titin {
namespace {

TEST(Table, IsLinearBetweenItsPointsAndConstantOutside) {
  const Table strain({0.1, 0.3, 0.5}, {0, 1, -1});
  EXPECT_EQ(strain(0), 0);
  EXPECT_EQ(strain(0.1), 0);
  EXPECT_DOUBLE_EQ(strain(0.2), 0.5);
  EXPECT_EQ(strain(0.3), 1);
  EXPECT_NEAR(strain(0.4), 0, 1e-15);
  EXPECT_EQ(strain(0.5), -1);
  EXPECT_EQ(strain(9), -1);
  EXPECT_EQ(Table(3)(7), 3);
  EXPECT_THROW(Table({0, 1}, {1}), std::logic_error);
}

std::string problem(const std::string& text) { return parse_columns(text, "").problem; }

TEST(Columns, AreReadWithNamesCommentsAndEitherSeparator) {
  const Columns c = parse_columns("# a strain\n t, strain \r\n0 0\n0.1,1e-1 # peak\n\n+0.2\t-1\n", "");
  EXPECT_EQ(c.problem, "");
  EXPECT_EQ(c.time, (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(c.value, (std::vector<double>{0, 0.1, -1}));
}

TEST(Columns, NameTheLineThatIsWrong) {
  EXPECT_EQ(problem(""), "holds no numbers");
  EXPECT_EQ(problem("t s\n# nothing\n"), "holds no numbers");
  EXPECT_EQ(problem("0 1 2\n"), "line 1: has 3 columns, not two (time, value)");
  EXPECT_EQ(problem("0 1\n\n0.5\n"), "line 3: has 1 number, not 2 as line 1");
  EXPECT_EQ(problem("0 1\nt s\n"), "line 2: \"t\" is not a finite number");
  EXPECT_EQ(problem("0 1\n1 nan\n"), "line 2: \"nan\" is not a finite number");
  EXPECT_EQ(problem("0 1\n1 2x\n"), "line 2: \"2x\" is not a finite number");
  EXPECT_EQ(problem("0 1\n0.3 1\n#\n0.1 2\n"), "line 4: time 0.1 s does not come after 0.3 s of line 2");
}

TEST(Columns, ObeyTheUnitsOfTheirHead) {
  for (const char* head :
       {"t [ms], u [mm]", "t [ms] u[mm]", "# t [ms], u [mm]", "\"t, all [ms]\",\"u [mm]\"", "u\t[ms] u [mm]"}) {
    const Columns c = parse_columns(std::string(head) + "\n0 0\n100 30\n", "m");
    EXPECT_EQ(c.problem, "") << head;
    EXPECT_EQ(c.time, (std::vector<double>{0, 0.1})) << head;
    EXPECT_EQ(c.value, (std::vector<double>{0, 0.03})) << head;
  }
  EXPECT_EQ(parse_columns("t [s], a [%]\n0 50\n", "").value, (std::vector<double>{0.5}));
  EXPECT_EQ(parse_columns("t [s], a [-]\n0 0.5\n", "").value, (std::vector<double>{0.5}));
  EXPECT_EQ(parse_columns("t [ms], u\n0 0.5\n", "m").value, (std::vector<double>{0.5}));  // SI where it does not say
  EXPECT_EQ(parse_columns("# fig. 3 of [Smith]\n0 0.5\n", "m").problem, "");              // no head of two columns
}

TEST(Columns, RefuseUnitsThatDoNotFit) {
  const auto problem_and_advice = [](const std::string& text, const std::string& unit) {
    const Columns c = parse_columns(text, unit);
    return c.problem + "; " + c.advice;
  };
  EXPECT_EQ(problem_and_advice("t [mss], u [mm]\n0 0\n", "m"),
            "column \"t\": \"mss\" is an unknown unit; name the unit of a time, such as [s]");
  EXPECT_EQ(problem_and_advice("t [s], u [kg]\n0 0\n", "m"),
            "column \"u\": \"kg\" is not the unit of a length; name the unit of a length, such as [m]");
  EXPECT_EQ(problem_and_advice("t [s], u [mm]\n0 0\n", ""),
            "column \"u\": \"mm\" is not the unit of a pure number; name the unit of a pure number, such as [%]");
  EXPECT_EQ(problem("t [s], u, v\n0 0\n"), "line 1: heads 3 columns, and 2 follow");
}

/// As OpenSim writes storage and motion files.
const std::string storage =
    "controls\nversion=1\nnRows=3\nnColumns=4\ninDegrees=yes\n\nUnits are S.I. units (second, meters)\nendheader\n"
    "time\tsoleus/activation\ttib_ant/activation\tankle_angle\n0.0\t0.02\t0.5\t0\n 0.1\t0.3\t0.4\t-180\n"
    "0.2\t1.0\t0.1\t90\n";

TEST(Columns, AreTakenByNameFromStorageFiles) {
  const Columns c = parse_columns(storage, "", "tib_ant/activation");
  EXPECT_EQ(c.problem, "");
  EXPECT_EQ(c.time, (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(c.value, (std::vector<double>{0.5, 0.4, 0.1}));
  const Columns angle = parse_columns(storage, "rad", "ankle_angle");
  EXPECT_NEAR(angle.value[1], -std::numbers::pi, 1e-15) << "inDegrees=yes";
  const Columns later = parse_columns("u [mm], time [ms], v [mm]\n1, 0, 2\n3, 10, 4\n", "m", "v");
  EXPECT_EQ(later.time, (std::vector<double>{0, 0.01})) << "the times are in the column of that name";
  EXPECT_EQ(later.value, (std::vector<double>{0.002, 0.004}));
}

// Found by fuzzing: the column of the times was taken for the values too, and left those empty.
TEST(Columns, AreNotTheTimes) {
  EXPECT_EQ(parse_columns("stress\n6\n", "Pa", "stress").problem, "column \"stress\" is that of the times");
  EXPECT_EQ(parse_columns("stress, t\n1, 0\n", "Pa", "t").problem, "column \"t\" is that of the times");
}

TEST(Columns, SayWhichThereAre) {
  const Columns misspelt = parse_columns(storage, "", "tib_ant/activaton"), unnamed = parse_columns(storage, "");
  EXPECT_EQ(misspelt.problem, "no column \"tib_ant/activaton\"");
  EXPECT_EQ(misspelt.advice,
            "did you mean \"tib_ant/activation\"? it has: time, soleus/activation, tib_ant/activation, ankle_angle");
  EXPECT_EQ(unnamed.problem, "line 10: has 4 columns, not two (time, value)");
  EXPECT_EQ(unnamed.advice,
            "name the values: column = \"...\"; it has: time, soleus/activation, tib_ant/activation, ankle_angle");
}

TEST(NumberTable, KeepsItsNames) {
  const NumberTable table = parse_numbers("time [s],\"a,\"\"b\"\" [N]\",stretch\n0,1,2\n3,4,5\n");
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[1].name, "a,\"b\"");
  EXPECT_EQ(table.columns[1].unit, "N");
  EXPECT_EQ(table.columns[2].name, "stretch");
  EXPECT_EQ(table.columns[2].values, (std::vector<double>{2, 5}));
  EXPECT_EQ(table.lines, (std::vector<int>{2, 3}));
}

}  // namespace
}  // namespace titin
