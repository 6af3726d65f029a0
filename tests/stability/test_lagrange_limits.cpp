// Where the explicit Lagrangian scheme ends: steps that are too long, and solids that are nearly incompressible.
//
// Both with a plate [0, 1]^2 of rubber (or a cube of it, alike in z) that swings between slippery walls,
// u = sin(w t) (-sin cos, cos sin)(pi x, pi y), w^2 = 2 pi^2 mu / rho, which keeps volumes: the bulk modulus must not
// matter.
#include <gtest/gtest.h>

#include <cmath>

#include "../fv/flows_for_tests.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double speed = 0.1;  // [m/s] strains below 1e-3
const double frequency = M_PI * std::sqrt(2 * rubber_mu / rubber_density);

std::unique_ptr<Closure> rubber_of(double poisson) {
  Config text(fmt::format(R"(density = "1100 kg/m^3"
volumetric = {{ law = "quad_log", bulk_modulus = "{:.17g} Pa" }}
terms.base = {{ law = "neo_hookean", mu = "{:.17g} Pa" }})",
                          rubber_mu * 2 * (1 + poisson) / (3 * (1 - 2 * poisson)), rubber_mu),
              "test.toml");
  auto material = Material::read(text.root());
  text.finish();
  return make_closure(material);
}

Vec3 shape(const Vec3& x) {
  const double a = M_PI * x[0], b = M_PI * x[1];
  return {-std::sin(a) * std::cos(b), std::cos(a) * std::sin(b), 0};
}

template <int D>
Flow<D> plate(int n, double poisson, const FvConfig& config) {
  return Flow<D>(unit_box<D>(n), rubber_of(poisson), config, {wall<D>(all_sides<D>())},
                 [](const Vector<D>& x, const Closure& closure) {
                   CellStart start{nullptr, rubber_density, closure.energy_at(0, 0), shape(in_space<D>(x))};
                   for (double& v : start.velocity) v *= speed;
                   return start;
                 });
}

/// How much of the swing is in the velocities, 1 at the start; kinetic and stored energy over the energy.
struct Swinging {
  double amplitude, energy;
};
template <int D>
Swinging swinging(const Flow<D>& flow) {
  std::vector<double> x(4);
  const auto& scheme = *flow.scheme;
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const Vec3 e = shape(in_space<D>(centroid<D>(flow.mesh.corners_of(c, flow.mesh.x))));
    const auto v = velocity_of<D>(scheme.state().cell[c].q);
    const Mat3 F = scheme.deformation(c, scheme.state());
    CellBatch in;
    in.n = 1;
    in.F = &F;
    double psi;
    flow.closure->stored(in, &psi);
    x[0] += scheme.mass(c) * dot(e, in_space<D>(v));
    x[1] += scheme.mass(c) * dot(e, e);
    x[2] += scheme.mass(c) * (psi + scheme.stored_shift(c) + 0.5 * dot(v, v));
    x[3] += scheme.mass(c) * scheme.state().energy[c];
  }
  sum(x);
  return {x[0] / x[1] / speed, x[2] / x[3]};
}

/// Does a swing over one period stay bounded? Total energy is kept in any case: an unstable one takes it out of heat.
template <int D>
bool is_stable(int n, FvConfig config, double cfl) {
  config.cfl = cfl;
  Flow<D> flow = plate<D>(n, 0.45, config);
  while (flow.t < 2 * M_PI / frequency) {
    const double dt = flow.scheme->largest_dt();
    if (!flow.scheme->advance(flow.t, dt).empty()) return false;
    flow.scheme->accept(dt);
    flow.t += dt;
    if (!(swinging<D>(flow).energy < 1.01)) return false;
  }
  return true;
}

/// The longest stable step, to 0.05 of the time that the fastest wave takes through the inner ball.
template <int D>
double longest(int n, const FvConfig& config) {
  double cfl = 0.3;
  while (cfl < 1.5 && is_stable<D>(n, config, cfl + 0.05)) cfl += 0.05;
  return cfl;
}

// The default of 0.4 must be well inside, for every predictor.
TEST(LagrangeLimits, LongestStableStep) {
  for (Predictor predictor : {Predictor::hancock, Predictor::ader, Predictor::rk2}) {
    FvConfig config;
    config.predictor = predictor;
    config.limiter = Limiter::none;
    const double plane = longest<2>(8, config), space = longest<3>(4, config);
    fmt::print("predictor {}: stable to cfl {:.2f} in the plane, {:.2f} in space\n", static_cast<int>(predictor), plane,
               space);
    EXPECT_GE(plane, 0.5);
    EXPECT_GE(space, 0.5);
    EXPECT_LT(std::max(plane, space), 1.5) << "there is a limit, and the test sees it";
  }
  FvConfig first;
  first.order = 1;
  fmt::print("order 1: stable to cfl {:.2f} in the plane, {:.2f} in space\n", longest<2>(8, first),
             longest<3>(4, first));
}

struct Locked {
  double quarter,
      lost;  // first time at which the swing stands still over the exact one; part of the energy lost by then
  int steps;
};
template <int D>
Locked lock(int n, double poisson, bool patches) {
  FvConfig config;
  config.patch_pressure = patches;
  Flow<D> flow = plate<D>(n, poisson, config);
  double before = 1, t = 0;
  while (flow.t < 2 * M_PI / frequency && !testing::Test::HasFatalFailure()) {
    t = flow.t;
    flow.step();
    const double now = swinging<D>(flow).amplitude;
    if (now <= 0) {
      t += flow.last_dt * before / (before - now);
      break;
    }
    before = now;
  }
  return {t * frequency / (M_PI / 2), 1 - swinging<D>(flow).energy, flow.steps};
}

TEST(LagrangeLimits, AveragedPressuresUnlockNearlyIncompressibleSolids) {
  for (double poisson : {0.45, 0.49, 0.499}) {
    const Locked cells = lock<2>(12, poisson, false), patches = lock<2>(12, poisson, true);
    fmt::print("plane, nu {}: quarter period {:.4f}, energy lost {:.3f}, {} steps; with patches {:.4f}, {:.3f}, {}\n",
               poisson, cells.quarter, cells.lost, cells.steps, patches.quarter, patches.lost, patches.steps);
    EXPECT_LT(std::abs(patches.quarter - 1), 0.4 * std::abs(cells.quarter - 1));
    EXPECT_LT(patches.lost, 0.35);
  }
  const Locked cells = lock<3>(4, 0.49, false), patches = lock<3>(4, 0.49, true);
  fmt::print("space, nu 0.49: quarter period {:.4f}, energy lost {:.3f}; with patches {:.4f}, {:.3f}\n", cells.quarter,
             cells.lost, patches.quarter, patches.lost);
  EXPECT_LT(std::abs(patches.quarter - 1), 0.7 * std::abs(cells.quarter - 1));
}

}  // namespace
}  // namespace titin
