/// What the tests of points share: an experiment from a few words, and its columns by name.
#pragma once

#include <gtest/gtest.h>

#include "point/experiment.hpp"
#include "point/point_scene.hpp"

namespace titin::testing {

using Words = std::vector<std::string>;

struct Curves {
  CurveTable table;
  /// Column whose head is this name, with or without a unit.
  std::vector<double> operator[](const std::string& name) const {
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (table.columns[c].substr(0, table.columns[c].find(" [")) == name) {
        std::vector<double> values;
        for (const auto& row : table.rows) values.push_back(row[c]);
        return values;
      }
    ADD_FAILURE() << "no column " << name;
    return std::vector<double>(table.rows.size());
  }
};

inline Curves run(const PointText& text) {
  const PointScene scene = PointScene::read(text);
  Curves curves{run_experiment(*scene.material, scene.loading)};
  EXPECT_EQ(curves.table.problem, "");
  return curves;
}
/// Laws and overrides as on the command line.
inline Curves run(const Words& laws, const Words& overrides) { return run(point_text_of_laws(laws, overrides)); }
inline Curves run_scene(const std::string& scene, const Words& overrides = {}) {
  return run(PointText{scene, "test.toml", overrides});
}

}  // namespace titin::testing
