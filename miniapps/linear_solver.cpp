/// One linear solve with a tangent of the muscle formulation, timed: the rows of docs/verification/solvers.md
/// (scripts/solver_table.py). Prints one line of JSON.
#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "fe/muscle.hpp"
#include "solve/linear.hpp"
#include "solve/petsc.hpp"

namespace titin {
namespace {

constexpr double side = 0.03, mu = 1e4;  // [m], [Pa]
constexpr double fibre[] = {0.3420201433256687, 0, 0.9396926207859084};

struct Case {
  int cells = 8;
  double ratio = 1e3, dt = 0, fibre = 0, aspect = 1, distort = 0, strain = 0, tolerance = 1e-6;
  std::string method = "block";
};

Case read_case(int argc, char** argv) {
  Case c;
  CLI::App app{"One linear solve with a tangent of the muscle formulation.", "linear_solver"};
  app.add_option("--cells", c.cells, "along an edge");
  app.add_option("--ratio", c.ratio, "bulk over shear modulus");
  app.add_option("--dt", c.dt, "time step [s]; 0: quasi-static");
  app.add_option("--fibre", c.fibre, "stiffness of fibres over the shear modulus");
  app.add_option("--aspect", c.aspect, "height over width of the block and of its cells");
  app.add_option("--distort", c.distort, "amplitude of a wave through the mesh, over the edge of the block");
  app.add_option("--strain", c.strain, "of the state whose tangent it is");
  app.add_option("--tolerance", c.tolerance, "relative residual of forces");
  app.add_option("--method", c.method, "direct, block or condensed");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return c;
}

std::string scene(const Case& c) {
  std::string text = fmt::format(
      R"([mesh]
box = "{0} m, {0} m, {1} m"
cells = [{2}, {2}, {2}]
[muscle]
inertia = "{3}"
[materials.body]
density = "1060 kg/m^3"
fibre = [{6}, {7}, {8}]
volumetric = {{ law = "simo", bulk_modulus = "{4} Pa" }}
[materials.body.terms]
base = {{ law = "neo_hookean", mu = "{5} Pa" }}
)",
      side, side * c.aspect, c.cells, c.dt > 0 ? "dynamic" : "quasi-static", c.ratio * mu, mu, fibre[0], fibre[1],
      fibre[2]);
  if (c.fibre > 0) text += fmt::format("fibres = {{ law = \"linear_fibre\", stiffness = \"{} Pa\" }}\n", c.fibre * mu);
  return text + fmt::format("[boundary.\"z-\"]\nclamp = true\n[solver]\nlinear = \"{}\"\nlinear_tolerance = {}\n",
                            c.method, c.tolerance);
}

std::size_t rss_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * 4096;
}

void distort(mfem::Mesh& mesh, double amplitude) {
  const double k = 2 * M_PI / side;
  for (int vertex = 0; vertex < mesh.GetNV(); ++vertex) {
    double* x = mesh.GetVertex(vertex);
    const double wave = amplitude * side * std::sin(k * x[0]) * std::sin(k * x[1]) * std::sin(k * x[2]);
    for (int i = 0; i < 3; ++i) x[i] += wave;
  }
}

/// Lengthened and sheared, and swollen by the pressure that holds against fibres and matrix sideways: without it the
/// state would be far from any equilibrium, and its tangent indefinite.
mfem::Vector deformed(mfem::ParFiniteElementSpace& space, const Case& c) {
  const double s = c.strain, lateral = 1 / std::sqrt(1 + s);
  const double stretch = std::hypot(lateral * fibre[0] + s * fibre[2], (1 + s) * fibre[2]);
  const double of_fibres = c.fibre * stretch * std::max(0.0, stretch - 1);
  const double of_matrix = (2 * lateral * lateral + (1 + s) * (1 + s)) / 3 - lateral * lateral;
  const double size = std::cbrt(1 + (of_fibres / 3 + of_matrix) / c.ratio);  // p = kappa (J - 1), nearly
  mfem::VectorFunctionCoefficient motion(3, [&](const mfem::Vector& x, mfem::Vector& u) {
    u.SetSize(3);
    u(0) = size * (lateral * x(0) + s * x(2)) - x(0);
    u(1) = size * lateral * x(1) - x(1);
    u(2) = size * (1 + s) * x(2) - x(2);
  });
  mfem::ParGridFunction field(&space);
  field.ProjectCoefficient(motion);
  mfem::Vector u(space.GetTrueVSize());
  field.GetTrueDofs(u);
  return u;
}

nlohmann::json solve(const Case& c) {
  Config text(scene(c), "linear_solver");
  Section root = text.root();
  MeshConfig mesh_config;
  Section mesh_section = root.section("mesh");
  mesh_config.bind(mesh_section);
  NamedMesh mesh = NamedMesh::read(mesh_config, mesh_section);
  MuscleConfig config;
  config.bind(root, mesh);
  text.finish();
  if (c.distort > 0) distort(*mesh.mesh, c.distort);
  const LinearConfig linear_config = config.newton.linear;
  Muscle model(std::move(mesh), std::move(config));
  MuscleSystem& system = model.system();
  mfem::Vector u = deformed(system.space(), c), v(u.Size()), x(u.Size()), b(u.Size()), left(u.Size());
  v = 0.0;
  system.step() = {c.dt, c.dt, u, v};
  // a pull sideways of all nodes, in proportion to their share of the mesh
  x = 0.0;
  for (int i = 0; i < b.Size(); ++i) b(i) = i % 3 == 0 ? 1.0 : 0.1;
  for (int dof : system.constraints().dofs()) b(dof) = 0;

  if (!system.residual(u, left)) return {{"failure", system.domain_error()}};
  const std::size_t before = rss_bytes();
  system.tangent(u, system.matrix());
  const double assembled = cpu_seconds();
  const std::size_t with_matrix = rss_bytes();
  const auto cells = [&system](double gamma) -> const CellBlocks& { return system.cell_blocks(gamma); };
  LinearSolver linear(linear_config, system.matrix(), true, cells);
  if (linear.block()) system.tangent(u, system.matrix());
  const double start = cpu_seconds();
  linear.matrix_changed();
  check(KSPSetUp(linear.ksp()));
  const double ready = cpu_seconds();
  const std::string failure = linear.solve(b, x);
  const double solved = cpu_seconds();
  const auto n = static_cast<double>(model.unknowns());
  nlohmann::json row = {{"unknowns", model.unknowns()},
                        {"method", c.method},
                        {"iterations", linear.iterations()},
                        {"failure", failure},
                        {"setup_cpu_seconds", sum(ready - start)},
                        {"solve_cpu_seconds", sum(solved - ready)},
                        {"assembly_cpu_seconds", sum(assembled)},
                        {"solver_bytes_per_unknown", sum(double(rss_bytes() - with_matrix)) / n},
                        {"matrix_bytes_per_unknown", sum(double(with_matrix - before)) / n},
                        {"peak_bytes", sum(double(peak_rss_bytes()))},
                        {"ranks", ranks()}};
  for (const auto& [name, phase] : Timers::phases()) row["phases"][name] = sum(phase.cpu);
  return row;
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  using namespace titin;
  const MpiSession mpi(argc, argv);
  const Case asked = read_case(argc, argv);
  const PetscSession petsc;
  try {
    const nlohmann::json row = solve(asked);
    if (is_root()) fmt::print("{}\n", row.dump());
  } catch (const InputError& error) {
    for (const std::string& message : error.messages()) logging::error(message);
    return 1;
  }
  return 0;
}
