/// Smallest and largest eigenvalues of acoustic tensors: against closed forms, and against brute force.
#include "materials/ellipticity.hpp"

#include <fmt/format.h>

#include <random>

#include "materials_for_tests.hpp"
#include "math/spectral.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-9;  // the value at a minimum is right to the square of its slope, 1e-12

Mat3 stretches(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }
Mat3 uniaxial(double l) { return stretches(l, 1 / std::sqrt(l), 1 / std::sqrt(l)); }

AcousticValue smallest(const Material& m, const Mat3& F, double time = 0) {
  const Point p{.F = F, .time = time};
  PointInput in = p.input();
  in.fibre = nullptr;
  AcousticValue value;
  legendre_hadamard(m, in, &value);
  return value;
}
double form(const Mat9& A, const Vec3& a, const Vec3& n) {
  double sum = 0;
  for (int p = 0; p < 9; ++p)
    for (int q = 0; q < 9; ++q) sum += A[9 * p + q] * a[p / 3] * n[p % 3] * a[q / 3] * n[q % 3];
  return sum;
}

/// Smallest eigenvalue over the directions of a fine grid in longitude and latitude.
double brute_force(const Mat9& A, int size) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= size; ++i)
    for (int j = 0; j < 2 * size; ++j) {
      const double theta = 0.5 * M_PI * i / size, phi = M_PI * j / size;
      const Vec3 n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      Mat3 Q{};
      for (int p = 0; p < 9; ++p)
        for (int q = 0; q < 9; ++q) {
          const double part = 0.5 * A[9 * p + q] * n[p % 3] * n[q % 3];
          Q[3 * (p / 3) + q / 3] += part, Q[3 * (q / 3) + p / 3] += part;
        }
      const Vec3 values = eigenpairs(Q).values;
      least = std::min({least, values[0], values[1], values[2]});
    }
  return least;
}

TEST(Acoustic, SmallestValueIsThatOfBruteForce) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 60; ++k) {
    Mat9 A;
    for (double& a : A) a = normal(random);
    const AcousticValue found = smallest_acoustic(A);
    EXPECT_NEAR(form(A, found.motion, found.normal), found.value, 1e-12);
    const double grid = brute_force(A, 60);
    EXPECT_LE(found.value, grid + 1e-12) << k;
    EXPECT_NEAR(found.value, grid, 0.02) << k;  // the grid's own error
  }
}

TEST(Acoustic, IsFoundInNarrowValleys) {
  // Nearly incompressible: a . F^-T n = 0 must hold to 1e-7 along the valley.
  const auto soft = material(
      "density = \"1000 kg/m^3\"\nvolumetric = { law = \"simo\", bulk_modulus = \"10 GPa\" }\n"
      "terms.m = { law = \"neo_hookean\", mu = \"1 kPa\" }\n");
  EXPECT_NEAR(smallest(*soft, identity).value, 1e3, 1e-3);
  const double l = 1.5;  // P.a waves of shear: mu n . n in the reference
  EXPECT_NEAR(smallest(*soft, multiply(rotation(0.7), uniaxial(l))).value, 1e3, 1e-3);
}

TEST(Ellipticity, OfANeoHookeanSolidIsNeverLost) {
  const auto m = material_of("neo_hookean", "mu = \"10 kPa\"");
  for (double l : {0.1, 0.4, 0.8, 1.0, 1.5, 3.0, 8.0}) {
    EXPECT_GT(smallest(*m, uniaxial(l)).value, 0) << l;
    EXPECT_GT(smallest(*m, stretches(l, 1.1, 0.7)).value, 0) << l;
  }
}

MaterialPointer st_venant_kirchhoff(double lambda) {
  return material(
      fmt::format("density = \"1000 kg/m^3\"\nterms.m = {{ law = \"st_venant_kirchhoff\", mu = \"10 kPa\", "
                  "lambda = \"{} kPa\" }}\n",
                  lambda));
}

/// Uniaxial strain l of a St Venant-Kirchhoff solid, L = l^2, k = lambda/mu; for n at an angle to x with cosine^2 = x,
/// Q / mu = (s + L + (1 + k) L x, s + 1 + (1 + k)(1 - x); (1 + k) l sqrt(x (1 - x))) in
/// the plane of x and n and s + 1 across it, s = (L - 1)(k/2 + x).
double smallest_of_st_venant_kirchhoff(double l, double k) {
  double least = std::numeric_limits<double>::infinity();
  for (double x = 0; x <= 1; x += 1e-5) {
    const double L = l * l, s = (L - 1) * (0.5 * k + x);
    const double a = s + L + (1 + k) * L * x, b = s + 1 + (1 + k) * (1 - x), c = (1 + k) * l * std::sqrt(x * (1 - x));
    least = std::min({least, 0.5 * (a + b) - std::hypot(0.5 * (a - b), c), s + 1});
  }
  return least;
}

TEST(Ellipticity, OfStVenantKirchhoffInCompressionIsTheClosedForm) {
  for (double k : {0.0, 1.0, 4.0})
    for (double l : {0.4, 0.55, 0.7, 0.85, 1.0, 1.2})
      EXPECT_NEAR(smallest(*st_venant_kirchhoff(10 * k), stretches(l, 1, 1)).value,
                  1e4 * smallest_of_st_venant_kirchhoff(l, k), 1e-5 * 1e4)
          << k << " " << l;
}

/// With lambda = 0, det Q vanishes first for L^2 - 12 L + 4 = 0, in a direction with x = (L + 2) / (4 - 4 L): before
/// the stress along x has its maximum, at l = 1/sqrt(3).
TEST(Ellipticity, OfStVenantKirchhoffIsLostAtTwoMinusRootTwo) {
  const auto m = st_venant_kirchhoff(0);
  const double critical = 2 - std::sqrt(2.0), L = critical * critical;
  const AcousticValue band = smallest(*m, stretches(critical, 1, 1));
  EXPECT_NEAR(band.value, 0, round_off * 1e4);
  EXPECT_NEAR(band.normal[0] * band.normal[0], (L + 2) / (4 - 4 * L), 1e-6);
  EXPECT_GT(smallest(*m, stretches(critical + 1e-6, 1, 1)).value, 0);
  EXPECT_LT(smallest(*m, stretches(critical - 1e-6, 1, 1)).value, 0);
}

/// Activation is the time: one material for all activations.
MaterialPointer muscle(double base, const char* curve) {
  return material(
      fmt::format("density = \"1060 kg/m^3\"\nfibre = [1, 0, 0]\n"
                  "volumetric = {{ law = \"simo\", bulk_modulus = \"10 MPa\" }}\n"
                  "[materials.m.terms]\nbase = {{ law = \"neo_hookean\", mu = \"{} kPa\" }}\n"
                  "[materials.m.terms.active]\nlaw = \"hill_active\"\npeak_stress = \"200 kPa\"\n"
                  "max_strain_rate = \"5 1/s\"\ncurve = \"{}\"\n"
                  "activation = {{ time = \"0, 1 s\", value = [0, 1] }}\n",
                  base, curve));
}

TEST(Ellipticity, OfActiveMuscleIsLostOnTheDescendingLimbAndBaseStiffnessRestoresIt) {
  for (const char* curve : {"flexodeal_smooth", "degroote"}) {
    SCOPED_TRACE(curve);
    const double descending = 1.3;
    double before = std::numeric_limits<double>::infinity();
    for (double activation : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double value = smallest(*muscle(20, curve), uniaxial(descending), activation).value;
      EXPECT_LT(value, before) << activation;
      before = value;
    }
    EXPECT_LT(before, 0);
    for (double base : {40.0, 80.0, 160.0, 320.0, 640.0}) {
      const double value = smallest(*muscle(base, curve), uniaxial(descending), 1).value;
      EXPECT_GT(value, before) << base;
      before = value;
    }
    EXPECT_GT(before, 0);
  }
}

TEST(Waves, OfAnIsotropicSolidAtRest) {
  const auto m = material_of("neo_hookean", "mu = \"10 kPa\"");  // K = 1 MPa, 1000 kg/m^3
  Point p;
  double speed = 0;
  wave_speed(*m, p.input(), &speed);
  EXPECT_NEAR(speed, std::sqrt((1e6 + 4e4 / 3) / 1000), 1e-9);
}

/// Uniaxial strain: rho0 c^2 = l^2 d2W/dl^2 along x, in the deformed body; P = (lambda/2 + mu)(l^3 - l).
TEST(Waves, OfAStretchedSolidAreThoseOfTheDeformedBody) {
  const auto m = material(
      "density = \"1000 kg/m^3\"\nterms.m = { law = \"st_venant_kirchhoff\", mu = \"10 kPa\", lambda = \"40 kPa\" }\n");
  const double l = 1.4;
  Point p{.F = stretches(l, 1, 1)};
  double speed = 0;
  wave_speed(*m, p.input(), &speed);
  EXPECT_NEAR(speed, std::sqrt(l * l * 3e4 * (3 * l * l - 1) / 1000), 1e-9);
}

TEST(Acoustic, IsNotANumberWhereTheStressIsNone) {
  const auto m = material_of("neo_hookean", "mu = \"10 kPa\"");
  EXPECT_TRUE(std::isnan(smallest(*m, stretches(-1, 1, 1)).value));
}

}  // namespace
}  // namespace titin::testing
