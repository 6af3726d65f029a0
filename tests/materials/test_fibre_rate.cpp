/// The two rates of fibre stretch against their definitions and against each other.
#include "materials_for_tests.hpp"

namespace titin::testing {
namespace {

constexpr double round_off = 1e-12;

Mat3 inverse(const Mat3& F) {
  Mat3 G = transpose(cofactor(F));
  for (double& x : G) x /= determinant(F);
  return G;
}

/// a . dev(d) a / lambda with a = Fbar a0 and d = sym((F - F_old) F^-1 / dt), as it is defined.
double defined_rate(const Point& p, FibreMeasure measure) {
  Mat3 dF = p.F;
  for (int i = 0; i < 9; ++i) dF[i] = (p.F[i] - p.F_old[i]) / p.dt;
  const Mat3 l = multiply(dF, inverse(p.F));
  Mat3 d;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) d[3 * i + j] = 0.5 * (l[3 * i + j] + l[3 * j + i]);
  Vec3 a = multiply(p.F, p.fibre);
  if (measure == FibreMeasure::isochoric) {
    const double mean = trace(d) / 3, y = std::pow(determinant(p.F), -1.0 / 3);
    d[0] -= mean, d[4] -= mean, d[8] -= mean;
    for (double& x : a) x *= y;
  }
  return dot(a, multiply(d, a)) / norm(a);
}

Kinematics<double> kinematics_of(const Point& p, FibreMeasure measure) {
  InvariantSet used;
  used.insert(Invariant::I4);
  used.insert(Invariant::rate);
  Kinematics<double> k;
  deform(p.F, p.F_old, {p.fibre, {}}, used, {measure, p.rate, p.dt}, k);
  return k;
}

Point moving() { return {.F = general_F, .F_old = general_F_old, .rate = FibreRate::velocity_gradient}; }

TEST(FibreRate, OfTheVelocityGradientIsItsDefinition) {
  for (FibreMeasure measure : {FibreMeasure::isochoric, FibreMeasure::full}) {
    const double rate = defined_rate(moving(), measure);
    EXPECT_NEAR(kinematics_of(moving(), measure).rate[0], rate, round_off * std::abs(rate));
  }
}

TEST(FibreRate, GradientOfTheVelocityGradientsRateIsExactAtTheOrderOfDifferences) {
  for (FibreMeasure measure : {FibreMeasure::isochoric, FibreMeasure::full}) {
    const Mat3 G = kinematics_of(moving(), measure).G_rate[0];
    double last = 0;
    for (double h : {4e-3, 2e-3, 1e-3}) {
      Mat3 difference;
      for (int q = 0; q < 9; ++q) {
        Point above = moving(), below = moving();
        above.F[q] += h, below.F[q] -= h;
        difference[q] = (defined_rate(above, measure) - defined_rate(below, measure)) / (2 * h);
      }
      const double error = distance(difference, G);
      if (last > 0) {
        EXPECT_GT(std::log2(last / error), 1.9);
      }
      last = error;
    }
  }
}

/// Three steps of a smooth motion towards the same F: both rates tend to the same number, one order of dt apart.
TEST(FibreRate, TheTwoRatesDifferByTheFirstOrderOfTheStep) {
  const MaterialPointer m =
      material_of("hill_active", R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 1)");
  const auto motion = [](double t) {  // shortens, shears and spins
    Mat3 F = general_F;
    F[0] -= 0.6 * t, F[1] += 0.8 * t * t, F[5] -= 0.5 * t, F[8] += 0.3 * t;
    return multiply(rotation(1.5 * t), F);
  };
  double last = 0;
  for (double dt : {0.02, 0.01, 0.005}) {
    Point p{.F = motion(0), .F_old = motion(-dt), .dt = dt};
    p.rate = FibreRate::stretch_difference;
    const Mat3 P = stress(*m, p);
    p.rate = FibreRate::velocity_gradient;
    const double difference = distance(stress(*m, p), P);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / difference), 1, 0.1);
    }
    last = difference;
  }
}

/// The tangent grows as 1 / dt, what its symmetric form leaves out does not.
TEST(FibreRate, SymmetricTangentHasTheSameStressAndIsOffByAConstant) {
  const MaterialPointer m =
      material_of("hill_active", R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 1)");
  const Mat3 velocity{0.2, 0.1, -0.1, 0, -0.05, 0.1, -0.1, 0, 0.05};  // dF/dt: within the steep part of the curve
  double last = 0;
  for (double dt : {4e-4, 2e-4, 1e-4}) {
    Point p{.F = general_F, .F_old = general_F, .rate = FibreRate::velocity_gradient, .dt = dt};
    for (int i = 0; i < 9; ++i) p.F_old[i] -= dt * velocity[i];
    Point q = p;
    q.rate = FibreRate::velocity_gradient_symmetric;
    EXPECT_EQ(stress(*m, p), stress(*m, q));
    const Mat9 exact = tangent(*m, p), symmetric = tangent(*m, q);
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < i; ++j)
        EXPECT_NEAR(symmetric[9 * i + j], symmetric[9 * j + i], round_off * size_of(symmetric));
    const double part = distance(exact, symmetric) / size_of(exact);
    if (last > 0) {
      EXPECT_NEAR(last / part, 2, 0.1);
    }
    last = part;
  }
  EXPECT_GT(last, 100 * round_off);
}

TEST(FibreRate, IsZeroAtRestAndWithoutAStep) {
  Point p = moving();
  p.F_old = p.F;
  const MaterialPointer m =
      material_of("hill_active", R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.25)");
  double stretch = 0, rate = 1, activation = 0;
  m->fibre_state(p.input(), &stretch, &rate, &activation);
  EXPECT_NEAR(stretch, norm(multiply(general_F, p.fibre)), round_off);
  EXPECT_NEAR(rate, 0, round_off / p.dt);
  EXPECT_EQ(activation, 0.25);
  p = moving(), p.dt = 0;
  m->fibre_state(p.input(), &stretch, &rate, &activation);
  EXPECT_EQ(rate, 0);
}

TEST(FibreRate, OfTheOutputIsThatOfTheTrueStretch) {
  const MaterialPointer m =
      material_of("hill_active", R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 1)");
  Point p = moving();
  double stretch = 0, rate = 0, activation = 0;
  m->fibre_state(p.input(), &stretch, &rate, &activation);
  EXPECT_NEAR(rate, defined_rate(p, FibreMeasure::full), round_off * std::abs(rate));
  p.rate = FibreRate::stretch_difference;
  m->fibre_state(p.input(), &stretch, &rate, &activation);
  EXPECT_NEAR(rate, (stretch - norm(multiply(p.F_old, p.fibre))) / p.dt, round_off * std::abs(rate));
}

}  // namespace
}  // namespace titin::testing
