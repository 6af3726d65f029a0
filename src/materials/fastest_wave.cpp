#include "materials/fastest_wave.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "materials/compressible.hpp"
#include "math/spectral.hpp"
#include "math/symmetric.hpp"

namespace titin {
namespace {

constexpr double settled = 1e-4;  // of the square of the speed, in one turn
constexpr int most_turns = 12;
constexpr int climbed = 2;  // directions to begin from, the best ones

constexpr double d2 = 0.70710678118654752, d3 = 0.57735026918962576;
constexpr std::array<Vec3, 13> spread{{{1, 0, 0},
                                       {0, 1, 0},
                                       {0, 0, 1},
                                       {d2, d2, 0},
                                       {d2, -d2, 0},
                                       {d2, 0, d2},
                                       {d2, 0, -d2},
                                       {0, d2, d2},
                                       {0, d2, -d2},
                                       {d3, d3, d3},
                                       {d3, d3, -d3},
                                       {d3, -d3, d3},
                                       {-d3, d3, d3}}};

/// Largest eigenvalue, by the roots of the cubic (Smith 1961, Commun. ACM 4:168): good to half of the digits.
double largest_eigenvalue(const Mat3& S) {
  const double mean = (S[0] + S[4] + S[8]) / 3, off = S[1] * S[1] + S[2] * S[2] + S[5] * S[5];
  const double a = S[0] - mean, b = S[4] - mean, c = S[8] - mean, p = std::sqrt((a * a + b * b + c * c + 2 * off) / 6);
  if (p == 0) return mean;
  const double determinant =
      a * (b * c - S[5] * S[5]) - S[1] * (S[1] * c - S[5] * S[2]) + S[2] * (S[1] * S[5] - b * S[2]);
  const double r = std::clamp(determinant / (2 * p * p * p), -1.0, 1.0);
  return mean + 2 * p * std::cos(std::acos(r) / 3);
}

struct Wave {
  double value;  // rho0 c^2 [Pa]
  Vec3 vector;
};
Wave largest_pair(const Mat3& S) {
  const Eigenpairs e = eigenpairs(S);
  const auto k = std::max_element(e.values.begin(), e.values.end()) - e.values.begin();
  return {e.values[k], e.vectors[k]};
}

/// a_ijkl as the square form of two vectors.
class Stiffness {
 public:
  Stiffness(const Mat9& A, const Mat3& F) {
    Mat9 half{};
    for (int iJ = 0; iJ < 9; ++iJ)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          for (int L = 0; L < 3; ++L) half[9 * iJ + 3 * k + l] += A[9 * iJ + 3 * k + L] * F[3 * l + L];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int J = 0; J < 3; ++J)
          for (int kl = 0; kl < 9; ++kl) a_[9 * (3 * i + j) + kl] += half[9 * (3 * i + J) + kl] * F[3 * j + J];
  }
  /// a_ijkl n_j n_l, its symmetric part.
  Mat3 acoustic(const Vec3& n) const {
    Mat3 Q{};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          for (int l = 0; l < 3; ++l) Q[3 * i + k] += a_[9 * (3 * i + j) + 3 * k + l] * n[j] * n[l];
    return symmetric(Q);
  }
  /// a_ijkl m_i m_k, its symmetric part.
  Mat3 of_motion(const Vec3& m) const {
    Mat3 R{};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          for (int l = 0; l < 3; ++l) R[3 * j + l] += a_[9 * (3 * i + j) + 3 * k + l] * m[i] * m[k];
    return symmetric(R);
  }

 private:
  static Mat3 symmetric(const Mat3& Q) {
    const double a = 0.5 * (Q[1] + Q[3]), b = 0.5 * (Q[2] + Q[6]), c = 0.5 * (Q[5] + Q[7]);
    return {Q[0], a, b, a, Q[4], c, b, c, Q[8]};
  }
  Mat9 a_{};
};

double climb(const Stiffness& stiffness, const Vec3& n) {
  Wave motion = largest_pair(stiffness.acoustic(n));
  for (int turn = 0; turn < most_turns; ++turn) {
    const Wave direction = largest_pair(stiffness.of_motion(motion.vector));
    const Wave next = largest_pair(stiffness.acoustic(direction.vector));
    const bool done = next.value - motion.value <= settled * std::abs(next.value);
    motion = next;
    if (done) break;
  }
  return motion.value;
}

void add_unit(const Vec3& x, std::vector<Vec3>& list) {
  const double length = norm(x);
  if (length > 0) list.push_back({x[0] / length, x[1] / length, x[2] / length});
}

double largest(const Mat9& A, const Mat3& F, const Vec3& fibre, const Vec3& second_fibre) {
  if (!std::all_of(A.begin(), A.end(), [](double x) { return std::isfinite(x); }))
    return std::numeric_limits<double>::quiet_NaN();
  const Stiffness stiffness(A, F);
  std::vector<Vec3> directions(spread.begin(), spread.end());
  for (const Vec3& axis : eigenpairs(multiply(F, transpose(F))).vectors) directions.push_back(axis);
  add_unit(multiply(F, fibre), directions);
  add_unit(multiply(F, second_fibre), directions);
  std::vector<std::pair<double, std::size_t>> heights;
  for (std::size_t k = 0; k < directions.size(); ++k)
    heights.emplace_back(-largest_eigenvalue(stiffness.acoustic(directions[k])), k);
  std::partial_sort(heights.begin(), heights.begin() + climbed, heights.end());
  double value = 0;
  for (int k = 0; k < climbed; ++k) value = std::max(value, climb(stiffness, directions[heights[k].second]));
  return value;
}

}  // namespace

void fastest_wave(const Material& material, const PointInput& in, double* speed) {
  std::vector<Mat3> P(in.n);
  std::vector<Mat9> A(in.n);
  whole_stress(material, in, P.data(), A.data());
  for (int p = 0; p < in.n; ++p) {
    const Vec3 fibre = in.fibre ? in.fibre[p] : material.fibre();
    const Vec3 second = in.second_fibre ? in.second_fibre[p] : material.second_fibre();
    speed[p] = std::sqrt(largest(A[p], in.F[p], fibre, second) / material.density());
  }
}

}  // namespace titin
