// The assembled tangent is the derivative of the assembled residual: shown by the order of a central difference, which
// a wrong entry turns from two into zero.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "blocks.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double order_of_central_difference = 1.9;  // 2, less what the last halving loses to round-off
constexpr double symmetry_tolerance = 1e-12;         // relative to the largest entry

/// A smooth deformation that keeps the volume nearly: lengthens, shears and twists.
void deformation(const mfem::Vector& x, mfem::Vector& u) {
  u.SetSize(3);
  u(0) = 0.08 * x(0) + 0.05 * x(1);
  u(1) = -0.04 * x(1) + 6 * x(0) * x(2);
  u(2) = -0.04 * x(2) - 6 * x(0) * x(1);
}

void direction(const mfem::Vector& x, mfem::Vector& w) {
  w.SetSize(3);
  w(0) = 1e-3 * std::sin(300 * x(1) + 100 * x(2));
  w(1) = 1e-3 * std::cos(200 * x(0));
  w(2) = 1e-3 * std::sin(250 * x(0) * (1 + x(1)));
}

struct Derivative {
  mfem::Vector u, w;
  MuscleSystem& system;

  explicit Derivative(Muscle& model)
      : u(interpolate(model.system().space(), deformation)),
        w(interpolate(model.system().space(), direction)),
        system(model.system()) {
    mfem::Vector u_old = u;
    u_old *= 0.4;  // every fibre lengthens at a rate between two joints of the force-velocity curve
    mfem::Vector v_old = u;
    v_old *= 0.5;
    Integrator integrator(model.system().config().integrator, u.Size());
    integrator.start(u_old, v_old, v_old);
    integrator.begin(0.02, {system.constraints().dofs(), u, v_old});
    system.step() = StepState(integrator, 0.05);
    for (int dof : system.constraints().dofs()) w(dof) = 0;
  }
  mfem::Vector residual_at(double h) {
    mfem::Vector x = u, R(u.Size());
    x.Add(h, w);
    EXPECT_TRUE(system.residual(x, R)) << system.domain_error();
    return R;
  }
  mfem::Vector tangent_times_w() {
    system.tangent(u, system.matrix());
    Vec x, y;
    check(MatCreateVecs(system.matrix(), &x, &y));
    mfem::Vector product(u.Size());
    PetscScalar* data;
    check(VecGetArray(x, &data));
    std::copy(w.begin(), w.end(), data);
    check(VecRestoreArray(x, &data));
    check(MatMult(system.matrix(), x, y));
    check(VecGetArray(y, &data));
    std::copy(data, data + product.Size(), product.begin());
    check(VecRestoreArray(y, &data));
    VecDestroy(&x);
    VecDestroy(&y);
    return product;
  }
  double error(const mfem::Vector& Kw, double h) {
    mfem::Vector difference = residual_at(h);
    difference -= residual_at(-h);
    difference /= 2 * h;
    difference -= Kw;
    return std::sqrt(sum(difference * difference) / sum(Kw * Kw));
  }
  double order() {
    const mfem::Vector Kw = tangent_times_w();
    const double coarse = error(Kw, 4e-3), fine = error(Kw, 2e-3);
    fmt::print("tangent against differences: order {:.3f}, relative difference {:.1e}\n", std::log2(coarse / fine),
               fine);
    return std::log2(coarse / fine);
  }
};

const std::string ends = "[boundary.\"x-\"]\nclamp = true\n";

/// Directions and numbers of each point, in the kernels over several cells too.
const std::string fields = "[muscle]\ninertia = \"quasi-static\"\n" + ends + R"(
[materials.muscle]
density = "1060 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
)" + "fibre = { field = \"" TITIN_TEST_DATA "/fields/muscle.csv\", columns = [\"ax\", \"ay\", \"az\"] }\n" +
                           R"(
[materials.muscle.terms]
base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
max_strain_rate = "5 1/s"
activation = 1
)" + "peak_stress = { field = \"" TITIN_TEST_DATA "/fields/muscle.csv\", column = \"peak_stress\" }\n";

struct Case {
  const char* name;
  std::string text;
  bool symmetric;
};

class Tangent : public testing::TestWithParam<Case> {};

TEST_P(Tangent, IsTheDerivativeOfTheResidual) {
  const auto model = make_block(GetParam().text, true);
  Derivative derivative(*model);
  EXPECT_GT(derivative.order(), order_of_central_difference);
}

TEST_P(Tangent, IsSymmetricExactlyWhereItSaysSo) {
  const auto model = make_block(GetParam().text, true);
  Derivative derivative(*model);
  derivative.tangent_times_w();
  Mat K = model->system().matrix(), transposed;
  check(MatTranspose(K, MAT_INITIAL_MATRIX, &transposed));
  PetscReal size, difference;
  check(MatNorm(K, NORM_INFINITY, &size));
  check(MatAXPY(transposed, -1, K, DIFFERENT_NONZERO_PATTERN));
  check(MatNorm(transposed, NORM_INFINITY, &difference));
  MatDestroy(&transposed);
  PetscBool said = PETSC_FALSE, known;
  check(MatIsSymmetricKnown(K, &known, &said));
  EXPECT_EQ(said == PETSC_TRUE, GetParam().symmetric);
  if (GetParam().symmetric)
    EXPECT_LT(difference, symmetry_tolerance * size);
  else
    EXPECT_GT(difference, symmetry_tolerance * size);
}

INSTANTIATE_TEST_SUITE_P(
    All, Tangent,
    testing::Values(Case{"soft", soft_material + ends, true}, Case{"muscle", muscle_material + ends, true},
                    Case{"muscle_velocity_gradient",
                         "[muscle]\nfibre_rate = \"velocity_gradient\"\n" + muscle_material + ends, false},
                    Case{"quasi_static", "[muscle]\ninertia = \"quasi-static\"\n" + muscle_material + ends, true},
                    Case{"conserving", "[time]\nscheme = \"energy_momentum\"\n" + soft_material + ends, false},
                    Case{"conserving_muscle", "[time]\nscheme = \"energy_momentum\"\n" + muscle_material + ends, false},
                    Case{"order_1", "[muscle]\norder = 1\n" + muscle_material + ends, true},
                    Case{"order_3", "[muscle]\norder = 3\n" + soft_material + ends, true}, Case{"fields", fields, true},
                    Case{"spring_and_wall",
                         soft_material + ends +
                             "[boundary.\"x+\"]\nspring = \"1, 2, 3 N/mm\"\ndamper = \"2, 1, 3 N "
                             "s/m\"\n[boundary.\"z-\"]\nwall = { point = \"0, "
                             "0, 5 mm\", normal = [0, 1, 2], penalty = \"1 GPa/m\" }\n",
                         true},
                    Case{"conserving_damper",
                         "[time]\nscheme = \"energy_momentum\"\n" + soft_material + ends +
                             "[boundary.\"x+\"]\nspring = \"1, 2, 3 N/mm\"\ndamper = \"2, 1, 3 N s/m\"\n",
                         false},
                    Case{"pressure", soft_material + ends + "[boundary.\"x+\"]\npressure = \"20 kPa\"\n", false},
                    Case{"traction", soft_material + ends + "[boundary.\"z+\"]\ntraction = \"1, 2, -3 kPa\"\n", true}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace titin
