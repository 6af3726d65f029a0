// Corner normals, exact motion and F of single simplices, against differences and identities.
#include <gtest/gtest.h>

#include <random>

#include "mesh/simplex_geometry.hpp"

namespace titin {
namespace {

constexpr double round_off = 1e-13;

template <class Dimension>
class SimplexGeometry : public testing::Test {
 protected:
  static constexpr int D = Dimension::value;
  Corners<D> random_simplex() {
    for (;;) {
      Corners<D> x;
      for (auto& p : x)
        for (double& c : p) c = uniform(generator);
      if (simplex_volume<D>(x) > 0.05) return x;
    }
  }
  Corners<D> random_velocity() {
    Corners<D> v;
    for (auto& p : v)
      for (double& c : p) c = 0.3 * uniform(generator);
    return v;
  }
  static Corners<D> at(const Corners<D>& x, double t, const Corners<D>& v) {
    Corners<D> y;
    for (int p = 0; p <= D; ++p) y[p] = moved(x[p], t, v[p]);
    return y;
  }
  static double rate(const Corners<D>& x, const Corners<D>& v) {
    const auto an = corner_normals<D>(x);
    double sum = 0;
    for (int p = 0; p <= D; ++p) sum += dot(an[p], v[p]);
    return sum;
  }
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> uniform{-1, 1};
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SimplexGeometry, Dimensions);

TYPED_TEST(SimplexGeometry, NormalsSumToZeroAndTheirMomentIsTheVolume) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 20; ++k) {
    const auto x = this->random_simplex();
    const auto an = corner_normals<D>(x);
    for (int i = 0; i < D; ++i) {
      double sum = 0;
      for (int p = 0; p <= D; ++p) sum += an[p][i];
      EXPECT_NEAR(sum, 0, round_off);
      for (int j = 0; j < D; ++j) {
        double moment = 0;
        for (int p = 0; p <= D; ++p) moment += x[p][i] * an[p][j];
        EXPECT_NEAR(moment, i == j ? simplex_volume<D>(x) : 0, round_off);
      }
    }
  }
}

TYPED_TEST(SimplexGeometry, NormalsAreDerivativesOfTheVolume) {
  constexpr int D = TypeParam::value;
  constexpr double h = 1e-5, of_differences = 1e-9;
  for (int k = 0; k < 20; ++k) {
    const auto x = this->random_simplex();
    const auto an = corner_normals<D>(x);
    for (int p = 0; p <= D; ++p)
      for (int i = 0; i < D; ++i) {
        auto up = x, down = x;
        up[p][i] += h;
        down[p][i] -= h;
        EXPECT_NEAR(an[p][i], (simplex_volume<D>(up) - simplex_volume<D>(down)) / (2 * h), of_differences);
      }
  }
}

// Midpoint in the plane, Simpson in space: the rate of the volume is of degree D - 1 in time.
TYPED_TEST(SimplexGeometry, SweptVolumeIsExact) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 20; ++k) {
    const auto x = this->random_simplex(), v = this->random_velocity();
    const double ends = this->rate(x, v) + this->rate(this->at(x, 1, v), v),
                 middle = this->rate(this->at(x, 0.5, v), v);
    const double change = simplex_volume<D>(this->at(x, 1, v)) - simplex_volume<D>(x);
    EXPECT_NEAR(change, D == 2 ? middle : (ends + 4 * middle) / 6, round_off);
  }
}

TYPED_TEST(SimplexGeometry, GradientOfNodesIsWhatCrankNicolsonGives) {
  constexpr int D = TypeParam::value;
  for (int k = 0; k < 20; ++k) {
    const auto x = this->random_simplex(), v = this->random_velocity();
    const auto half = this->at(x, 0.5, v), end = this->at(x, 1, v);
    if (simplex_volume<D>(half) < 0.02 || simplex_volume<D>(end) < 0.02) continue;
    const Matrix<D> Dm = inverse_of<D>(edges<D>(x));
    const Matrix<D> F = matrix_product<D>(edges<D>(end), Dm);
    EXPECT_NEAR(determinant_of<D>(F), simplex_volume<D>(end) / simplex_volume<D>(x), 1e-11);
    Matrix<D> L{};
    const auto an = corner_normals<D>(half);
    for (int p = 0; p <= D; ++p)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) L[D * i + j] += v[p][i] * an[p][j] / simplex_volume<D>(half);
    Matrix<D> plus{}, minus{};
    for (int i = 0; i < D * D; ++i) plus[i] = 0.5 * L[i], minus[i] = -0.5 * L[i];
    for (int i = 0; i < D; ++i) plus[(D + 1) * i] += 1, minus[(D + 1) * i] += 1;
    const Matrix<D> crank_nicolson = matrix_product<D>(inverse_of<D>(minus), plus);
    for (int i = 0; i < D * D; ++i) EXPECT_NEAR(F[i], crank_nicolson[i], 1e-11);
  }
}

}  // namespace
}  // namespace titin
