// Boxes and Gmsh files become meshes with names; files that are no good get a sentence.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "mesh/gmsh.hpp"
#include "mesh/inverted_cells.hpp"
#include "mesh/mesh.hpp"

namespace titin {
namespace {

const std::string two_bricks = TITIN_TEST_DATA "/mesh/two_bricks.msh";

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

NamedMesh read(const std::string& keys) {
  Config config("[mesh]\n" + keys, "scene.toml");
  Section section = config.root().section("mesh");
  MeshConfig mesh;
  mesh.bind(section);
  NamedMesh named = NamedMesh::read(mesh, section);
  config.finish();
  return named;
}

std::string error(const std::string& keys) {
  try {
    read(keys);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

double volume(const NamedMesh& named, const std::string& region) {
  double mine = 0;
  for (int cell = 0; cell < named.mesh->GetNE(); ++cell)
    if (named.mesh->GetAttribute(cell) == named.regions.at(region)) mine += named.mesh->GetElementVolume(cell);
  return sum(mine);
}

double area(const NamedMesh& named, const std::string& boundary) {
  const auto marker = named.boundary_marker({boundary});
  double mine = 0;
  for (int face = 0; face < named.mesh->GetNBE(); ++face) {
    if (!marker[named.mesh->GetBdrAttribute(face) - 1]) continue;
    auto& map = *named.mesh->GetBdrElementTransformation(face);
    const auto shape = named.mesh->GetBdrElementBaseGeometry(face);
    map.SetIntPoint(&mfem::Geometries.GetCenter(shape));
    mine += mfem::Geometry::Volume[shape] * map.Weight();  // plane parallelograms and triangles: one point is exact
  }
  return sum(mine);
}

TEST(Box, NamesItsSidesAndItsBody) {
  const NamedMesh box = read("box = \"30, 20, 10 mm\"\ncells = [3, 2, 2]\n");
  EXPECT_EQ(box.mesh->GetGlobalNE(), 12);
  EXPECT_EQ(names_of(box.boundaries), "x+, x-, y+, y-, z+, z-");
  EXPECT_NEAR(volume(box, "body"), 6e-6, 1e-18);
  for (const char* name : {"x-", "x+"}) EXPECT_NEAR(area(box, name), 2e-4, 1e-16) << name;
  for (const char* name : {"y-", "y+"}) EXPECT_NEAR(area(box, name), 3e-4, 1e-16) << name;
  for (const char* name : {"z-", "z+"}) EXPECT_NEAR(area(box, name), 6e-4, 1e-16) << name;
}

TEST(Box, IsPartedIntoRegionsAcrossX) {
  for (const char* kind : {"tensor", "simplices", "wedges"}) {
    const NamedMesh box = read(std::string("box = \"30, 20, 10 mm\"\ncells = [3, 2, 2]\ninterfaces = \"10, 20 mm\"\n") +
                               "kind = \"" + kind + "\"\n");
    EXPECT_EQ(names_of(box.regions), "part 1, part 2, part 3");
    for (const char* name : {"part 1", "part 2", "part 3"}) EXPECT_NEAR(volume(box, name), 2e-6, 1e-18) << name;
  }
  EXPECT_NE(error("box = \"30, 20 mm\"\ncells = [3, 2]\ninterfaces = \"12 mm\"\n").find("lies inside of cells"),
            std::string::npos);
  EXPECT_NE(error("box = \"30, 20 mm\"\ncells = [3, 2]\ninterfaces = \"20, 10 mm\"\n").find("does not lie beyond"),
            std::string::npos);
}

TEST(Box, IsCutIntoSimplicesThatFillIt) {
  const std::string plane = "box = \"30, 20 mm\"\ncells = [3, 2]\n",
                    space = "box = \"30, 20, 10 mm\"\ncells = [3, 2, 2]\n";
  const struct {
    std::string box, cuts;
    int cells, nodes;
  } cases[] = {{plane, "same", 12, 12}, {plane, "alternating", 12, 12}, {plane, "crossed", 24, 18},
               {space, "same", 72, 36}, {space, "alternating", 60, 36}, {space, "crossed", 288, 36 + 12 + 52}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.box + c.cuts);
    const NamedMesh box = read(c.box + "kind = \"simplices\"\ncuts = \"" + c.cuts + "\"\n");
    const bool is_plane = c.box == plane;
    EXPECT_EQ(box.mesh->GetGlobalNE(), c.cells);
    if (ranks() == 1) EXPECT_EQ(box.mesh->GetNV(), c.nodes);
    EXPECT_NEAR(volume(box, "body"), is_plane ? 6e-4 : 6e-6, 1e-18);
    const double depth = is_plane ? 1 : 0.01;
    for (const char* name : {"x-", "x+"}) EXPECT_NEAR(area(box, name), 0.02 * depth, 1e-16) << name;
    for (const char* name : {"y-", "y+"}) EXPECT_NEAR(area(box, name), 0.03 * depth, 1e-16) << name;
    if (is_plane) continue;
    for (const char* name : {"z-", "z+"}) EXPECT_NEAR(area(box, name), 6e-4, 1e-16) << name;
  }
}

// In the corner at the origin no direction of a cube is before another: cells there are turned into each other.
TEST(Box, WithoutADirectionLooksAlikeAlongItsAxes) {
  for (const char* cuts : {"alternating", "crossed"}) {
    const NamedMesh box =
        read("box = \"2, 2, 2 m\"\ncells = [2, 2, 2]\nkind = \"simplices\"\ncuts = \"" + std::string(cuts) + "\"\n");
    std::multiset<std::array<double, 3>> centres, turned;
    for (int cell = 0; cell < box.mesh->GetNE(); ++cell) {
      mfem::Vector x;
      box.mesh->GetElementCenter(cell, x);
      const auto place = [&](int i) { return std::round(1e6 * x(i % 3)); };
      centres.insert({place(0), place(1), place(2)});
      turned.insert({place(1), place(2), place(0)});
    }
    if (ranks() == 1) EXPECT_EQ(centres, turned) << cuts;
  }
}

TEST(Gmsh, NamesRegionsAndBoundariesAndNumbersTheRest) {
  const NamedMesh named = read("file = \"" + two_bricks + "\"\n");
  EXPECT_EQ(named.mesh->GetGlobalNE(), 2);
  EXPECT_EQ(names_of(named.regions), "muscle, tendon");
  EXPECT_EQ(names_of(named.boundaries), "boundary 7, held end, pulled");
  EXPECT_NEAR(volume(named, "muscle"), 1e-6, 1e-18);
  EXPECT_NEAR(volume(named, "tendon"), 2e-6, 1e-18);
  const double slanted = 1e-4 * std::sqrt(1.04);
  EXPECT_NEAR(area(named, "held end"), slanted, 1e-16);
  EXPECT_NEAR(area(named, "pulled"), slanted, 1e-16);
  EXPECT_NEAR(area(named, "boundary 7"), 12e-4, 1e-15);
}

TEST(Gmsh, KeepsItsNamesWhenItIsRefined) {
  const NamedMesh named = read("file = \"" + two_bricks + "\"\nrefine = 2\n");
  EXPECT_EQ(named.mesh->GetGlobalNE(), 128);
  EXPECT_NEAR(volume(named, "muscle"), 1e-6, 1e-18);
  EXPECT_NEAR(area(named, "pulled"), 1e-4 * std::sqrt(1.04), 1e-16);
}

TEST(Gmsh, MayBeInMillimetres) {
  const NamedMesh named = read("file = \"" + two_bricks + "\"\nunit = \"1 mm\"\n");
  EXPECT_NEAR(volume(named, "muscle"), 1e-15, 1e-27);
}

/// two_bricks.msh with `from` replaced, in a file.
std::string changed_file(const std::string& from, const std::string& to) {
  const std::string file = testing::TempDir() + "titin_bad_np" + std::to_string(ranks()) + ".msh";
  if (is_root()) std::ofstream(file) << replaced(text_of(two_bricks), from, to);
  any_of(false);  // waits for rank 0
  return file;
}

/// The error of it, without its place.
std::string file_error(const std::string& from, const std::string& to) {
  const std::string file = changed_file(from, to);
  const std::string text = error("file = \"" + file + "\"\nrefine = 1\n"), head = "scene.toml:2:8: mesh.file: ";
  any_of(false);
  if (is_root()) std::remove(file.c_str());
  EXPECT_EQ(text.substr(0, head.size()), head);
  return text.substr(std::min(text.size(), head.size()));
}

TEST(Gmsh, IsNamedAsTheUserNamesIt) {
  const std::string text = file_error("2.2 0 8", "4.1 0 8");
  EXPECT_NE(text.find("titin_bad_np" + std::to_string(ranks()) +
                      ".msh\" is a Gmsh mesh of version 4.1, and only 2.2 is "
                      "read; save it from Gmsh as \"Version 2 ASCII\" (gmsh -save -format msh22)"),
            std::string::npos)
      << text;
}

TEST(Gmsh, WithCellsInsideOutIsRefused) {
  EXPECT_EQ(file_error("5 5 1 2 3 4 5 6 7 8", "5 5 5 6 7 8 1 2 3 4"),
            "8 of 16 cells are inside out; number the nodes of a cell as Gmsh does, and move those that make cells too "
            "slanted");
}

TEST(Gmsh, WithACornerInsideOutIsWarnedOf) {
  const int before = logging::warnings();
  warn_of_inverted_corners(read("file = \"" + two_bricks + "\"\n"));
  EXPECT_EQ(logging::warnings(), before);
  const std::string file = changed_file("\n1 0 0 0\n", "\n1 0.0052 0.0052 0\n");  // beyond the diagonal of its face
  testing::internal::CaptureStderr();
  warn_of_inverted_corners(read("file = \"" + file + "\"\n"));
  const std::string said = testing::internal::GetCapturedStderr();
  any_of(false);
  if (!is_root()) return;
  std::remove(file.c_str());
  EXPECT_NE(said.find("1 of 2 cells turned inside out at a corner, the first at (0.0052, 0.0052, 0) m"),
            std::string::npos)
      << said;
}

TEST(Mesh, NeedsACellForEveryRankAndNotTooMany) {
  const std::string few = "box = \"1, 1, 1 m\"\n";
  if (ranks() == 1)
    EXPECT_EQ(error(few), "");
  else
    EXPECT_EQ(
        error(few),
        "scene.toml:1:1: mesh.cells: 1 cell for 2 ranks; every rank needs at least one cell: take more cells or fewer "
        "ranks");
  EXPECT_EQ(
      error("box = \"1, 1, 1 m\"\ncells = [9999, 9999, 9999]\n"),
      "scene.toml:3:9: mesh.cells: 999700029999 cells; take at most 100000000: one rank holds them all while they "
      "are shared out");
  EXPECT_EQ(error("file = \"" + two_bricks + "\"\nrefine = 9\n").substr(0, 40),
            "scene.toml:3:10: mesh.refine: 9 is out o");
}

/// What the scanner says of two_bricks.msh with `from` replaced.
std::string problem(const std::string& from, const std::string& to) {
  std::istringstream in(replaced(text_of(two_bricks), from, to));
  return scan_gmsh(in).problem;
}

TEST(GmshScan, SaysWhatAFileIsInstead) {
  EXPECT_EQ(problem("$MeshFormat", "solid cube"), "is not a Gmsh mesh: it does not begin with $MeshFormat");
  EXPECT_EQ(problem("2.2 0 8", "4.1 0 8"), "is a Gmsh mesh of version 4.1, and only 2.2 is read");
  EXPECT_EQ(problem("2.2 0 8", "2.2 1 8"), "is a binary Gmsh mesh, and only text is read");
  EXPECT_EQ(problem("11 5 2 5 5 1 2 3 4 5 6 7 8", "11 7 2 5 5 1 2 3 4 5"),
            "has pyramids (line 39), and there is no element for them");
  std::istringstream surface("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n");
  EXPECT_EQ(scan_gmsh(surface).problem, "holds no cells");
  std::istringstream empty("");
  EXPECT_EQ(scan_gmsh(empty).problem, "is not a Gmsh mesh: it does not begin with $MeshFormat");
}

TEST(GmshScan, NamesTheLineThatIsDamaged) {
  EXPECT_EQ(problem("9 0.03 0 0", "9 0.03 0 O"), "line 22: \"O\" is no such number as belongs here");
  EXPECT_EQ(problem("9 0.03 0 0", "9 0.03 nan 0"), "line 22: has a coordinate that is not finite");
  EXPECT_EQ(problem("9 0.03 0 0", "9 0.03"), "line 22: has too few numbers");
  EXPECT_EQ(problem("9 0.03 0 0", "8 0.03 0 0"), "line 22: node 8 is there already");
  EXPECT_EQ(problem("11 5 2 5 5 1 2", "11 5 2 5 5 77 2"), "line 39: there is no node 77");
  EXPECT_EQ(problem("11 5 2 5 5 1 2", "11 5 2 5 5 3 2"), "line 39: an element has a node twice");
  EXPECT_EQ(problem("11 5 2 5 5 1 2", "11 5 2 5 5 2"), "line 39: an element of type 5 with 2 tags has 13 numbers");
  EXPECT_EQ(problem("11 5 2 5 5", "11 5 -2 5 5"), "line 39: an element of type 5 with -2 tags has 9 numbers");
  EXPECT_EQ(problem("11 5 2 5 5", "11 500 2 5 5"), "line 39: elements of type 500 are not read");
  EXPECT_EQ(problem("$Elements\n12", "$Elements\n-1"), "line 28: -1 is no number of entries");
  EXPECT_EQ(problem("$Elements\n12", "$Elements\n14"), "line 41: has too few numbers");
  EXPECT_EQ(problem("$EndElements\n", ""), "");
  EXPECT_EQ(problem("12 5 2 6 6 2 9 10 3 6 11 12 7\n$EndElements\n", ""), "ends after 39 lines");
  EXPECT_EQ(problem("1 3 2 7 7", "1 3 2 0 7"), "has elements with a physical group (line 30) and without (line 29)");
}

TEST(GmshScan, FindsWhatDoesNotFitTogether) {
  EXPECT_EQ(problem("1 3 2 7 7 1 4 3 2", "1 3 2 7 7 1 4 3 9"), "line 29: a surface that is no side of a cell");
  EXPECT_EQ(problem("1 3 2 7 7 1 4 3 2", "1 2 2 7 7 1 4 3"), "line 29: a surface that is no side of a cell");
  EXPECT_EQ(problem("12 5 2 6 6 2 9 10 3 6 11 12 7", "12 5 2 6 6 2 9 10 3 6 11 12 8"),
            "lines 39 and 40: cells that share three corners of a side, not four");
  EXPECT_EQ(problem("10 3 2 7 7 10 3 7 12", "10 5 2 6 6 2 9 10 3 6 11 12 7"),
            "line 40: a side belongs to more than two cells");
}

TEST(GmshScan, EndsOnAnyText) {
  const std::string good = text_of(two_bricks);
  unsigned state = 1;
  for (int n = 0; n < 2000; ++n) {
    std::string bad = good;
    for (int k = 0; k < 3; ++k) {
      state = state * 1664525u + 1013904223u;
      bad[(state >> 8) % bad.size()] = static_cast<char>(state >> 24);
    }
    std::istringstream in(bad.substr(0, n % 2 ? bad.size() : (state >> 8) % bad.size()));
    scan_gmsh(in);
  }
}

}  // namespace
}  // namespace titin
