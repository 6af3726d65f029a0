// What time integration keeps of a free body's energy and momenta.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

using namespace test;

constexpr double solver = 1e-8;  // relative, after hundreds of steps of solver.tolerance = 1e-11

/// Momenta of a free body by its mass matrix.
class Momenta {
 public:
  explicit Momenta(Muscle& model) : model_(model), space_(model.system().space()), form_(&space_) {
    form_.AddDomainIntegrator(new mfem::VectorMassIntegrator(density_));
    form_.Assemble();
    form_.Finalize();
    mass_.reset(form_.ParallelAssemble());
    X_ = interpolate(space_, [](const mfem::Vector& x, mfem::Vector& u) { u = x; });
  }
  /// Linear and angular momentum [kg m/s], [kg m^2/s].
  std::array<double, 6> now() const {
    mfem::Vector Mv(X_.Size()), x = X_;
    mass_->Mult(model_.motion().v(), Mv);
    x += model_.displacement();
    std::array<double, 6> sums{};
    for (int a = 0; a < X_.Size(); a += 3)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sums[i] += Mv(a + i);
        sums[3 + i] += x(a + j) * Mv(a + k) - x(a + k) * Mv(a + j);
      }
    for (double& s : sums) s = sum(s);
    return sums;
  }

 private:
  Muscle& model_;
  mfem::ParFiniteElementSpace& space_;
  mfem::ConstantCoefficient density_{1000};
  mfem::ParBilinearForm form_;
  std::unique_ptr<mfem::HypreParMatrix> mass_;
  mfem::Vector X_;
};

/// A soft block thrown and spinning about a slanting axis: it stretches by a few percent and wobbles.
std::string tumbling(const std::string& scheme) {
  return "[time]\nscheme = \"" + scheme + "\"\n[initial]\nvelocity = \"1, 0, 0.5 m/s\"\nspin = \"60, 200, 120 1/s\"\n" +
         "centre = \"15, 5, 5 mm\"\n[muscle]\norder = 1\n[solver]\ntolerance = 1e-11\nlinear_tolerance = 1e-10\n" +
         soft_material;
}

struct Drift {
  double energy = 0, momentum = 0, spin = 0, lowest = 1e300, highest = 0;  // largest so far, relative
  int newton = 0;
};

Drift tumble(const std::string& scheme, double dt, int steps) {
  const auto model = make_block(tumbling(scheme));
  const Momenta momenta(*model);
  const auto start = momenta.now();
  const auto energy = [&] {
    return quantity(*model, "energy_kinetic") + quantity(*model, "energy_base") + quantity(*model, "energy_volumetric");
  };
  const double energy_at_start = energy();
  const auto size = [](const std::array<double, 6>& m, int first) {
    return std::sqrt(m[first] * m[first] + m[first + 1] * m[first + 1] + m[first + 2] * m[first + 2]);
  };
  Drift drift;
  for (int n = 0; n < steps; ++n) {
    const Step step = model->advance(dt);
    EXPECT_TRUE(step.ok()) << scheme << ": " << step.failure;
    if (!step.ok()) return drift;
    model->accept();
    const auto now = momenta.now();
    for (int i = 0; i < 3; ++i) {
      drift.momentum = std::max(drift.momentum, std::abs(now[i] - start[i]) / size(start, 0));
      drift.spin = std::max(drift.spin, std::abs(now[3 + i] - start[3 + i]) / size(start, 3));
    }
    drift.newton = std::max(drift.newton, step.newton);
    const double part = energy() / energy_at_start;
    drift.energy = std::max(drift.energy, std::abs(part - 1));
    drift.lowest = std::min(drift.lowest, part), drift.highest = std::max(drift.highest, part);
  }
  fmt::print(
      "{}: energy off by {:.1e} ({:.6f} to {:.6f}), momentum by {:.1e}, angular momentum by {:.1e}; newton <= {}\n",
      scheme, drift.energy, drift.lowest, drift.highest, drift.momentum, drift.spin, drift.newton);
  return drift;
}

TEST(Tumbling, KeepsEnergyAndMomentaInTheConservingScheme) {
  const Drift drift = tumble("energy_momentum", 2e-3, 300);  // a turn takes 26 ms
  EXPECT_LT(drift.energy, solver);
  EXPECT_LT(drift.momentum, solver);
  EXPECT_LT(drift.spin, solver);
  EXPECT_LE(drift.newton, 6);  // 28 degrees a step
}

TEST(Tumbling, LosesOrGainsEnergyInTheOthers) {
  EXPECT_LT(tumble("backward_euler", 1e-3, 100).lowest, 0.9);
  const Drift newmark = tumble("newmark", 1e-3, 100);
  EXPECT_GT(newmark.energy, 1e-4);
  EXPECT_LT(newmark.energy, 0.2);
  EXPECT_GT(newmark.spin, 1e-6);
}

}  // namespace
}  // namespace titin
