/// Time of the parts of an explicit finite-volume step, and of the whole, on squares of triangles and cubes of
/// tetrahedra of gas and of rubber. Google Benchmark:
///
///     flow_speed --benchmark_filter=nodal        names are "what/material_dimension/boxes along an edge"
///
/// "per_cell" is seconds of one core for each cell. One rank, walls all around. gather and slopes are
/// fv/reconstruct.hpp, predict is fv/predictor.hpp, stress is stress, wave speed and stored energy of fv/closure.hpp,
/// impedances and nodal are fv/nodal_solver.hpp; step is all of them with MOOD, update and judgement (fv/scheme.hpp).
/// docs/verification/speed.md has a table of it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <any>
#include <cmath>
#include <mfem.hpp>
#include <numbers>

#include "base/parallel.hpp"
#include "fv/scheme.hpp"

namespace titin {
namespace {

constexpr const char gas[] = "law = \"perfect_gas\"\ngamma = 1.4\n";
constexpr const char rubber[] = R"(density = "1100 kg/m^3"
volumetric = { law = "quad_log", bulk_modulus = "57 MPa" }
terms.base = { law = "neo_hookean", mu = "5.9 MPa" })";

std::unique_ptr<Closure> make(bool solid) {
  Config text(solid ? rubber : gas, "flow_speed");
  auto closure = solid ? make_closure(Material::read(text.root())) : make_closure(Fluid::read(text.root()));
  text.finish();
  return closure;
}

template <int D>
mfem::ParMesh unit_box(int n) {
  mfem::Mesh serial = D == 2 ? mfem::Mesh::MakeCartesian2D(n, n, mfem::Element::TRIANGLE, true)
                             : mfem::Mesh::MakeCartesian3D(n, n, n, mfem::Element::TETRAHEDRON);
  return mfem::ParMesh(MPI_COMM_WORLD, serial);
}

template <int D>
std::vector<BoundaryCondition<D>> walls() {
  static const Table at_rest{0.0};
  BoundaryCondition<D> wall;
  wall.name = "wall";
  for (int side = 1; side <= 2 * D; ++side) wall.attributes.push_back(side);
  wall.normal_velocity = &at_rest;
  wall.mirrors = true;
  return {wall};
}

/// A body that moves smoothly, at a tenth of its speed of sound or less, after a few steps.
template <int D>
struct Body {
  std::unique_ptr<Closure> closure;
  mfem::ParMesh parallel;
  SimplexMesh<D> mesh;
  NodeExchange exchange;
  Boundary<D> boundary;
  FlowScheme<D> scheme;

  Body(bool solid, int n)
      : closure(make(solid)),
        parallel(unit_box<D>(n)),
        mesh(parallel),
        exchange(parallel, mesh),
        boundary(mesh, exchange, walls<D>()),
        scheme(mesh, exchange, FvConfig{}, walls<D>(), start(solid)) {
    for (int step = 0; step < 5; ++step) {
      const double dt = scheme.largest_dt();
      if (scheme.advance(0, dt).empty()) scheme.accept(dt);
    }
  }
  std::vector<CellStart> start(bool solid) const {
    std::vector<CellStart> cells(mesh.cells());
    const double density = solid ? 1100 : 1, speed = solid ? 10 : 0.1;  // of 240 m/s, and of 1.2 m/s
    for (int c = 0; c < mesh.cells(); ++c) {
      const Vector<D> x = centroid<D>(mesh.corners_of(c, mesh.x));
      cells[c] = {closure.get(), density, closure->energy_at(density, 1), {}};
      for (int i = 0; i < D; ++i) cells[c].velocity[i] = speed * std::sin(std::numbers::pi * x[i]);
    }
    return cells;
  }
  static Body& of(bool solid, int n);
};

/// One at a time.
std::any held;

template <int D>
Body<D>& Body<D>::of(bool solid, int n) {
  using Key = std::pair<bool, int>;
  using Kept = std::pair<Key, std::shared_ptr<Body>>;
  if (const auto* kept = std::any_cast<Kept>(&held); kept && kept->first == Key(solid, n)) return *kept->second;
  held.reset();
  held = Kept(Key(solid, n), std::make_shared<Body>(solid, n));
  return *std::any_cast<Kept>(&held)->second;
}

template <int D>
void gather(benchmark::State& state, Body<D>& body) {
  Reconstruction<D> reconstruction(body.mesh, body.exchange, body.boundary.mirrors());
  for (auto _ : state) reconstruction.gather(body.scheme.state());
}

template <int D>
void slopes(benchmark::State& state, Body<D>& body) {
  Reconstruction<D> reconstruction(body.mesh, body.exchange, body.boundary.mirrors());
  reconstruction.gather(body.scheme.state());
  for (auto _ : state)
    for (int c = 0; c < body.mesh.cells(); ++c) {
      Slopes<D> g = reconstruction.slopes(c, body.scheme.state());
      benchmark::DoNotOptimize(g);
    }
}

/// The first blocks of the body over and over, as they would be loaded.
template <int D>
void predict_blocks(benchmark::State& state, Body<D>& body) {
  const FlowState<D>& now = body.scheme.state();
  PredictedBlock<D> first;
  first.n = cells_per_block;
  for (int b = 0; b < first.n; ++b) {
    for (auto& g : first.g[b]) g.fill(0.1);
    store_registers<D>(now.cell[b].packed(), first.q[b]);
    first.density[b] = now.cell[b].density, first.energy[b] = now.internal_energy(b), first.shift[b] = 0;
    first.F[b] = body.closure->is_solid() ? body.scheme.deformation(b, now) : identity;
  }
  const double dt = body.scheme.largest_dt();
  for (auto _ : state)
    for (int c = 0; c < body.mesh.cells(); c += cells_per_block) {
      PredictedBlock<D> block = first;
      predict<D>(Predictor::hancock, *body.closure, 0, dt, block);
      benchmark::DoNotOptimize(block);
    }
}

template <int D>
void stress(benchmark::State& state, Body<D>& body) {
  const FlowState<D>& now = body.scheme.state();
  const int n = body.mesh.cells();
  std::vector<Mat3> F(n);
  std::vector<double> density(n), energy(n), speed(n), psi(n);
  std::vector<Sym3> T(n);
  std::vector<WaveMemory> waves(n);
  for (int c = 0; c < n; ++c) {
    F[c] = body.scheme.deformation(c, now);
    density[c] = now.cell[c].density, energy[c] = now.internal_energy(c);
  }
  double* stored = body.closure->is_solid() ? psi.data() : nullptr;
  const auto all = [&](std::span<const int> run, const Closure& closure) {
    const int c = run.front(), size = static_cast<int>(run.size());
    closure.stress_and_speed({size, &F[c], &density[c], &energy[c], run.data(), 0}, waves.data(), &T[c], &speed[c],
                             stored ? stored + c : nullptr);
  };
  body.scheme.for_blocks(body.scheme.all_cells(), all);  // a wave's speed is sought once, as in a run
  for (auto _ : state) body.scheme.for_blocks(body.scheme.all_cells(), all);
}

template <int D>
void fill_corners(Body<D>& body, NodalSolver<D>& nodes) {
  const FlowState<D>& now = body.scheme.state();
  for (int c = 0; c < body.mesh.cells(); ++c) {
    const Corners<D> normals = corner_normals<D>(body.mesh.corners_of(c, now.x));
    const auto M = corner_impedances<D>(normals, now.cell[c].density * now.speed[c]);
    const auto& q = now.cell[c].q;
    for (int p = 0; p <= D; ++p)
      nodes.corners(c)[p] = {M[p],
                             difference(product<D>(M[p], velocity_of<D>(q)), product<D>(stress_of<D>(q), normals[p]))};
  }
}

template <int D>
void impedances(benchmark::State& state, Body<D>& body) {
  NodalSolver<D> nodes(body.mesh, body.exchange, body.boundary);
  for (auto _ : state) fill_corners(body, nodes);
}

template <int D>
void nodal(benchmark::State& state, Body<D>& body) {
  NodalSolver<D> nodes(body.mesh, body.exchange, body.boundary);
  const FlowState<D>& now = body.scheme.state();
  body.boundary.prepare(0, body.scheme.largest_dt(), now.x);
  fill_corners(body, nodes);
  std::vector<Vector<D>> v(now.v);
  for (auto _ : state) nodes.solve(now.x, v);
}

/// The same step each time: it is tried, not accepted.
template <int D>
void step(benchmark::State& state, Body<D>& body) {
  for (auto _ : state)
    if (const std::string failure = body.scheme.advance(0, body.scheme.largest_dt()); !failure.empty())
      return state.SkipWithError(failure.c_str());
}

template <int D>
void add(const std::string& what, void (*work)(benchmark::State&, Body<D>&), const std::vector<long>& boxes) {
  for (const bool solid : {false, true}) {
    const std::string name = fmt::format("{}/{}_{}", what, solid ? "rubber" : "gas", D);
    const auto run = [=](benchmark::State& state) {
      Body<D>& body = Body<D>::of(solid, static_cast<int>(state.range(0)));
      work(state, body);
      using benchmark::Counter;
      state.counters["per_cell"] = Counter(body.mesh.cells(), Counter::kIsIterationInvariantRate | Counter::kInvert);
    };
    auto* registered = benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
    for (const long n : boxes) registered->Arg(n);
  }
}

template <int D>
void add_all(const std::vector<long>& boxes) {
  add<D>("gather", gather<D>, boxes);
  add<D>("slopes", slopes<D>, boxes);
  add<D>("predict", predict_blocks<D>, boxes);
  add<D>("stress", stress<D>, boxes);
  add<D>("impedances", impedances<D>, boxes);
  add<D>("nodal", nodal<D>, boxes);
  add<D>("step", step<D>, boxes);
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  const titin::MpiSession mpi(argc, argv);
  benchmark::Initialize(&argc, argv);
  titin::add_all<2>({64, 256});  // 8192 and 131 072 cells
  titin::add_all<3>({11, 28});   // 7986 and 131 712
  benchmark::RunSpecifiedBenchmarks();
  titin::held.reset();  // before MPI goes
}
