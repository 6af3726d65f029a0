// Orders in time of the muscle formulation: backward Euler, its dissipation, and what divides the two fibre rates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../fe/blocks.hpp"
#include "base/parallel.hpp"

namespace titin {
namespace {

using namespace test;

// First order: between two halvings of the step the slope may still miss 1 by this much.
constexpr double lowest = 0.85, highest = 1.25;

/// Stretched smoothly while the activation rises: no kink that would spoil an order.
std::string smooth_contraction(const std::string& rate) {
  std::string time = "0", length = "0", activation = "0";
  for (int i = 1; i <= 40; ++i) {
    const double t = 0.0025 * i, s = std::sin(M_PI / 2 * t / 0.1);
    time += fmt::format(", {}", t);
    length += fmt::format(", {}", 1.5 * s * s);
    activation += fmt::format(", {}", 0.4 * s * s);
  }
  return fmt::format(R"(
[muscle]
fibre_rate = "{}"
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8660254037844386, 0, 0.5]
volumetric = {{ law = "simo", bulk_modulus = "10 MPa" }}
[materials.muscle.terms]
base = {{ law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }}
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
activation = {{ time = "{} s", value = [{}] }}
[boundary."x-"]
clamp = true
[boundary."x+"]
displacement.x = {{ time = "{} s", value = "{} mm" }}
displacement.y = "0 mm"
displacement.z = "0 mm"
[solver]
tolerance = 1e-11
)",
                     rate, time, activation, time, length);
}

struct End {
  mfem::Vector u;
  double balance_error, force;
};

End run(const std::string& rate, double dt) {
  const auto model = make_block(smooth_contraction(rate));
  for (const Step& step : march(*model, 0.1, dt)) EXPECT_TRUE(step.ok()) << step.failure;
  return {model->displacement(), quantity(*model, "energy_balance_error"), quantity(*model, "reaction_x+_x")};
}

double distance(const mfem::Vector& a, const mfem::Vector& b) {
  mfem::Vector d = a;
  d -= b;
  return std::sqrt(sum(d * d));
}

TEST(Time, BackwardEulerIsOfFirstOrder) {
  const End h1 = run("stretch_difference", 0.01), h2 = run("stretch_difference", 0.005),
            h4 = run("stretch_difference", 0.0025), h8 = run("stretch_difference", 0.00125);
  const double coarse = distance(h1.u, h2.u), middle = distance(h2.u, h4.u), fine = distance(h4.u, h8.u);
  fmt::print("displacement slopes {:.3f} {:.3f}\n", std::log2(coarse / middle), std::log2(middle / fine));
  EXPECT_GT(std::log2(middle / fine), lowest);
  EXPECT_LT(std::log2(middle / fine), highest);
}

TEST(Time, DissipationVanishesAtFirstOrder) {
  std::vector<double> errors;
  for (double dt : {0.005, 0.0025, 0.00125}) errors.push_back(run("stretch_difference", dt).balance_error);
  for (double error : errors) EXPECT_GT(error, 0) << "the scheme only takes energy out";
  fmt::print("balance errors {:.4e} {:.4e} {:.4e} J, slopes {:.3f} {:.3f}\n", errors[0], errors[1], errors[2],
             std::log2(errors[0] / errors[1]), std::log2(errors[1] / errors[2]));
  EXPECT_GT(std::log2(errors[1] / errors[2]), lowest);
  EXPECT_LT(std::log2(errors[1] / errors[2]), highest);
}

TEST(Time, FibreRatesDifferByAFirstOrderTerm) {
  std::vector<double> differences;
  for (double dt : {0.01, 0.005, 0.0025})
    differences.push_back(std::abs(run("stretch_difference", dt).force - run("velocity_gradient", dt).force));
  fmt::print("force differences of the rates {:.4e} {:.4e} {:.4e} N, slopes {:.3f} {:.3f}\n", differences[0],
             differences[1], differences[2], std::log2(differences[0] / differences[1]),
             std::log2(differences[1] / differences[2]));
  EXPECT_GT(differences[2], 0);
  EXPECT_GT(std::log2(differences[1] / differences[2]), lowest);
  EXPECT_LT(std::log2(differences[1] / differences[2]), highest);
}

}  // namespace
}  // namespace titin
