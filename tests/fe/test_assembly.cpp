// The matrix of the run holds the sum of the cell matrices, whoever owns their rows, and keeps its pattern.
#include <gtest/gtest.h>

#include "base/parallel.hpp"
#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double round_off = 1e-14;  // relative to the largest entry: a few additions in another order

void deformation(const mfem::Vector& x, mfem::Vector& u) {
  u.SetSize(3);
  u(0) = 0.05 * x(0) + 4 * x(1) * x(2);
  u(1) = -0.03 * x(1);
  u(2) = 0.02 * x(0) - 5 * x(1) * x(1);
}

void add_inertia(MuscleSystem& system, const ThreeField& kernel, int cell, std::vector<double>& K) {
  const int nodes = system.tables().nodes(0);
  const double dt = system.step().dt;
  std::vector<double> M(nodes * nodes);
  kernel.add_mass(cell, system.material(cell).density() / (dt * dt), M.data());
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) K[((i * nodes + a) * 3 + i) * nodes + b] += M[a * nodes + b];
}

/// The same sum by PETSc's own insertion, which searches and communicates by itself.
Mat sum_of_cell_matrices(MuscleSystem& system, const mfem::Vector& u) {
  auto& space = system.space();
  Mat K;
  check(MatCreateAIJ(PETSC_COMM_WORLD, system.size(), system.size(), PETSC_DETERMINE, PETSC_DETERMINE, 400, nullptr,
                     400, nullptr, &K));
  check(MatSetOption(K, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  ThreeField kernel(system.tables());
  mfem::Array<int> dofs;
  const int n = system.tables().values(0);
  const std::vector<double> u_cells = system.cell_values(u), old_cells = system.cell_values(system.step().u_old);
  for (int cell = 0; cell < space.GetNE(); ++cell) {
    std::vector<double> values(n * n);
    kernel.deform(cell, system.material(cell), &u_cells[cell * n], &old_cells[cell * n]);
    kernel.add_tangent(cell, system.material(cell), system.point_input(cell), values.data());
    if (system.config().inertia == Inertia::dynamic) add_inertia(system, kernel, cell, values);
    space.GetElementVDofs(cell, dofs);
    std::vector<PetscInt> index;
    for (int dof : dofs)
      index.push_back(
          system.constraints().is_constrained_local(dof) ? -1 : static_cast<PetscInt>(space.GetGlobalTDofNumber(dof)));
    check(MatSetValues(K, n, index.data(), n, index.data(), values.data(), ADD_VALUES));
  }
  check(MatAssemblyBegin(K, MAT_FLUSH_ASSEMBLY));
  check(MatAssemblyEnd(K, MAT_FLUSH_ASSEMBLY));
  const auto first = static_cast<PetscInt>(space.GetMyTDofOffset());
  for (int dof : system.constraints().dofs()) check(MatSetValue(K, first + dof, first + dof, 1, ADD_VALUES));
  check(MatAssemblyBegin(K, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(K, MAT_FINAL_ASSEMBLY));
  return K;
}

double norm_of(Mat K) {
  PetscReal norm;
  check(MatNorm(K, NORM_INFINITY, &norm));
  return norm;
}

/// One end held, on the other only two components: rows with and without constrained parts.
const std::string scene = "[muscle]\ninertia = \"quasi-static\"\n[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\n" +
                          std::string("displacement.y = \"0 mm\"\ndisplacement.z = \"1 mm\"\n") + muscle_material;

class Assembled : public testing::TestWithParam<Overrides> {};

TEST_P(Assembled, IsTheSumOfTheCellMatrices) {
  const auto model = make_block(scene, true, GetParam());
  MuscleSystem& system = model->system();
  const mfem::Vector u = interpolate(system.space(), deformation);
  mfem::Vector rest(u.Size());
  rest = 0.0;
  system.step() = {0.01, 0.01, rest, rest};
  system.tangent(u, system.matrix());
  system.tangent(u, system.matrix());  // nothing of the first is left
  Mat difference = sum_of_cell_matrices(system, u);
  const double size = norm_of(difference);
  check(MatAXPY(difference, -1, system.matrix(), DIFFERENT_NONZERO_PATTERN));
  EXPECT_LT(norm_of(difference), round_off * size);
  MatDestroy(&difference);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Assembled,
                         testing::Values(Overrides{}, Overrides{"mesh.cells=[3, 1, 2]"},
                                         Overrides{"mesh.cells=[3, 2, 2]", "muscle.order=1"},
                                         Overrides{"mesh.cells=[2, 1, 2]", "muscle.order=3"},
                                         Overrides{"muscle.quadrature=6"},
                                         Overrides{"muscle.inertia=dynamic", "muscle.fibre_rate=velocity_gradient"},
                                         Overrides{"muscle.quadrature=5"}));

TEST(Assembly, KeepsMatrixAndPatternThroughARun) {
  const auto model = make_block(
      "[boundary.\"x-\"]\nclamp = true\n[boundary.\"x+\"]\ndisplacement.x = { time = "
      "\"0, 0.1 s\", value = [0, 1], scale = \"2 mm\" }\n" +
      muscle_material);
  MuscleSystem& system = model->system();
  const Mat before = system.matrix();
  PetscObjectState pattern, now;
  check(MatGetNonzeroState(before, &pattern));
  MatInfo info;
  for (const Step& step : march(*model, 0.05, 0.01)) EXPECT_TRUE(step.ok()) << step.failure;
  check(MatGetNonzeroState(system.matrix(), &now));
  EXPECT_EQ(system.matrix(), before);
  EXPECT_EQ(now, pattern);
  check(MatGetInfo(before, MAT_GLOBAL_SUM, &info));
  EXPECT_EQ(info.mallocs, 0);
  EXPECT_EQ(info.nz_unneeded, 0);
}

TEST(Assembly, NeedsLittleMemoryBesidesTheMatrix) {
  constexpr double bytes_per_unknown = 130;  // 24 unknowns and 27^2 pairs of two bytes a cell inside; more at surfaces
  const auto model = make_block(scene, false, {"mesh.cells=[8, 4, 4]"});
  Assembly& assembly = model->system().assembly();
  const double unknowns = static_cast<double>(model->unknowns());
  MatInfo info;
  check(MatGetInfo(assembly.matrix(), MAT_GLOBAL_SUM, &info));
  const double all = sum(static_cast<double>(assembly.bytes()));
  if (is_root())
    std::printf("assembly: %.0f bytes an unknown besides the matrix, %.0f entries\n", all / unknowns,
                info.nz_used / unknowns);
  EXPECT_LT(all / unknowns, bytes_per_unknown * (ranks() == 1 ? 1 : 2));
}

struct ActionCase {
  const char* name;
  Overrides set;
};

class Action : public testing::TestWithParam<ActionCase> {
 protected:
  /// Largest relative difference of the action and the assembled matrix, over some vectors.
  static double difference(Precision precision) {
    const auto model = make_block(scene, true, GetParam().set);
    MuscleSystem& system = model->system();
    const mfem::Vector u = interpolate(system.space(), deformation);
    mfem::Vector old = u;
    old *= 0.5;
    system.step() = {0.05, 0.01, old, old};
    system.tangent(u, system.matrix());
    const auto action = system.make_action(precision);
    EXPECT_TRUE(action);
    if (!action) return 1;
    system.set_action(u, *action);
    Mat shell = action->shell(system.space());
    Vec x, assembled, free;
    check(MatCreateVecs(system.matrix(), &x, &assembled));
    check(VecDuplicate(assembled, &free));
    double largest = 0;
    for (int trial = 0; trial < 3; ++trial) {
      check(VecSetRandom(x, nullptr));
      PetscReal size, error;
      check(MatMult(system.matrix(), x, assembled));
      check(MatMult(shell, x, free));
      check(VecNorm(assembled, NORM_INFINITY, &size));
      check(VecAXPY(free, -1, assembled));
      check(VecNorm(free, NORM_INFINITY, &error));
      largest = std::max(largest, error / size);
    }
    for (Vec* v : {&x, &assembled, &free}) check(VecDestroy(v));
    check(MatDestroy(&shell));
    return largest;
  }
};

TEST_P(Action, EqualsTheAssembledMatrix) { EXPECT_LT(difference(Precision::full), 20 * round_off); }

TEST_P(Action, InSinglePrecisionIsAsGoodAsThat) {
  constexpr double single_round_off = 5e-6;  // of 1.2e-7 an operation, some hundreds of which of changing sign meet
  EXPECT_LT(difference(Precision::single), single_round_off);
}

INSTANTIATE_TEST_SUITE_P(Kernels, Action,
                         testing::Values(ActionCase{"order_1", {"mesh.cells=[3, 3, 2]", "muscle.order=1"}},
                                         ActionCase{"order_2", {"mesh.cells=[3, 2, 3]"}},
                                         ActionCase{"order_2_with_5_points", {"muscle.quadrature=5"}},
                                         ActionCase{"order_3", {"mesh.cells=[2, 2, 1]", "muscle.order=3"}},
                                         ActionCase{"dynamic", {"muscle.inertia=dynamic"}},
                                         ActionCase{
                                             "fields",
                                             {"materials.muscle.terms.active.activation=1",
                                              "materials.muscle.terms.active.peak_stress={field=\"" TITIN_TEST_DATA
                                              "/fields/muscle.csv\",column=\"peak_stress\"}"}}),
                         [](const auto& info) { return info.param.name; });

TEST(ActionKernels, AreNotThereForEveryQuadrature) {
  EXPECT_FALSE(make_block(scene, false, {"muscle.quadrature=8"})->system().make_action(Precision::full));
}

}  // namespace
}  // namespace titin
