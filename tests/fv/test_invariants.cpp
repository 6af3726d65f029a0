// What the scheme keeps to round-off, whatever the order, material and boundary.
#include <gtest/gtest.h>

#include <random>

#include "flows_for_tests.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double round_off = 1e-13;

FvConfig scheme(int order, Predictor predictor = Predictor::hancock, Limiter limiter = Limiter::mood) {
  FvConfig config;
  config.order = order;
  config.predictor = predictor;
  config.limiter = limiter;
  config.first_step = 1;
  return config;
}

template <class Dimension>
class Invariants : public testing::Test {
 protected:
  static constexpr int D = Dimension::value;
  static typename Flow<D>::Start gas(std::function<double(const Vector<D>&)> density,
                                     std::function<double(const Vector<D>&)> pressure,
                                     std::function<Vector<3>(const Vector<D>&)> velocity) {
    return [=](const Vector<D>& x, const Closure& closure) {
      return CellStart{nullptr, density(x), closure.energy_at(density(x), pressure(x)), velocity(x)};
    };
  }
  static typename Flow<D>::Start solid(std::function<Vector<3>(const Vector<D>&)> velocity) {
    return [=](const Vector<D>& x, const Closure& closure) {
      return CellStart{nullptr, rubber_density, closure.energy_at(0, 0), velocity(x)};
    };
  }
  static Vector<3> swirl(const Vector<D>& x) {
    const double z = D == 3 ? x[D - 1] : 0.3;
    return {std::sin(3 * x[1] + z), std::cos(2 * x[0]) - z, D == 3 ? std::sin(x[0] * x[1]) : 0};
  }
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Invariants, Dimensions);

TYPED_TEST(Invariants, GasAtRestUnderItsOwnPressureStaysThere) {
  constexpr int D = TypeParam::value;
  const Table pressure{2.5};
  BoundaryCondition<D> outside;
  outside.attributes = all_sides<D>();
  outside.pressure = &pressure;
  for (int order : {1, 2}) {
    Flow<D> flow(unit_box<D>(4, 0.2), make_closure(perfect_gas(1.4)), scheme(order), {outside},
                 this->gas([](auto&) { return 1.3; }, [](auto&) { return 2.5; }, [](auto&) { return Vector<3>{}; }));
    for (int k = 0; k < 5; ++k) flow.step();
    for (int p = 0; p < flow.mesh.nodes(); ++p)
      EXPECT_LT(norm(difference(flow.scheme->state().x[p], flow.mesh.x[p])), round_off);
  }
}

TYPED_TEST(Invariants, BodyWithOneVelocityIsCarriedAlong) {
  constexpr int D = TypeParam::value;
  const Vector<3> velocity{3, -2, D == 3 ? 1.5 : 0};
  for (int order : {1, 2}) {
    Flow<D> flow(unit_box<D>(3, 0.2), make_closure(rubber()), scheme(order), {},
                 this->solid([=](auto&) { return velocity; }));
    for (int k = 0; k < 5; ++k) flow.step();
    for (int p = 0; p < flow.mesh.nodes(); ++p)
      for (int i = 0; i < D; ++i)
        EXPECT_NEAR(flow.scheme->state().x[p][i], flow.mesh.x[p][i] + flow.t * velocity[i], round_off);
    for (int c = 0; c < flow.mesh.cells(); ++c)
      for (int i = 0; i < D; ++i) EXPECT_NEAR(flow.scheme->state().cell[c].q[i], velocity[i], 1e-9);
  }
}

/// Every step of every scheme: mass, momentum and total energy, with what boundaries bring.
template <int D>
void expect_balance(Flow<D>& flow, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Totals before = totals(*flow.scheme);
    flow.step();
    const Totals after = totals(*flow.scheme);
    const auto outside = boundary_force(*flow.scheme);
    EXPECT_EQ(after.mass, before.mass);
    EXPECT_NEAR(after.energy - before.energy, flow.last_dt * outside.power, round_off * std::abs(after.energy));
    for (int i = 0; i < D; ++i)
      EXPECT_NEAR(after.momentum[i] - before.momentum[i], flow.last_dt * outside.force[i],
                  round_off * after.mass * std::sqrt(after.energy / after.mass));
  }
}

TYPED_TEST(Invariants, MomentumAndEnergyOfAGasBetweenPistonsAndPressures) {
  constexpr int D = TypeParam::value;
  const Table pressure({0, 1}, {3, 30}), speed({0, 1}, {-0.5, -3});
  BoundaryCondition<D> pushed, piston;
  pushed.attributes = {1};
  pushed.pressure = &pressure;
  piston.attributes = {2};
  piston.normal_velocity = &speed;
  for (Predictor predictor : {Predictor::hancock, Predictor::ader, Predictor::rk2}) {
    Flow<D> flow(unit_box<D>(4, 0.2), make_closure(perfect_gas(1.4)), scheme(2, predictor),
                 {pushed, piston, wall<D>({3})},
                 this->gas([](auto& x) { return 1 + 0.3 * x[0]; }, [](auto& x) { return 2 + x[1]; },
                           &Invariants<TypeParam>::swirl));
    expect_balance(flow, 10);
  }
}

TYPED_TEST(Invariants, MomentumAndEnergyOfASolidUnderDeadTractions) {
  constexpr int D = TypeParam::value;
  const Table ramp({0, 1e-3}, {0, 1});
  BoundaryCondition<D> pulled, held;
  pulled.attributes = {1};
  pulled.traction[0] = 2e6;
  pulled.traction[1] = 1e6;
  pulled.traction_scale = &ramp;
  held.attributes = {3};
  held.velocity[0] = held.velocity[1] = &at_rest;
  for (Predictor predictor : {Predictor::hancock, Predictor::ader, Predictor::rk2}) {
    Flow<D> flow(unit_box<D>(3, 0.2), make_closure(rubber()), scheme(2, predictor), {pulled, held},
                 this->solid(&Invariants<TypeParam>::swirl));
    expect_balance(flow, 8);
  }
}

TYPED_TEST(Invariants, ForcedDownEverywhereIsTheFirstOrderSchemeBitForBit) {
  constexpr int D = TypeParam::value;
  const auto start = this->gas([](auto& x) { return 1 + 0.3 * x[0]; }, [](auto& x) { return 2 + x[1]; },
                               &Invariants<TypeParam>::swirl);
  FvConfig forced = scheme(2);
  forced.principle_tolerance = -1e300;  // no density is inside of any range
  forced.range_tolerance = -1e300;
  forced.smooth_jump = forced.small_jump = -1;  // and no flow is smooth
  Flow<D> low(unit_box<D>(4, 0.2), make_closure(perfect_gas(1.4)), scheme(1), {wall<D>(all_sides<D>())}, start);
  Flow<D> high(unit_box<D>(4, 0.2), make_closure(perfect_gas(1.4)), forced, {wall<D>(all_sides<D>())}, start);
  for (int k = 0; k < 5; ++k) {
    low.step();
    high.step();
    for (int c = 0; c < low.mesh.cells(); ++c) {
      EXPECT_EQ(low.scheme->state().cell[c].q, high.scheme->state().cell[c].q);
      EXPECT_EQ(low.scheme->state().energy[c], high.scheme->state().energy[c]);
      EXPECT_EQ(high.scheme->order(c), CellOrder::constant);
    }
    for (int p = 0; p < low.mesh.nodes(); ++p) EXPECT_EQ(low.scheme->state().x[p], high.scheme->state().x[p]);
  }
}

// Semi-discretely heat only grows; a small step leaves no more than its own square.
TYPED_TEST(Invariants, FirstOrderMakesHeatInEveryCell) {
  constexpr int D = TypeParam::value;
  FvConfig config = scheme(1);
  config.cfl = 0.02;
  Flow<D> flow(unit_box<D>(3, 0.2), make_closure(rubber()), config, {wall<D>(all_sides<D>())},
               this->solid(&Invariants<TypeParam>::swirl));
  std::vector<double> heat(flow.mesh.cells());
  for (int k = 0; k < 20; ++k) {
    flow.step();
    for (int c = 0; c < flow.mesh.cells(); ++c) {
      const auto& state = flow.scheme->state();
      const Mat3 F = flow.scheme->deformation(c, state);
      CellBatch in;
      in.n = 1;
      in.F = &F;
      double psi;
      flow.closure->stored(in, &psi);
      const double now = state.internal_energy(c) - psi;
      EXPECT_GT(now, heat[c] - 2e-3) << "J/kg, of about 1 J/kg of motion";
      heat[c] = now;
    }
  }
}

TYPED_TEST(Invariants, LinearFieldsAreReconstructedOnDistortedMeshes) {
  constexpr int D = TypeParam::value;
  const auto mesh = unit_box<D>(4, 0.3);
  SimplexMesh<D> cells(*mesh);
  NodeExchange exchange(*mesh, cells);
  const std::vector<Mirrors<D>> no_mirrors;
  Reconstruction<D> reconstruction(cells, exchange, no_mirrors);
  FlowState<D> state(cells.cells(), cells.nodes());
  state.x = cells.x;
  const auto slope = [](int f, int i) { return std::sin(1 + 3 * f + i); };
  for (int c = 0; c < cells.cells(); ++c) {
    auto& record = state.cell[c];
    record.centre = centroid<D>(cells.corners_of(c, cells.x));
    for (int f = 0; f < field_count<D>; ++f) {
      record.q[f] = f;
      for (int i = 0; i < D; ++i) record.q[f] += slope(f, i) * record.centre[i];
    }
  }
  reconstruction.gather(state);
  for (int c = 0; c < cells.cells(); ++c) {
    const auto g = reconstruction.slopes(c, state);
    for (int f = 0; f < field_count<D>; ++f)
      for (int i = 0; i < D; ++i) EXPECT_NEAR(g[i][f], slope(f, i), 1e-11);
  }
}

// An affine velocity and one stress: nodes move with the field, and cells inside feel no force.
TYPED_TEST(Invariants, PatchTest) {
  constexpr int D = TypeParam::value;
  const auto affine = [](const Vector<D>& x) {
    Vector<3> v{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) v[i] += std::cos(1 + 2 * i + j) * x[j];
    return v;
  };
  BoundaryCondition<D> outside;
  outside.attributes = all_sides<D>();
  outside.velocity_at = [&](const Vector<D>& x, double) {
    const Vector<3> v = affine(x);
    Vector<D> w;
    std::copy_n(v.begin(), D, w.begin());
    return w;
  };
  FvConfig config = scheme(2);
  Flow<D> flow(unit_box<D>(5, 0.2), make_closure(perfect_gas(1.4)), config, {outside},
               this->gas([](auto&) { return 1.0; }, [](auto&) { return 1.0; }, affine));
  flow.step(1e-9);  // what the prediction adds is of this size
  for (int p = 0; p < flow.mesh.nodes(); ++p) {
    const Vector<3> v = affine(flow.mesh.x[p]);
    for (int i = 0; i < D; ++i) EXPECT_NEAR(flow.scheme->state().v[p][i], v[i], 1e-8);
  }
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const Vector<3> v = affine(centroid<D>(flow.mesh.corners_of(c, flow.mesh.x)));
    for (int i = 0; i < D; ++i) EXPECT_NEAR(flow.scheme->state().cell[c].q[i], v[i], 1e-8);
  }
}

}  // namespace
}  // namespace titin
