/// Time of a tangent times a vector, and of making the tangent, on cubes of Q2 hexahedra of muscle; and of one cell of
/// any shape and element. Google Benchmark:
///
///     tangent_speed --benchmark_filter=/12                  names are "what/cells along an edge"
///     tangent_speed --benchmark_filter=cell_tangent/wedge   "what/shape/muscle.element/muscle.order"
///
/// "per_unknown" is seconds of one core for each unknown, "bytes" what an unknown takes. One rank; with PETSc's own
/// products: aij (as PETSc is by default, with inodes), aij_no_inode, baij. action and action_single are
/// fe/tangent_action.hpp. cell_residual and cell_tangent are from a cell's displacement to its vector or matrix,
/// material included, inertia and assembly left out, on bodies of 96 to 512 cells. docs/verification/speed.md has
/// tables of it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/parallel.hpp"
#include "fe/cell_matrices.hpp"
#include "fe/muscle.hpp"

namespace titin {
namespace {

/// `mesh` and `muscle` are the lines of these sections of a scene. Collective.
std::unique_ptr<Muscle> make_block(const std::string& mesh, const std::string& muscle) {
  Config config("[mesh]\n" + mesh + "\n[muscle]\n" + muscle + R"(
[boundary."x-"]
clamp = true
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8, 0, 0.6]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
[materials.muscle.terms]
base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
passive = { law = "hill_passive", peak_stress = "200 kPa" }
active = { law = "hill_active", peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.5 }
)",
                "block");
  Section root = config.root();
  MeshConfig mesh_config;
  MuscleConfig muscle_config;
  Section section = root.section("mesh");
  mesh_config.bind(section);
  NamedMesh named = NamedMesh::read(mesh_config, section);
  muscle_config.bind(root, named);
  config.finish();
  return std::make_unique<Muscle>(std::move(named), std::move(muscle_config));
}

/// Begins a step of 1 ms from rest. Returns a displacement in it: small, of every true dof [m].
mfem::Vector begin_step(Muscle& model) {
  mfem::Vector u(model.displacement().Size()), rest(u.Size());
  for (int i = 0; i < u.Size(); ++i) u(i) = 1e-6 * std::sin(i);
  rest = 0.0;
  model.system().step() = {0.001, 0.001, rest, rest};
  return u;
}

/// A cube in the middle of a step, one size at a time.
struct Cube {
  std::unique_ptr<Muscle> model;
  mfem::Vector u;

  explicit Cube(int cells)
      : model(make_block(fmt::format("box = \"30, 30, 30 mm\"\ncells = [{0}, {0}, {0}]", cells), "")),
        u(begin_step(*model)) {}
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

// ---- one cell

struct Shape {
  const char *name, *mesh;
  std::vector<int> three_field, displacement;  // orders
};

const Shape shapes[] = {
    {"triangle", "box = \"30, 30 mm\"\ncells = [16, 16]\nkind = \"simplices\"", {1, 2}, {1, 2, 3}},
    {"quadrilateral", "box = \"30, 30 mm\"\ncells = [16, 16]", {1, 2, 3}, {1, 2, 3}},
    {"tetrahedron", "box = \"30, 30, 30 mm\"\ncells = [4, 4, 4]\nkind = \"simplices\"", {1, 2}, {1, 2, 3}},
    {"wedge", "box = \"30, 30, 30 mm\"\ncells = [4, 4, 4]\nkind = \"wedges\"", {2}, {1, 2, 3}},
    {"hexahedron", "box = \"30, 30, 30 mm\"\ncells = [6, 4, 4]", {1, 2, 3}, {1, 2, 3}},
};

/// A body of one element in the middle of a step, to be taken cell by cell.
struct Body {
  std::unique_ptr<Muscle> model;
  MuscleSystem& system;
  const CellTables& tables;
  ThreeField kernel;
  std::vector<double> u, rest;  // [m] of all cells, cell by cell

  Body(const char* mesh, const std::string& muscle)
      : model(make_block(mesh, muscle)), system(model->system()), tables(system.tables()), kernel(tables) {
    u = system.cell_values(begin_step(*model));
    rest.assign(u.size(), 0.0);
  }
  bool deform(int cell) {
    const int first = system.first_value(cell);
    return kernel.deform(cell, system.material(cell), &u[first], &rest[first]);
  }
};

void cell_residual(benchmark::State& state, Body& body) {
  std::vector<double> r;
  for (auto _ : state)
    for (int cell = 0; cell < body.tables.cells(); ++cell) {
      r.assign(body.tables.values(cell), 0.0);
      if (!body.deform(cell)) return state.SkipWithError("a cell is inside out");
      body.kernel.add_forces(cell, body.system.material(cell), body.system.point_input(cell), r.data());
      benchmark::DoNotOptimize(r.data());
    }
}

/// Several hexahedra at once.
void cell_tangents_together(benchmark::State& state, Body& body, CellMatrices& matrices) {
  const int cells = body.tables.cells(), most = matrices.cells_at_once();
  const auto at = [&](int cell) {
    body.deform(cell);
    return body.kernel.tangent_points(cell, body.system.material(cell), body.system.point_input(cell), 0);
  };
  for (auto _ : state)
    for (int first = 0; first < cells; first += most) {
      matrices.form(first, std::min(most, cells - first), at);
      benchmark::DoNotOptimize(matrices.matrix(0));
    }
}

/// By the kernel that the system takes (fe/muscle_tangent.cpp).
void cell_tangent(benchmark::State& state, Body& body) {
  const bool symmetric = body.system.material(0).symmetric_tangent(body.system.config().varying_rate());
  if (const auto matrices = CellMatrices::create(body.system.space(), body.tables, symmetric))
    return cell_tangents_together(state, body, *matrices);
  std::vector<double> K;
  for (auto _ : state)
    for (int cell = 0; cell < body.tables.cells(); ++cell) {
      K.assign(std::size_t(body.tables.values(cell)) * body.tables.values(cell), 0.0);
      body.deform(cell);
      body.kernel.add_tangent(cell, body.system.material(cell), body.system.point_input(cell), K.data());
      benchmark::DoNotOptimize(K.data());
    }
}

void add_cells(const char* what, void (*work)(benchmark::State&, Body&), const Shape& shape, const char* element,
               int order) {
  const std::string muscle = fmt::format("element = \"{}\"\norder = {}", element, order);
  const auto run = [=, &shape](benchmark::State& state) {
    Body body(shape.mesh, muscle);
    work(state, body);
    using benchmark::Counter;
    const int cells = body.tables.cells(), points = body.tables.points(0);
    const auto each = [](double n) { return Counter(n, Counter::kIsIterationInvariantRate | Counter::kInvert); };
    state.counters["per_cell"] = each(cells);
    state.counters["per_point"] = each(double(cells) * points);
    state.counters["points"] = points;
    state.counters["values"] = body.tables.values(0);
  };
  const std::string name = fmt::format("{}/{}/{}/{}", what, shape.name, element, order);
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
}

void add_all_cells(const char* what, void (*work)(benchmark::State&, Body&)) {
  for (const Shape& shape : shapes) {
    for (const int order : shape.three_field) add_cells(what, work, shape, "three_field", order);
    for (const int order : shape.displacement) add_cells(what, work, shape, "displacement", order);
  }
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
  add_all_cells("cell_residual", cell_residual);
  add_all_cells("cell_tangent", cell_tangent);
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
