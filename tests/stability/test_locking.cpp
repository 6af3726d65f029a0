// Nearly incompressible bodies on coarse meshes: three fields stay within 1 % of the converged answer whatever
// Poisson's ratio, displacement alone locks. Cook's membrane and a compressed block, as configs/muscle has them, under
// small loads. The whole curves: scripts/plot_locking.py.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/config.hpp"
#include "scene/scene.hpp"

namespace titin {
namespace {

constexpr double shear_modulus = 80.1938e6;  // [Pa]

struct Panel {
  const char *scene, *marker, *load;
  double compressible, incompressible;  // [m] at Poisson's ratio 0.3 and 0.49999, converged (below)
};
// Q2/P1 on 32 x 32 and 8 x 8 x 8 cells; Richardson's extrapolation with half as many cells moves them by 0.1 %.
const Panel cook{"cook", "marker_tip_uy", "boundary.right.traction=0, 0.625 MPa", 1.0800e-3, 0.7945e-3};
const Panel block{"compressed_block", "marker_centre_uz", "boundary.loaded.traction=0, 0, -1.6 MPa", -5.508e-6,
                  -4.321e-6};

/// Displacement of the marker over the converged one.
double part_of(const Panel& panel, double ratio, const std::string& cells, const std::string& element, int order,
               int refine) {
  const std::string top = TITIN_TEST_DATA "/../..";
  const double bulk = shear_modulus * 2 * (1 + ratio) / (3 * (1 - 2 * ratio));
  const Scene scene = Scene::read(
      fmt::format("{}/configs/muscle/{}.toml", top, panel.scene),
      {fmt::format("mesh.file=\"{}/meshes/{}_{}.msh\"", top, panel.scene, cells), fmt::format("mesh.refine={}", refine),
       "muscle.element=" + element, fmt::format("muscle.order={}", order), "time.step=1 s", panel.load,
       fmt::format("materials.rubber.volumetric.bulk_modulus={:.15g} Pa", bulk)});
  const Step step = scene.model->advance(1);
  EXPECT_EQ(step.failure, "");
  scene.model->accept();
  const double converged = ratio < 0.4 ? panel.compressible : panel.incompressible;
  for (const Quantity& q : scene.model->quantities())
    if (q.name == panel.marker) {
      fmt::print("{}, {} {} of {}, ratio {}: {:.3f}\n", panel.scene, element, order, cells, ratio, q.value / converged);
      return q.value / converged;
    }
  ADD_FAILURE() << "no quantity " << panel.marker;
  return 0;
}

constexpr double compressible = 0.3, incompressible = 0.49999;
constexpr double near = 0.01;

TEST(Locking, DoesNotOccurWithThreeFieldsOnCoarseMeshes) {
  for (double ratio : {compressible, incompressible}) {
    EXPECT_NEAR(part_of(cook, ratio, "quadrilaterals", "three_field", 2, 2), 1, near) << "8 x 8";
    EXPECT_NEAR(part_of(cook, ratio, "quadrilaterals", "three_field", 1, 4), 1, near) << "32 x 32";
    EXPECT_NEAR(part_of(cook, ratio, "triangles", "three_field", 2, 3), 1, near) << "2 x 16 x 16";
    EXPECT_NEAR(part_of(block, ratio, "hexahedra", "three_field", 2, 1), 1, near) << "4 x 4 x 4";
    EXPECT_NEAR(part_of(block, ratio, "hexahedra", "three_field", 1, 2), 1, near) << "8 x 8 x 8";
  }
  EXPECT_NEAR(part_of(block, incompressible, "tetrahedra", "three_field", 2, 1), 1, 0.015) << "6 x 4 x 4 x 4: 1.1 %";
}

TEST(Locking, IsWhatDisplacementAloneDoes) {
  EXPECT_NEAR(part_of(cook, compressible, "quadrilaterals", "displacement", 2, 2), 1, near);
  EXPECT_LT(part_of(cook, incompressible, "quadrilaterals", "displacement", 2, 2), 0.95);
  EXPECT_NEAR(part_of(block, compressible, "hexahedra", "displacement", 1, 2), 1, near);
  EXPECT_LT(part_of(cook, incompressible, "quadrilaterals", "displacement", 1, 3), 0.3);
  EXPECT_LT(part_of(block, incompressible, "hexahedra", "displacement", 1, 2), 0.03);
  EXPECT_LT(part_of(block, incompressible, "tetrahedra", "displacement", 1, 2), 0.03);
}

}  // namespace
}  // namespace titin
