/// Small meshes of triangles and tetrahedra, whole or distorted, and schemes on them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "base/parallel.hpp"
#include "fv/exact_flow.hpp"
#include "fv/scheme.hpp"

namespace titin::test {

/// Boundaries of MFEM's boxes.
inline const std::vector<int> plane_sides{1, 2, 3, 4}, space_sides{1, 2, 3, 4, 5, 6};
template <int D>
const std::vector<int>& all_sides() {
  return D == 2 ? plane_sides : space_sides;
}

/// The unit square or cube, `n` boxes a side; inner nodes are moved by up to `distortion` of a box, smoothly.
template <int D>
std::unique_ptr<mfem::ParMesh> unit_box(int n, double distortion = 0, double length = 1, int across = 0) {
  const int m = across > 0 ? across : n;
  const double width = length * m / n;
  mfem::Mesh serial = D == 2 ? mfem::Mesh::MakeCartesian2D(n, m, mfem::Element::TRIANGLE, true, length, width)
                             : mfem::Mesh::MakeCartesian3D(n, m, m, mfem::Element::TETRAHEDRON, length, width, width);
  for (int v = 0; v < serial.GetNV(); ++v) {
    double* x = serial.GetVertex(v);
    double inside = distortion * length / n;
    for (int i = 0; i < D; ++i)
      inside *= std::min(1.0, 50 * (x[i] / (i ? width : length)) * (1 - x[i] / (i ? width : length)));
    const double a = 37 * x[0] + 11 * x[1] + (D == 3 ? 23 * x[2] : 0);
    for (int i = 0; i < D; ++i) x[i] += inside * std::sin(a + 2 * i);
  }
  return std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial);
}

/// The unit square of nx by ny boxes, each cut along alternating diagonals, and mapped. Sides: 1 y-, 2 x+, 3 y+, 4 x-.
inline std::unique_ptr<mfem::ParMesh> mapped_grid(int nx, int ny, const std::function<Vector<2>(double, double)>& map) {
  mfem::Mesh serial(2, (nx + 1) * (ny + 1), 2 * nx * ny, 2 * (nx + ny));
  const auto node = [&](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) serial.AddVertex(map(double(i) / nx, double(j) / ny).data());
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if ((i + j) % 2)
        serial.AddTriangle(a, b, c), serial.AddTriangle(a, c, d);
      else
        serial.AddTriangle(a, b, d), serial.AddTriangle(b, c, d);
    }
  for (int i = 0; i < nx; ++i) {
    serial.AddBdrSegment(node(i, 0), node(i + 1, 0), 1);
    serial.AddBdrSegment(node(i, ny), node(i + 1, ny), 3);
  }
  for (int j = 0; j < ny; ++j) {
    serial.AddBdrSegment(node(0, j), node(0, j + 1), 4);
    serial.AddBdrSegment(node(nx, j), node(nx, j + 1), 2);
  }
  serial.FinalizeTopology();
  serial.Finalize();
  return std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial);
}

/// The same with each box cut into four triangles around its centre: no node of a side differs from the next.
inline std::unique_ptr<mfem::ParMesh> crossed_grid(int nx, int ny,
                                                   const std::function<Vector<2>(double, double)>& map) {
  mfem::Mesh serial(2, (nx + 1) * (ny + 1) + nx * ny, 4 * nx * ny, 2 * (nx + ny));
  const auto node = [&](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) serial.AddVertex(map(double(i) / nx, double(j) / ny).data());
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int centre = serial.AddVertex(map((i + 0.5) / nx, (j + 0.5) / ny).data());
      const int corner[] = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      for (int k = 0; k < 4; ++k) serial.AddTriangle(corner[k], corner[(k + 1) % 4], centre);
    }
  for (int i = 0; i < nx; ++i) {
    serial.AddBdrSegment(node(i, 0), node(i + 1, 0), 1);
    serial.AddBdrSegment(node(i, ny), node(i + 1, ny), 3);
  }
  for (int j = 0; j < ny; ++j) {
    serial.AddBdrSegment(node(0, j), node(0, j + 1), 4);
    serial.AddBdrSegment(node(nx, j), node(nx, j + 1), 2);
  }
  serial.FinalizeTopology();
  serial.Finalize();
  return std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial);
}

inline std::shared_ptr<const Fluid> perfect_gas(double gamma) {
  Config text(fmt::format("law = \"perfect_gas\"\ngamma = {}", gamma), "test.toml");
  auto fluid = Fluid::read(text.root());
  text.finish();
  return fluid;
}

/// Neo-Hookean rubber of the benchmarks: E = 17 MPa, nu = 0.45, 1100 kg/m^3.
inline constexpr double rubber_mu = 1.7e7 / 2.9, rubber_kappa = 1.7e7 / 0.3, rubber_density = 1100;
inline std::shared_ptr<const Material> rubber() {
  Config text(fmt::format(R"(density = "1100 kg/m^3"
volumetric = {{ law = "quad_log", bulk_modulus = "{:.17g} Pa" }}
terms.base = {{ law = "neo_hookean", mu = "{:.17g} Pa" }})",
                          rubber_kappa, rubber_mu),
              "test.toml");
  auto material = Material::read(text.root());
  text.finish();
  return material;
}

/// A mesh, a material and a scheme, kept together.
template <int D>
struct Flow {
  using Start = std::function<CellStart(const Vector<D>& centre, const Closure&)>;

  Flow(std::unique_ptr<mfem::ParMesh> parallel, std::unique_ptr<Closure> made_of, const FvConfig& config,
       std::vector<BoundaryCondition<D>> conditions, const Start& start)
      : parallel_mesh(std::move(parallel)),
        closure(std::move(made_of)),
        mesh(*parallel_mesh),
        exchange(*parallel_mesh, mesh) {
    std::vector<CellStart> cells;
    for (int c = 0; c < mesh.cells(); ++c) {
      cells.push_back(start(centroid<D>(mesh.corners_of(c, mesh.x)), *closure));
      cells.back().closure = closure.get();
    }
    scheme = std::make_unique<FlowScheme<D>>(mesh, exchange, config, std::move(conditions), cells);
  }

  /// One step of the largest size, or less; halved when it fails, as the clock does.
  void step(double most = 1e300) {
    double dt = std::min(scheme->largest_dt(), most);
    std::string failure = scheme->advance(t, dt);
    for (int cut = 0; cut < 8 && !failure.empty(); ++cut) failure = scheme->advance(t, dt /= 2);
    ASSERT_EQ(failure, "");
    scheme->accept(dt);
    t += dt;
    last_dt = dt;
    ++steps;
  }
  void run_to(double end) {
    while (t < end * (1 - 1e-12) && !testing::Test::HasFatalFailure()) step(end - t);
  }

  std::unique_ptr<mfem::ParMesh> parallel_mesh;
  std::unique_ptr<Closure> closure;
  SimplexMesh<D> mesh;
  NodeExchange exchange;
  std::unique_ptr<FlowScheme<D>> scheme;
  double t = 0, last_dt = 0;
  int steps = 0;
};

struct Totals {
  double mass = 0, energy = 0;
  std::array<double, 3> momentum{};
};

template <int D>
Totals totals(const FlowScheme<D>& scheme) {
  std::vector<double> x(5);
  for (int c = 0; c < scheme.mesh().cells(); ++c) {
    const double m = scheme.mass(c);
    x[0] += m;
    x[1] += m * scheme.state().energy[c];
    for (int i = 0; i < D; ++i) x[2 + i] += m * scheme.state().cell[c].q[i];
  }
  sum(x);
  return {x[0], x[1], {x[2], x[3], x[4]}};
}

/// Of all conditions over the last step, all ranks: force [N] and power [W].
template <int D>
typename Boundary<D>::Force boundary_force(const FlowScheme<D>& scheme) {
  std::vector<typename Boundary<D>::Force> of(scheme.boundary().conditions().size());
  scheme.boundary().add_forces(scheme.state().v, of);
  std::vector<double> x(D + 1);
  for (const auto& part : of) {
    for (int i = 0; i < D; ++i) x[i] += part.force[i];
    x[D] += part.power;
  }
  sum(x);
  typename Boundary<D>::Force all;
  std::copy_n(x.begin(), D, all.force.begin());
  all.power = x[D];
  return all;
}

template <int D>
Vec3 in_space(const Vector<D>& a) {
  Vec3 b{};
  std::copy(a.begin(), a.end(), b.begin());
  return b;
}

/// Starts a gas from an exact flow.
template <int D>
typename Flow<D>::Start start_from(const ExactFlow& exact) {
  return [&exact](const Vector<D>& x, const Closure& closure) {
    const FlowPoint p = exact.at(in_space<D>(x), 0);
    return CellStart{nullptr, p.density, closure.energy_at(p.density, p.pressure), p.velocity};
  };
}

/// Integral over the body of the error of density and of pressure, all ranks.
struct MeanErrors {
  double density, pressure;
};
template <int D>
MeanErrors mean_errors(const Flow<D>& flow, const ExactFlow& exact) {
  std::vector<double> x(2);
  const auto& state = flow.scheme->state();
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const FlowPoint p = exact.at(in_space<D>(state.cell[c].centre), flow.t);
    x[0] += state.volume[c] * std::abs(state.cell[c].density - p.density);
    x[1] += state.volume[c] * std::abs(-state.cell[c].q[D] - p.pressure);
  }
  sum(x);
  return {x[0], x[1]};
}

/// Integral over the body of the size of the mean, over the cells about each node, of an error in cells; all ranks.
template <int D>
double patch_error(Flow<D>& flow, const std::function<double(int cell)>& error) {
  std::vector<double> patch(flow.mesh.nodes()), whole(1);
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const double part = flow.scheme->state().volume[c] * error(c) / (D + 1);
    for (int node : flow.mesh.nodes_of[c]) patch[node] += part;
  }
  flow.exchange.sum(patch.data(), 1);
  for (int p = 0; p < flow.mesh.nodes(); ++p)
    if (flow.exchange.owns(p)) whole[0] += std::abs(patch[p]);
  sum(whole);
  return whole[0];
}

inline const Table at_rest{0.0};

template <int D>
BoundaryCondition<D> wall(std::vector<int> sides) {
  BoundaryCondition<D> condition;
  condition.name = "wall";
  condition.attributes = std::move(sides);
  condition.normal_velocity = &at_rest;
  condition.mirrors = true;
  return condition;
}

}  // namespace titin::test
