// The block solver against factors of the same tangent: the same solutions, in numbers of iterations that do not grow
// with the bulk modulus, the step, fibres, bent or stretched cells; and the same Newton iterations in a run.
#include <fmt/format.h>
#include <fmt/ostream.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double mu = 1e4, side = 0.03;  // [Pa], [m]
constexpr double tolerance = 1e-6;       // of the residual of forces
constexpr int wanted = 30;               // iterations at most

struct Case {
  double ratio, dt, fibre, aspect, wave, strain;
  std::string kind = "tensor";  // of the cells
  int order = 2;
  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << fmt::format(
               "{} of order {}, bulk/shear {:g}, dt {:g}, fibres {:g}, aspect {:g}, wave {:g}, strain {:g}", c.kind,
               c.order, c.ratio, c.dt, c.fibre, c.aspect, c.wave, c.strain);
  }
};

Parts read_cube(const Case& c, const std::string& method, int cells) {
  std::string text = fmt::format("[mesh]\nbox = \"{0} m, {0} m, {1} m\"\ncells = [{2}, {2}, {2}]\nkind = \"{3}\"\n",
                                 side, side * c.aspect, cells, c.kind);
  text += fmt::format("[muscle]\norder = {}\ninertia = \"{}\"\n", c.order, c.dt > 0 ? "dynamic" : "quasi-static");
  text += "[materials.body]\ndensity = \"1060 kg/m^3\"\nfibre = [0.342, 0, 0.94]\n";
  text += fmt::format("volumetric = {{ law = \"simo\", bulk_modulus = \"{} Pa\" }}\n", c.ratio * mu);
  text += fmt::format("[materials.body.terms]\nbase = {{ law = \"neo_hookean\", mu = \"{} Pa\" }}\n", mu);
  if (c.fibre > 0) text += fmt::format("fibres = {{ law = \"linear_fibre\", stiffness = \"{} Pa\" }}\n", c.fibre * mu);
  text += fmt::format("[boundary.\"z-\"]\nclamp = true\n[solver]\nlinear = \"{}\"\nlinear_tolerance = {}\n", method,
                      tolerance);
  Config config(text, "test");
  Section root = config.root();
  Parts parts;
  Section mesh = root.section("mesh");
  parts.mesh.bind(mesh);
  parts.named = NamedMesh::read(parts.mesh, mesh);
  parts.muscle.bind(root, parts.named);
  config.finish();
  const double k = 2 * M_PI / side;
  for (int vertex = 0; vertex < parts.named.mesh->GetNV(); ++vertex) {
    double* x = parts.named.mesh->GetVertex(vertex);
    const double wave = c.wave * side * std::sin(k * x[0]) * std::sin(k * x[1]) * std::sin(k * x[2]);
    for (int i = 0; i < 3; ++i) x[i] += wave;
  }
  return parts;
}

struct Solution {
  int iterations;
  double residual;  // |b - K x| / |b|
  mfem::Vector x;
};

/// Lengthened and sheared, and swollen by the pressure that holds against fibres and matrix sideways: without it the
/// state is far from any equilibrium, and its tangent indefinite.
mfem::Vector deformed(mfem::ParFiniteElementSpace& space, const Case& c) {
  const double s = c.strain, lateral = 1 / std::sqrt(1 + s);
  const double stretch = std::hypot(lateral * 0.342 + s * 0.94, (1 + s) * 0.94);
  const double of_fibres = c.fibre * stretch * std::max(0.0, stretch - 1);
  const double of_matrix = (2 * lateral * lateral + (1 + s) * (1 + s)) / 3 - lateral * lateral;
  const double size = std::cbrt(1 + (of_fibres / 3 + of_matrix) / c.ratio);  // p = kappa (J - 1), nearly
  return interpolate(space, [=](const mfem::Vector& x, mfem::Vector& u) {
    u.SetSize(3);
    u(0) = size * (lateral * x(0) + s * x(2)) - x(0);
    u(1) = size * lateral * x(1) - x(1);
    u(2) = size * (1 + s) * x(2) - x(2);
  });
}

Solution solve(const Case& c, const std::string& method, int cells) {
  Parts parts = read_cube(c, method, cells);
  const LinearConfig config = parts.muscle.newton.linear;
  Muscle model(std::move(parts.named), std::move(parts.muscle));
  MuscleSystem& system = model.system();
  mfem::Vector u = deformed(system.space(), c);
  mfem::Vector v = u;
  v = 0.0;
  system.step() = {c.dt, c.dt, u, v};
  Solution solution;
  LinearSolver linear(config, system.matrix(), true,
                      [&](double gamma) -> const CellBlocks& { return system.cell_blocks(gamma); });
  system.tangent(u, system.matrix());
  mfem::Vector b(u.Size());
  solution.x = b;
  for (int i = 0; i < b.Size(); ++i) b(i) = i % 3 == 0 ? 1.0 : 0.1;
  for (int dof : system.constraints().dofs()) b(dof) = 0;
  linear.matrix_changed();
  EXPECT_EQ(linear.solve(b, solution.x), "");
  solution.iterations = linear.iterations();
  Vec given, taken, left;
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, b.Size(), PETSC_DECIDE, b.GetData(), &given));
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, b.Size(), PETSC_DECIDE, solution.x.GetData(), &taken));
  check(VecDuplicate(given, &left));
  check(MatMult(system.matrix(), taken, left));
  check(VecAXPY(left, -1, given));
  double norm, norm_b;
  check(VecNorm(left, NORM_2, &norm));
  check(VecNorm(given, NORM_2, &norm_b));
  solution.residual = norm / norm_b;
  for (Vec* vec : {&given, &taken, &left}) check(VecDestroy(vec));
  return solution;
}

/// Every regime: bulk over shear, step, fibres (strained: slack ones have no stiffness), shape of the cells.
std::vector<Case> all_regimes() {
  std::vector<Case> all;
  for (double ratio : {1e2, 1e3, 1e4})
    for (double dt : {0.0, 1e-2, 1e-3, 1e-4})
      for (double fibre : {0.0, 20.0})
        for (auto [aspect, wave] : {std::pair{1.0, 0.0}, {1.0, 0.04}, {5.0, 0.0}})
          all.push_back({ratio, dt, fibre, aspect, wave, fibre > 0 ? 0.1 : 0.0});
  return all;
}

class BlockIterations : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(AllRegimes, BlockIterations, ::testing::ValuesIn(all_regimes()));

TEST_P(BlockIterations, stay_few) {
  const Case& c = GetParam();
  const Solution solution = solve(c, "block", c.kind == "tensor" && c.order == 2 ? 5 : c.order == 1 ? 4 : 3);
  EXPECT_LE(solution.iterations, wanted) << GetParam();
  EXPECT_LE(solution.residual, 1.01 * tolerance) << GetParam();
  RecordProperty("iterations", solution.iterations);
  if (is_root()) fmt::print("{:3} iterations: {}\n", solution.iterations, fmt::streamed(GetParam()));
}

/// Tetrahedra, wedges, and the other orders of hexahedra, in the corners of the regimes.
std::vector<Case> other_cells() {
  std::vector<Case> all;
  for (auto [kind, order] : {std::pair{"simplices", 1}, {"simplices", 2}, {"wedges", 2}, {"tensor", 1}, {"tensor", 3}})
    for (double ratio : {1e2, 1e4})
      for (double dt : {0.0, 1e-3})
        for (double fibre : {0.0, 20.0}) all.push_back({ratio, dt, fibre, 1, 0.04, fibre > 0 ? 0.1 : 0.0, kind, order});
  return all;
}
INSTANTIATE_TEST_SUITE_P(OtherCells, BlockIterations, ::testing::ValuesIn(other_cells()));

/// Large enough for a coarse level that is not factorised.
TEST(LinearSolvers, take_few_iterations_with_an_iterative_coarse_level) {
  for (const Case& c : {Case{1e3, 1e-3, 0, 1, 0, 0}, Case{1e3, 0, 20, 1, 0, 0.1}})
    EXPECT_LE(solve(c, "block", 10).iterations, wanted) << c;
}

TEST(LinearSolvers, find_the_same_solution) {
  const Case c{1e3, 1e-3, 20, 1, 0.04, 0.1};
  const Solution exact = solve(c, "direct", 4);
  for (const char* method : {"block", "condensed"}) {
    Solution found = solve(c, method, 4);
    found.x -= exact.x;
    EXPECT_LE(std::sqrt(sum(found.x * found.x) / sum(exact.x * exact.x)), 1e-4) << method;
    EXPECT_LE(found.residual, 1.01 * tolerance) << method;
  }
}

TEST(LinearSolvers, take_the_same_newton_iterations) {
  const std::string scene = muscle_material + R"(
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement.x = { time = "0, 0.1 s", value = [0, 0.1], scale = "30 mm" }
displacement.y = "0 mm"
displacement.z = "0 mm"
[solver]
linear = )";
  std::vector<int> newton;
  std::vector<double> force;
  for (const char* method : {"\"direct\"", "\"block\"", "\"condensed\""}) {
    const auto model = make_block(scene + method + "\n");
    newton.push_back(0);
    for (const Step& step : march(*model, 0.1, 0.025)) {
      EXPECT_TRUE(step.ok()) << method << ": " << step.failure;
      newton.back() += step.newton;
    }
    force.push_back(quantity(*model, "reaction_x+_x"));
  }
  EXPECT_EQ(newton[1], newton[0]);
  EXPECT_EQ(newton[2], newton[0]);
  for (double f : force) EXPECT_NEAR(f, force[0], 1e-5 * std::abs(force[0]));
}

/// Quadrilaterals and triangles in plane strain.
TEST(LinearSolvers, serve_plane_bodies) {
  const std::string scene =
      "[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ntraction = \"2, 0.5 kPa\"\n[markers]\nend = \"30, 10 "
      "mm\"\n" +
      soft_material + "[solver]\nlinear = ";
  for (const char* kind : {"tensor", "simplices"}) {
    std::vector<int> newton;
    std::vector<double> motion;
    for (const char* method : {"direct", "block", "condensed"}) {
      const auto model = make_block(scene + "\"" + method + "\"\n", false,
                                    {"mesh.box=\"30, 10 mm\"", "mesh.cells=[9, 3]", std::string("mesh.kind=") + kind});
      newton.push_back(0);
      for (const Step& step : march(*model, 0.1, 0.05)) {
        EXPECT_TRUE(step.ok()) << method << ": " << step.failure;
        EXPECT_LE(step.krylov, wanted * step.newton);
        newton.back() += step.newton;
      }
      motion.push_back(quantity(*model, "marker_end_ux"));
    }
    for (int m : {1, 2}) {
      EXPECT_EQ(newton[m], newton[0]) << kind;
      EXPECT_NEAR(motion[m], motion[0], 1e-5 * std::abs(motion[0])) << kind;
    }
  }
}

}  // namespace
}  // namespace titin
