#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/parallel.hpp"
#include "io/drawn_mesh.hpp"
#include "io/paraview.hpp"
#include "io/run_summary.hpp"
#include "io/time_series.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  any_of(false);  // rank 0 has written
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  any_of(false);  // rank 0 may go on
  return text.str();
}

std::string scratch(const std::string& name) {
  return (fs::path(testing::TempDir()) / ("titin_" + std::to_string(ranks()) + name)).string();
}

TEST(TimeSeries, IsReadableAfterEachRowAndExact) {
  const std::string file = scratch("history.csv");
  TimeSeries series(file, {{"time", "s"}, {"mean_stretch", ""}, {"a,\"b\"", "N"}});
  EXPECT_EQ(text_of(file), "time [s],mean_stretch,\"a,\"\"b\"\" [N]\"\n");
  series.add({0.1, 1.0 / 3, -2e-300});
  EXPECT_EQ(text_of(file), "time [s],mean_stretch,\"a,\"\"b\"\" [N]\"\n0.1,0.3333333333333333,-2e-300\n");
  any_of(false);
  if (is_root()) {
    EXPECT_THROW(series.add({1}), std::logic_error);
    EXPECT_THROW(TimeSeries("/not/there.csv", {}), std::runtime_error);
    fs::remove(file);
  }
}

TEST(TimeSeries, GoesOnBehindTheRowsThatCount) {
  const std::string file = scratch("continued.csv");
  const std::vector<Column> columns = {{"time", "s"}, {"a", ""}};
  {
    TimeSeries series(file, columns);
    for (const double x : {1, 2, 3}) series.add({x, -x});
    EXPECT_EQ(series.rows(), 3);
  }
  {
    TimeSeries series(file, columns, 2);
    series.add({4, -4});
    EXPECT_EQ(series.rows(), 3);
  }
  EXPECT_EQ(text_of(file), "time [s],a\n1,-1\n2,-2\n4,-4\n");
  EXPECT_THROW(TimeSeries(file, columns, 4), std::runtime_error);
  EXPECT_THROW(TimeSeries(file, {{"time", "s"}, {"b", ""}}, 2), std::runtime_error);
  EXPECT_THROW(TimeSeries(scratch("nothing.csv"), columns, 0), std::runtime_error);
  EXPECT_EQ(text_of(file), "time [s],a\n1,-1\n2,-2\n4,-4\n");
  if (is_root()) fs::remove(file);
}

TEST(RunSummary, CountsNewtonIterations) {
  RunSummary summary;
  summary.newton.per_step = {3, 5, 4};
  summary.newton.failed = 20;
  summary.newton.cuts = 2;
  summary.scene = "caf\xe9.toml";  // not UTF-8
  const auto json = nlohmann::json::parse(summary.json());
  EXPECT_EQ(json["status"], "running");
  EXPECT_EQ(json["newton"]["total"], 32);
  EXPECT_EQ(json["newton"]["max_per_step"], 5);
  EXPECT_EQ(json["newton"]["mean_per_step"], 4.0);
  EXPECT_EQ(json["newton"]["cuts"], 2);
  for (const char* key : {"status", "reason", "version", "commit", "libraries", "ranks", "unknowns", "steps", "krylov",
                          "cpu_seconds", "wall_seconds", "peak_rss_bytes", "timers", "errors", "conservation"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(nlohmann::json::parse(RunSummary().json())["newton"]["mean_per_step"], 0.0);
}

/// A block of two cells with a displacement and a pressure that jumps between them.
class Fields : public testing::Test {
 protected:
  mfem::Mesh serial = mfem::Mesh::MakeCartesian3D(2, 1, 1, mfem::Element::HEXAHEDRON);
  mfem::ParMesh mesh{MPI_COMM_WORLD, serial};
  mfem::H1_FECollection nodal{2, 3};
  mfem::L2_FECollection cellwise{1, 3};
  mfem::ParFiniteElementSpace vectors{&mesh, &nodal, 3}, scalars{&mesh, &cellwise};
  mfem::ParGridFunction displacement{&vectors}, pressure{&scalars};
  std::vector<Field> fields{{"displacement", "m", &displacement}, {"pressure", "Pa", &pressure}};
  std::string folder = scratch("paraview");
  void SetUp() override {
    displacement = 0.0;
    for (int cell = 0; cell < mesh.GetNE(); ++cell) {  // 1 in the left cell, 3 in the right
      mfem::Vector centre;
      mesh.GetElementCenter(cell, centre);
      mfem::Array<int> dofs;
      scalars.GetElementDofs(cell, dofs);
      for (int dof : dofs) pressure(dof) = centre(0) < 0.5 ? 1 : 3;
    }
    if (is_root()) fs::remove_all(folder);
    any_of(false);
  }
  void TearDown() override {
    any_of(false);
    if (is_root()) fs::remove_all(folder);
  }
};

TEST_F(Fields, IndexHasTimesWithAllDigitsAndIsCutOffByARestart) {
  {
    ParaView paraview(folder, mesh, fields, {});
    paraview.write(0, 0);
    paraview.write(4, 0.1);
    paraview.write(5, 0.1 + 1e-12);
  }
  const std::string index = text_of(folder + "/fields/fields.pvd");
  EXPECT_NE(index.find("timestep=\"0.1\""), std::string::npos) << index;
  EXPECT_NE(index.find("timestep=\"0.10000000000100001\""), std::string::npos) << index;
  const std::string piece = text_of(folder + "/fields/Cycle000004/proc000000.vtu");
  EXPECT_NE(piece.find("Name=\"displacement\" NumberOfComponents=\"3\""), std::string::npos) << piece.substr(0, 2000);
  EXPECT_NE(piece.find(">Pa</InformationKey>"), std::string::npos);
  EXPECT_NE(piece.find("vtkZLibDataCompressor"), std::string::npos);
  ParaView again(folder, mesh, fields, {}, {{0, 0}, {4, 0.1}});
  any_of(false);
  EXPECT_FALSE(fs::exists(folder + "/fields/Cycle000005"));
  EXPECT_TRUE(fs::exists(folder + "/fields/Cycle000004/data.pvtu"));
  again.write(7, 0.2);
  const std::string trimmed = text_of(folder + "/fields/fields.pvd");
  EXPECT_EQ(trimmed.find("Cycle000005"), std::string::npos) << trimmed;
  EXPECT_NE(trimmed.find("Cycle000007"), std::string::npos) << trimmed;
}

TEST_F(Fields, JumpsAreWrittenByTheRuleThatIsAskedFor) {
  const auto times_of = [](const DrawnArray& array, double x) {
    const auto same = [x](double y) { return std::abs(y - x) < 1e-12; };
    return sum(static_cast<long>(std::count_if(array.values.begin(), array.values.end(), same)));
  };
  DrawnMesh nodes(mesh, fields, Jumps::nodes), means(mesh, fields, Jumps::means), kept(mesh, fields, Jumps::kept);
  EXPECT_EQ(nodes.points(), ranks() == 1 ? 45u : 27u);
  EXPECT_EQ(sum(static_cast<long>(kept.points())), 54);
  const auto named = [](const std::vector<DrawnArray>& arrays) {
    for (const DrawnArray& array : arrays)
      if (array.name == "pressure") return array;
    return DrawnArray{};
  };
  const DrawnArray averaged = named(nodes.at_points()), of_cells = named(means.at_cells()),
                   jumping = named(kept.at_points());
  EXPECT_EQ(times_of(averaged, 1), 18);
  EXPECT_EQ(times_of(averaged, 3), 18);
  EXPECT_EQ(times_of(averaged, 2), ranks() == 1 ? 9 : 18);  // in the middle; two ranks have these points both
  EXPECT_EQ(times_of(of_cells, 1) + times_of(of_cells, 3), 2);
  EXPECT_EQ(times_of(jumping, 1), 27);
  EXPECT_EQ(named(means.at_points()).name, "");
}

}  // namespace
}  // namespace titin
