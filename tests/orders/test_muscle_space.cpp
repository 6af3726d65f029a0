// Orders in space of the muscle formulation, for every element: a smooth finite deformation u(X) is made a solution by
// the body force -Div P(F(X)). Errors in L2: of the displacement k + 1, of pressure and dilatation k.
//
// F and Div P are taken by central differences of sixth order of the exact functions: no formula to get wrong, and an
// error (1e-11) far below those measured.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"
#include "fe/stress_recovery.hpp"
#include "materials/compressible.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double difference_step = 0.01;  // of functions that vary over 1: 1e-2^6 beside 1e-16 / 1e-2
constexpr double least_effectivity = 0.5, most_effectivity = 2;  // estimated over true error of the stress
constexpr double slack = 0.2;                                    // what a slope between these coarse meshes may miss

/// d f / dx_d at x, for f of any type with + and scaling by add().
template <class Values, class Function>
Values derivative(const Function& f, Vec3 x, int d) {
  constexpr double weight[] = {3.0 / 4, -3.0 / 20, 1.0 / 60};
  Values sum{};
  const double x0 = x[d];
  for (int k = 1; k <= 3; ++k)
    for (int sign : {-1, 1}) {
      x[d] = x0 + sign * k * difference_step;
      const Values value = f(x);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * weight[k - 1] / difference_step * value[i];
    }
  return sum;
}

struct Exact {
  const Material& material;
  int dimension;

  Vec3 u(const Vec3& X) const {
    const auto [x, y, z] = X;
    if (dimension == 2)
      return {0.15 * std::sin(1.5 * y + 0.3) * (1 + x), 0.1 * std::cos(2 * x) * (1 + 0.5 * y) + 0.05 * x * y, 0};
    return {0.15 * std::sin(1.5 * y + z) * (1 + x), 0.1 * std::cos(2 * x) * (1 + 0.5 * z), 0.1 * std::sin(x + 2 * y)};
  }
  Mat3 F(const Vec3& X) const {
    Mat3 F = identity;
    for (int J = 0; J < dimension; ++J) {
      const Vec3 column = derivative<Vec3>([&](const Vec3& x) { return u(x); }, X, J);
      for (int i = 0; i < 3; ++i) F[3 * i + J] += column[i];
    }
    return F;
  }
  Mat3 P(const Vec3& X) const {
    PointInput in;
    const Mat3 at = F(X);
    in.n = 1;
    in.F = &at;
    Mat3 P;
    whole_stress(material, in, &P, nullptr);
    return P;
  }
  /// -Div P [N/m^3]
  Vec3 force(const Vec3& X) const {
    Vec3 b{};
    for (int J = 0; J < dimension; ++J) {
      const Mat3 slope = derivative<Mat3>([&](const Vec3& x) { return P(x); }, X, J);
      for (int i = 0; i < 3; ++i) b[i] -= slope[3 * i + J];
    }
    return b;
  }
};

/// The equations of a model with the forces of the exact solution.
class Loaded : public NonlinearSystem {
 public:
  Loaded(MuscleSystem& system, mfem::Vector load) : system_(system), load_(std::move(load)) {}
  int size() const override { return system_.size(); }
  bool residual(const mfem::Vector& u, mfem::Vector& R) override {
    const bool inside = system_.residual(u, R);
    R -= load_;
    for (int dof : system_.constraints().dofs()) R(dof) = 0;
    return inside;
  }
  void tangent(const mfem::Vector& u, Mat K) override { system_.tangent(u, K); }
  bool has_cell_blocks() const override { return system_.has_cell_blocks(); }
  const CellBlocks& cell_blocks(double gamma) override { return system_.cell_blocks(gamma); }
  double force_scale() const override { return system_.force_scale(); }
  std::string domain_error() const override { return system_.domain_error(); }

 private:
  MuscleSystem& system_;
  mfem::Vector load_;
};

struct Errors {
  double u = 0, p = 0, D = 0;
  double P = 0, estimate = 0;  // of the first Piola stress, and what the program says of it
};

class Problem {
 public:
  Problem(const Overrides& set, int dimension)
      : model_(make(set, dimension)), system_(model_->system()), exact_{system_.material(0), dimension} {}

  Errors solve() {
    Loaded loaded(system_, load());
    NewtonConfig config = system_.config().newton;
    Newton newton(config, loaded, system_.matrix());
    mfem::Vector u = interpolated();
    const NewtonResult result = newton.solve(u);
    EXPECT_EQ(result.failure, "");
    EXPECT_LE(result.iterations, 8);
    return errors(u);
  }

 private:
  static std::unique_ptr<Muscle> make(const Overrides& set, int dimension) {
    const std::string sides = dimension == 3 ? R"("x-", "x+", "y-", "y+", "z-", "z+")" : R"("x-", "x+", "y-", "y+")";
    Parts parts = read_block("[boundary.all]\nclamp = true\non = [" + sides + "]\n" + R"(
[muscle]
inertia = "quasi-static"
[materials.soft]
density = "1 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "20 Pa" }
terms.base = { law = "neo_hookean", mu = "1 Pa" }
[solver]
tolerance = 1e-11
)",
                             false, set);
    parts.named.mesh->Transform([](const mfem::Vector& x, mfem::Vector& y) {  // cells that are no parallelepipeds
      y = x;
      y(0) += 0.08 * std::sin(3 * x(1)) * x(0) * (1 - x(0));
      y(1) += 0.1 * std::sin(2 * x(0) + 1) * x(1) * (1 - x(1));
    });
    return std::make_unique<Muscle>(std::move(parts.named), std::move(parts.muscle));
  }

  Vec3 place(int cell, int q) const {
    Vec3 x{};
    mfem::Vector view(x.data(), exact_.dimension);
    auto* map = system_.space().GetElementTransformation(cell);
    map->Transform(system_.tables().rule(cell).IntPoint(q), view);
    return x;
  }

  mfem::Vector interpolated() {
    mfem::VectorFunctionCoefficient u(exact_.dimension, [&](const mfem::Vector& x, mfem::Vector& value) {
      Vec3 X{};
      std::copy(x.begin(), x.end(), X.begin());
      const Vec3 at = exact_.u(X);
      std::copy_n(at.begin(), value.Size(), value.begin());
    });
    mfem::ParGridFunction field(&system_.space());
    field.ProjectCoefficient(u);
    mfem::Vector values(system_.size());
    field.GetTrueDofs(values);
    return values;
  }

  mfem::Vector load() const {
    auto& space = system_.space();
    const CellTables& tables = system_.tables();
    mfem::Vector local(space.GetVSize()), summed(space.GetTrueVSize());
    local = 0.0;
    mfem::Array<int> dofs;
    for (int cell = 0; cell < space.GetNE(); ++cell) {
      space.GetElementVDofs(cell, dofs);
      const int nodes = tables.nodes(cell);
      for (int q = 0; q < tables.points(cell); ++q) {
        const Vec3 b = exact_.force(place(cell, q));
        for (int i = 0; i < exact_.dimension; ++i)
          for (int a = 0; a < nodes; ++a)
            local(dofs[i * nodes + a]) += tables.weight(cell, q) * b[i] * tables.shape(cell, q)[a];
      }
    }
    space.GetProlongationMatrix()->MultTranspose(local, summed);
    return summed;
  }

  Errors errors(const mfem::Vector& u) {
    Errors square;
    const CellTables& tables = system_.tables();
    const std::vector<double> values = system_.cell_values(u);
    system_.for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
      const int nodes = tables.nodes(cell);
      std::vector<Mat3> P(tables.points(cell));
      material.stress(kernel.points(system_.point_input(cell)), P.data(), nullptr);
      for (int q = 0; q < tables.points(cell); ++q) {
        const Vec3 X = place(cell, q), exact = exact_.u(X);
        const double w = tables.weight(cell, q), J = determinant(exact_.F(X));
        for (int i = 0; i < exact_.dimension; ++i) {
          double at_point = -exact[i];
          for (int a = 0; a < nodes; ++a)
            at_point += tables.shape(cell, q)[a] * values[system_.first_value(cell) + i * nodes + a];
          square.u += w * at_point * at_point;
        }
        const Mat3 stress = exact_.P(X);
        for (int i = 0; i < 9; ++i)
          square.P += w * std::pow(P[q][i] + kernel.pressure()[q] * cofactor(kernel.F()[q])[i] - stress[i], 2);
        square.D += w * std::pow(kernel.dilatation()[q] - J, 2);
        square.p += w * std::pow(kernel.pressure()[q] - material.volumetric(J).dU, 2);
      }
    });
    StressRecovery recovery(system_);
    recovery.update(u);
    return {std::sqrt(sum(square.u)), std::sqrt(sum(square.p)), std::sqrt(sum(square.D)), std::sqrt(sum(square.P)),
            recovery.error()};
  }

  std::unique_ptr<Muscle> model_;
  MuscleSystem& system_;
  Exact exact_;
};

struct Case {
  const char* name;
  int dimension;
  const char *kind, *element;
  int order;
  std::vector<int> cells;  // along an edge
  int accuracy = order;    // k of the errors
  double missing = slack;  // of the displacement's slope: that of wedges still rises, 1.73, 1.78, 1.86
};

class Space : public testing::TestWithParam<Case> {};

TEST_P(Space, ErrorsFallByTheOrdersOfTheElement) {
  const Case& c = GetParam();
  Errors last;
  double u = 0, p = 0, D = 0;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    const int n = c.cells[i];
    const std::string edges = c.dimension == 3 ? "1, 1, 1" : "1, 1";
    const std::string cells = c.dimension == 3 ? fmt::format("{0}, {0}, {0}", n) : fmt::format("{0}, {0}", n);
    Problem problem({fmt::format("mesh.box=\"{} m\"", edges), fmt::format("mesh.cells=[{}]", cells),
                     fmt::format("mesh.kind=\"{}\"", c.kind), fmt::format("muscle.element=\"{}\"", c.element),
                     fmt::format("muscle.order={}", c.order)},
                    c.dimension);
    const Errors now = problem.solve();
    if (i > 0) {
      const double halvings = std::log(double(n) / c.cells[i - 1]);
      u = std::log(last.u / now.u) / halvings;
      p = std::log(last.p / now.p) / halvings;
      D = std::log(last.D / now.D) / halvings;
    }
    fmt::print("| {} | {} | {:.2e} {:.2f} | {:.2e} {:.2f} | {:.2e} {:.2f} |\n", c.name, n, now.u, u, now.p, p, now.D,
               D);
    fmt::print("  stress off by {:.2e}, estimated {:.2e}: effectivity {:.2f}\n", now.P, now.estimate,
               now.estimate / now.P);
    last = now;
  }
  EXPECT_GT(u, c.accuracy + 1 - c.missing);
  EXPECT_GT(p, c.accuracy - slack);
  EXPECT_GT(D, c.accuracy - slack);
  EXPECT_GT(last.estimate / last.P, least_effectivity);
  EXPECT_LT(last.estimate / last.P, most_effectivity);
}

INSTANTIATE_TEST_SUITE_P(Elements, Space,
                         testing::Values(Case{"quadrilateral_1", 2, "tensor", "three_field", 1, {8, 16}},
                                         Case{"quadrilateral_2", 2, "tensor", "three_field", 2, {6, 12}},
                                         Case{"quadrilateral_3", 2, "tensor", "three_field", 3, {4, 8}},
                                         Case{"triangle_1", 2, "simplices", "three_field", 1, {8, 16}},
                                         Case{"triangle_2", 2, "simplices", "three_field", 2, {6, 12}},
                                         Case{"hexahedron_1", 3, "tensor", "three_field", 1, {4, 8}},
                                         Case{"hexahedron_2", 3, "tensor", "three_field", 2, {3, 5}},
                                         Case{"hexahedron_3", 3, "tensor", "three_field", 3, {3, 5}},
                                         Case{"tetrahedron_1", 3, "simplices", "three_field", 1, {4, 8}},
                                         Case{"tetrahedron_2", 3, "simplices", "three_field", 2, {3, 5}},
                                         Case{"wedge_2", 3, "wedges", "three_field", 2, {7, 10}, 1, 0.25},
                                         Case{"quadrilateral_displacement_2", 2, "tensor", "displacement", 2, {6, 12}},
                                         Case{"triangle_displacement_3", 2, "simplices", "displacement", 3, {4, 8}},
                                         Case{"hexahedron_displacement_1", 3, "tensor", "displacement", 1, {4, 8}},
                                         Case{"tetrahedron_displacement_2", 3, "simplices", "displacement", 2, {2, 4}},
                                         Case{"wedge_displacement_2", 3, "wedges", "displacement", 2, {2, 4}}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace titin
