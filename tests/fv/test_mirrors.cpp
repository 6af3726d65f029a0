// Slopes beside planes of symmetry: exact for linear fields that are symmetric, and stable in bodies one cell wide.
#include <gtest/gtest.h>

#include <cmath>

#include "flows_for_tests.hpp"

namespace titin {
namespace {

using namespace test;

template <class Dimension>
class Mirror : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Mirror, Dimensions);

// The wall is x+ = 1: v_x and the shears with x are odd about it, all else is even.
TYPED_TEST(Mirror, SymmetricLinearFieldsHaveTheirSlopes) {
  constexpr int D = TypeParam::value;
  const auto parallel = unit_box<D>(4, 0.2);
  const SimplexMesh<D> mesh(*parallel);
  NodeExchange exchange(*parallel, mesh);
  const Boundary<D> boundary(mesh, exchange, {wall<D>({D == 2 ? 2 : 3})});
  Reconstruction<D> reconstruction(mesh, exchange, boundary.mirrors());
  FlowState<D> state(mesh.cells(), mesh.nodes());
  state.x = mesh.x;
  Slopes<D> slopes{};
  for (int f = 0; f < field_count<D>; ++f)
    for (int i = 0; i < D; ++i) {
      const bool odd = f == 0 || (f >= D && (f == D + symmetric_index<D>(0, 1) || (D == 3 && f == D + 5)));
      if (odd == (i == 0)) slopes[i][f] = 1 + f + 0.3 * i;
    }
  for (int c = 0; c < mesh.cells(); ++c) {
    state.cell[c].centre = centroid<D>(mesh.corners_of(c, mesh.x));
    Vector<D> from_wall = state.cell[c].centre;
    from_wall[0] -= 1;
    for (int f = 0; f < field_count<D>; ++f)
      state.cell[c].q[f] = change_along<D>(from_wall, slopes)[f / lane_count][f % lane_count];
  }
  reconstruction.gather(state);
  double mirrored = 0;
  for (int c = 0; c < mesh.cells(); ++c) {
    const Slopes<D> found = reconstruction.slopes(c, state);
    for (int f = 0; f < field_count<D>; ++f)
      for (int i = 0; i < D; ++i) EXPECT_NEAR(found[i][f], slopes[i][f], 1e-10) << f << " " << i;
  }
  for (const auto& m : boundary.mirrors()) mirrored += m.count;
  EXPECT_GT(sum(mirrored), 0);
}

// A needle between walls with one box across, and a push at one end. Stored and kinetic energy come from that work
// alone; with one-sided slopes they grow without bound, out of heat that becomes negative.
TYPED_TEST(Mirror, NeedlesAreStable) {
  constexpr int D = TypeParam::value;
  const Table pressure(1e5);
  BoundaryCondition<D> pushed;
  pushed.attributes = {D == 2 ? 4 : 5};
  pushed.pressure = &pressure;
  std::vector<int> sides = D == 2 ? std::vector{1, 3} : std::vector{1, 2, 4, 6};
  Flow<D> flow(unit_box<D>(30, 0, 1, 1), make_closure(rubber()), {}, {pushed, wall<D>(sides)},
               [](const Vector<D>&, const Closure& closure) {
                 return CellStart{nullptr, rubber_density, closure.energy_at(0, 0), {}};
               });
  flow.run_to(3e-3);
  double mechanical = 0, total = 0;
  for (int c = 0; c < flow.mesh.cells(); ++c) {
    const Mat3 F = flow.scheme->deformation(c, flow.scheme->state());
    CellBatch in;
    in.n = 1;
    in.F = &F;
    double psi;
    flow.closure->stored(in, &psi);
    const auto v = velocity_of<D>(flow.scheme->state().cell[c].q);
    mechanical += flow.scheme->mass(c) * (psi + 0.5 * dot(v, v));
    total += flow.scheme->mass(c) * flow.scheme->state().energy[c];
  }
  EXPECT_LT(sum(mechanical), 1.001 * sum(total));
  EXPECT_GT(sum(mechanical), 0.8 * sum(total));
}

}  // namespace
}  // namespace titin
