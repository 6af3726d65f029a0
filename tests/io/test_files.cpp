#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/parallel.hpp"
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

TEST(ParaView, WritesAHighOrderCollection) {
  mfem::Mesh serial = mfem::Mesh::MakeCartesian3D(2, 1, 1, mfem::Element::HEXAHEDRON);
  mfem::ParMesh mesh(MPI_COMM_WORLD, serial);
  mfem::H1_FECollection collection(2, 3);
  mfem::ParFiniteElementSpace space(&mesh, &collection, 3);
  mfem::ParGridFunction displacement(&space);
  displacement = 0.0;
  const std::string folder = scratch("paraview");
  if (is_root()) fs::create_directories(folder);
  any_of(false);
  ParaView paraview(folder, "fields", mesh, {{"displacement", &displacement}});
  paraview.write(0, 0);
  paraview.write(4, 0.1);
  const std::string index = text_of(folder + "/fields/fields.pvd");
  EXPECT_NE(index.find("timestep=\"0.1\""), std::string::npos) << index;
  const std::string piece = text_of(folder + "/fields/Cycle000004/proc000000.vtu");
  EXPECT_NE(piece.find("Name=\"displacement\" NumberOfComponents=\"3\""), std::string::npos) << piece.substr(0, 2000);
  EXPECT_NE(piece.find("vtkZLibDataCompressor"), std::string::npos);
  any_of(false);
  if (is_root()) fs::remove_all(folder);
}

}  // namespace
}  // namespace titin
