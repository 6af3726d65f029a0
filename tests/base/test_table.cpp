#include <gtest/gtest.h>

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

TEST(Columns, AreReadWithNamesCommentsAndEitherSeparator) {
  const Columns c = parse_columns("# a strain\n t, strain \r\n0 0\n0.1,1e-1 # peak\n\n+0.2\t-1\n");
  EXPECT_EQ(c.problem, "");
  EXPECT_EQ(c.time, (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_EQ(c.value, (std::vector<double>{0, 0.1, -1}));
}

TEST(Columns, NameTheLineThatIsWrong) {
  EXPECT_EQ(parse_columns("").problem, "holds no numbers");
  EXPECT_EQ(parse_columns("t s\n# nothing\n").problem, "holds no numbers");
  EXPECT_EQ(parse_columns("0 1 2\n").problem, "line 1: has 3 columns, not two (time, value)");
  EXPECT_EQ(parse_columns("0 1\n\n0.5\n").problem, "line 3: has 1 column, not two (time, value)");
  EXPECT_EQ(parse_columns("0 1\nt s\n").problem, "line 2: \"t\" is not a finite number");
  EXPECT_EQ(parse_columns("0 1\n1 nan\n").problem, "line 2: \"nan\" is not a finite number");
  EXPECT_EQ(parse_columns("0 1\n1 2x\n").problem, "line 2: \"2x\" is not a finite number");
  EXPECT_EQ(parse_columns("0 1\n0.3 1\n#\n0.1 2\n").problem, "line 4: time 0.1 s does not come after 0.3 s of line 2");
}

}  // namespace
}  // namespace titin
