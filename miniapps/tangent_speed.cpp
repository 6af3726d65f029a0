/// Time of a tangent times a vector, and of making the tangent, on cubes of Q2 hexahedra of muscle. Google Benchmark:
///
///     tangent_speed --benchmark_filter=/12        names are "what/cells along an edge"
///
/// "per_unknown" is seconds of one core for each unknown, "bytes" what an unknown takes. One rank; with PETSc's own
/// products: aij (as PETSc is by default, with inodes), aij_no_inode, baij. action and action_single are
/// fe/tangent_action.hpp. docs/verification/speed.md has a table of it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/parallel.hpp"
#include "fe/muscle.hpp"

namespace titin {
namespace {

constexpr const char scene[] = R"(
[mesh]
box = "30, 30, 30 mm"
cells = [{0}, {0}, {0}]
[boundary."z-"]
clamp = true
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8, 0, 0.6]
volumetric = {{ law = "simo", bulk_modulus = "10 MPa" }}
[materials.muscle.terms]
base = {{ law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }}
passive = {{ law = "hill_passive", peak_stress = "200 kPa" }}
active = {{ law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.5 }}
)";

std::unique_ptr<Muscle> make_cube(int cells) {
  Config config(fmt::format(scene, cells), "cube");
  Section root = config.root();
  MeshConfig mesh_config;
  MuscleConfig muscle;
  Section mesh = root.section("mesh");
  mesh_config.bind(mesh);
  NamedMesh named = NamedMesh::read(mesh_config, mesh);
  muscle.bind(root, named);
  config.finish();
  return std::make_unique<Muscle>(std::move(named), std::move(muscle));
}

/// A cube in the middle of a step, one size at a time.
struct Cube {
  std::unique_ptr<Muscle> model;
  mfem::Vector u;

  explicit Cube(int cells) : model(make_cube(cells)), u(model->system().size()) {
    for (int i = 0; i < u.Size(); ++i) u(i) = 1e-6 * std::sin(i);
    mfem::Vector rest(u.Size());
    rest = 0.0;
    model->system().step() = {0.001, 0.001, rest, rest};
  }
  static std::unique_ptr<Cube>& held() {
    static std::unique_ptr<Cube> cube;
    return cube;
  }
  static Cube& of(int cells) {
    static int size = 0;
    if (size != cells) {
      held().reset();
      held() = std::make_unique<Cube>(cells);
      held()->model->system().tangent(held()->u, nullptr);
      size = cells;
    }
    return *held();
  }
  MuscleSystem& system() { return model->system(); }
};

void report(benchmark::State& state, Cube& cube, double bytes) {
  const auto unknowns = static_cast<double>(cube.model->unknowns());
  state.counters["per_unknown"] =
      benchmark::Counter(unknowns, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["bytes"] = bytes / unknowns;
  state.counters["unknowns"] = unknowns;
}

/// Of values and column numbers; rows in blocks keep one column number for each.
double memory(Mat K, double entries_per_column_number = 1) {
  MatInfo info;
  check(MatGetInfo(K, MAT_GLOBAL_SUM, &info));
  return info.nz_used * (sizeof(PetscScalar) + sizeof(PetscInt) / entries_per_column_number);
}

void multiply(benchmark::State& state, Cube& cube, Mat K, double bytes) {
  Vec x, y;
  check(MatCreateVecs(cube.system().matrix(), &x, &y));
  check(VecSet(x, 1));
  for (auto _ : state) check(MatMult(K, x, y));
  report(state, cube, bytes);
  check(VecDestroy(&x));
  check(VecDestroy(&y));
}

void multiply_assembled(benchmark::State& state, const char* type, bool inodes) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  Mat K;
  check(MatConvert(cube.system().matrix(), type, MAT_INITIAL_MATRIX, &K));
  if (!inodes) check(MatSetOption(K, MAT_USE_INODES, PETSC_FALSE));
  multiply(state, cube, K, memory(K, std::string(type) == MATSEQBAIJ ? 9 : 1));
  check(MatDestroy(&K));
}

void multiply_action(benchmark::State& state, Precision precision) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  const auto action = cube.system().make_action(precision);
  cube.system().set_action(cube.u, *action);
  Mat K = action->shell(cube.system().space());
  multiply(state, cube, K, static_cast<double>(action->bytes()));
  check(MatDestroy(&K));
}

void make_tangent(benchmark::State& state) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  for (auto _ : state) cube.system().tangent(cube.u, nullptr);
  const double kept = static_cast<double>(cube.system().assembly().bytes());
  report(state, cube, memory(cube.system().matrix()) + kept);
}

void make_action(benchmark::State& state) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  const auto action = cube.system().make_action(Precision::full);
  for (auto _ : state) cube.system().set_action(cube.u, *action);
  report(state, cube, static_cast<double>(action->bytes()));
}

void insert(benchmark::State& state) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  Assembly& assembly = cube.system().assembly();
  const int n = cube.system().tables().values(0);
  const std::vector<double> K(n * n, 1.0);
  for (auto _ : state) {
    assembly.begin();
    for (int cell = 0; cell < cube.system().space().GetNE(); ++cell) assembly.add(cell, K.data());
    assembly.end();
  }
  report(state, cube, static_cast<double>(assembly.bytes()));
  cube.system().tangent(cube.u, nullptr);
}

void residual(benchmark::State& state) {
  Cube& cube = Cube::of(static_cast<int>(state.range(0)));
  mfem::Vector R(cube.u.Size());
  for (auto _ : state) cube.system().residual(cube.u, R);
  report(state, cube, 0);
}

void register_all() {
  const auto add = [](const char* name, auto work) {
    benchmark::RegisterBenchmark(name, work)->Arg(6)->Arg(12)->Arg(20)->Unit(benchmark::kMillisecond);
  };
  add("aij", [](auto& state) { multiply_assembled(state, MATSEQAIJ, true); });
  add("aij_no_inode", [](auto& state) { multiply_assembled(state, MATSEQAIJ, false); });
  add("baij", [](auto& state) { multiply_assembled(state, MATSEQBAIJ, true); });
  add("action", [](auto& state) { multiply_action(state, Precision::full); });
  add("action_single", [](auto& state) { multiply_action(state, Precision::single); });
  add("make_tangent", make_tangent);
  add("make_action", make_action);
  add("insert", insert);
  add("residual", residual);
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  const titin::MpiSession mpi(argc, argv);
  const titin::PetscSession petsc;
  benchmark::Initialize(&argc, argv);
  titin::register_all();
  benchmark::RunSpecifiedBenchmarks();
  titin::Cube::held().reset();  // before PETSc goes
}
