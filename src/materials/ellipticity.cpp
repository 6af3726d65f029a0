#include "materials/ellipticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "materials/compressible.hpp"
#include "math/spectral.hpp"
#include "math/symmetric.hpp"

namespace titin {
namespace {

constexpr int grid_size = 240;        // directions of a half sphere, 9 degrees apart
constexpr int most_valleys = 6;       // places of the grid that are followed down
constexpr double same_valley = 0.93;  // cosine of 21 degrees
constexpr int most_iterations = 40;
constexpr double longest_step = 0.3;  // [rad]
constexpr double flat = 1e-12;        // slope over stiffness: the value is then right to its square

constexpr std::array<std::pair<int, int>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Nearly equal areas: the spiral of the golden angle.
std::vector<Vec3> half_sphere() {
  std::vector<Vec3> directions;
  const double angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < grid_size; ++k) {
    const double z = (k + 0.5) / grid_size, r = std::sqrt(1 - z * z);
    directions.push_back({r * std::cos(k * angle), r * std::sin(k * angle), z});
  }
  return directions;
}

/// n_J t_L + t_J n_L as coefficients of the form below.
Sym3 product(const Vec3& n, const Vec3& t) {
  Sym3 s;
  for (int w = 0; w < 6; ++w) s[w] = n[pairs[w].first] * t[pairs[w].second] + t[pairs[w].first] * n[pairs[w].second];
  return s;
}

double form(const Vec3& a, const Sym3& S, const Vec3& b) { return dot(a, multiply(full(S), b)); }

/// The symmetric acoustic tensor as a form in n: Q_v = sum_w form_vw n_J n_L.
class AcousticForm {
 public:
  explicit AcousticForm(const Mat9& A) {
    for (int v = 0; v < 6; ++v)
      for (int w = 0; w < 6; ++w) {
        const auto [i, k] = pairs[v];
        const auto [J, L] = pairs[w];
        const double sum = entry(A, i, J, k, L) + entry(A, k, J, i, L) + entry(A, i, L, k, J) + entry(A, k, L, i, J);
        form_[v][w] = 0.25 * sum * (J == L ? 1 : 2);
      }
  }
  Sym3 apply(const Sym3& product) const {
    Sym3 Q{};
    for (int v = 0; v < 6; ++v)
      for (int w = 0; w < 6; ++w) Q[v] += 0.5 * form_[v][w] * product[w];
    return Q;
  }
  /// Eigenpairs of Q(n), the smallest first.
  Eigenpairs eigen(const Vec3& n) const {
    Eigenpairs e = eigenpairs(full(apply(product(n, n))));
    const auto least = std::min_element(e.values.begin(), e.values.end()) - e.values.begin();
    std::swap(e.values[0], e.values[least]);
    std::swap(e.vectors[0], e.vectors[least]);
    return e;
  }

 private:
  static double entry(const Mat9& A, int i, int J, int k, int L) { return A[9 * (3 * i + J) + 3 * k + L]; }
  std::array<std::array<double, 6>, 6> form_;
};

/// Slope and curvature of the smallest eigenvalue on the sphere, along two tangents at n.
struct Surface {
  std::array<Vec3, 2> tangent;
  std::array<double, 2> slope;
  double H00, H01, H11;
};

std::array<Vec3, 2> tangents(const Vec3& n) {
  Vec3 along{};
  along[std::abs(n[0]) < 0.6 ? 0 : 1] = 1;
  const double c = dot(along, n);
  for (int i = 0; i < 3; ++i) along[i] -= c * n[i];
  const double length = norm(along);
  for (double& x : along) x /= length;
  const Vec3 other{n[1] * along[2] - n[2] * along[1], n[2] * along[0] - n[0] * along[2],
                   n[0] * along[1] - n[1] * along[0]};
  return {along, other};
}

/// Second-order perturbation of a simple eigenvalue; the sphere's own curvature takes 2 lambda off.
Surface surface(const AcousticForm& Q, const Vec3& n, const Eigenpairs& e) {
  Surface s;
  s.tangent = tangents(n);
  std::array<std::array<double, 3>, 2> coupling;  // a_j . Q'(t) a_0
  for (int t = 0; t < 2; ++t) {
    Sym3 dQ = Q.apply(product(n, s.tangent[t]));
    for (double& x : dQ) x *= 2;
    for (int j = 0; j < 3; ++j) coupling[t][j] = form(e.vectors[j], dQ, e.vectors[0]);
    s.slope[t] = coupling[t][0];
  }
  const double scale = std::max({std::abs(e.values[0]), std::abs(e.values[1]), std::abs(e.values[2])});
  const auto curvature = [&](int t, int u) {
    double sum = 2 * form(e.vectors[0], Q.apply(product(s.tangent[t], s.tangent[u])), e.vectors[0]);
    if (t == u) sum -= 2 * e.values[0];
    for (int j = 1; j < 3; ++j) {
      const double gap = e.values[j] - e.values[0];
      if (gap > 1e-10 * scale) sum -= 2 * coupling[t][j] * coupling[u][j] / gap;
    }
    return sum;
  };
  s.H00 = curvature(0, 0), s.H01 = curvature(0, 1), s.H11 = curvature(1, 1);
  return s;
}

/// Newton's step, turned downhill where the surface is not convex and kept short.
std::array<double, 2> downhill(const Surface& s) {
  const double mean = 0.5 * (s.H00 + s.H11), half = 0.5 * (s.H00 - s.H11), radius = std::hypot(half, s.H01);
  const double angle = 0.5 * std::atan2(s.H01, half), c = std::cos(angle), d = std::sin(angle);
  const double size = std::abs(mean) + radius, floor = 1e-8 * size + std::numeric_limits<double>::min();
  const double along = -(c * s.slope[0] + d * s.slope[1]) / std::max(std::abs(mean + radius), floor);
  const double across = -(-d * s.slope[0] + c * s.slope[1]) / std::max(std::abs(mean - radius), floor);
  const double length = std::hypot(along, across), keep = length > longest_step ? longest_step / length : 1;
  return {keep * (c * along - d * across), keep * (d * along + c * across)};
}

Vec3 moved(const Vec3& n, const Surface& s, const std::array<double, 2>& step, double part) {
  Vec3 to;
  for (int i = 0; i < 3; ++i) to[i] = n[i] + part * (step[0] * s.tangent[0][i] + step[1] * s.tangent[1][i]);
  const double length = norm(to);
  for (double& x : to) x /= length;
  return to;
}

AcousticValue descend(const AcousticForm& Q, Vec3 n) {
  Eigenpairs e = Q.eigen(n);
  for (int k = 0; k < most_iterations; ++k) {
    const Surface s = surface(Q, n, e);
    const double stiffness = std::max(std::abs(e.values[1]), std::abs(e.values[2]));
    if (std::hypot(s.slope[0], s.slope[1]) <= flat * stiffness) break;
    const auto step = downhill(s);
    double part = 1;
    Vec3 next = moved(n, s, step, part);
    Eigenpairs e_next = Q.eigen(next);
    while (e_next.values[0] >= e.values[0] && part > 1e-6) {
      next = moved(n, s, step, part *= 0.25);
      e_next = Q.eigen(next);
    }
    if (!(e_next.values[0] < e.values[0])) break;
    n = next, e = e_next;
  }
  return {e.values[0], n, e.vectors[0]};
}

/// A_iJkL F_jJ F_lL: the same waves seen by directions of the deformed body.
Mat9 pushed(const Mat9& A, const Mat3& F) {
  Mat9 half{}, a{};
  for (int iJ = 0; iJ < 9; ++iJ)
    for (int kl = 0; kl < 9; ++kl)
      for (int L = 0; L < 3; ++L) half[9 * iJ + kl] += A[9 * iJ + 3 * (kl / 3) + L] * F[3 * (kl % 3) + L];
  for (int ij = 0; ij < 9; ++ij)
    for (int kl = 0; kl < 9; ++kl)
      for (int J = 0; J < 3; ++J) a[9 * ij + kl] += half[9 * (3 * (ij / 3) + J) + kl] * F[3 * (ij % 3) + J];
  return a;
}

}  // namespace

AcousticValue smallest_acoustic(const Mat9& A) {
  static const std::vector<Vec3> grid = half_sphere();
  if (!std::all_of(A.begin(), A.end(), [](double x) { return std::isfinite(x); })) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, {none, none, none}, {none, none, none}};
  }
  const AcousticForm Q(A);
  std::vector<std::pair<double, int>> heights;
  for (int k = 0; k < grid_size; ++k) heights.emplace_back(Q.eigen(grid[k]).values[0], k);
  std::sort(heights.begin(), heights.end());
  std::vector<Vec3> starts;
  AcousticValue best{std::numeric_limits<double>::infinity(), {}, {}};
  for (const auto& [height, k] : heights) {
    const auto near = [&](const Vec3& n) { return std::abs(dot(n, grid[k])) > same_valley; };
    if (std::any_of(starts.begin(), starts.end(), near)) continue;
    starts.push_back(grid[k]);
    const AcousticValue found = descend(Q, grid[k]);
    if (found.value < best.value) best = found;
    if (starts.size() == most_valleys) break;
  }
  return best;
}

AcousticValue largest_acoustic(const Mat9& A) {
  Mat9 turned = A;
  for (double& x : turned) x = -x;
  AcousticValue found = smallest_acoustic(turned);
  found.value = -found.value;
  return found;
}

void legendre_hadamard(const Material& material, const PointInput& in, AcousticValue* values) {
  std::vector<Mat3> P(in.n);
  std::vector<Mat9> A(in.n);
  whole_stress(material, in, P.data(), A.data());
  for (int p = 0; p < in.n; ++p) values[p] = smallest_acoustic(A[p]);
}

void wave_speed(const Material& material, const PointInput& in, double* speed) {
  std::vector<Mat3> P(in.n);
  std::vector<Mat9> A(in.n);
  whole_stress(material, in, P.data(), A.data());
  for (int p = 0; p < in.n; ++p)
    speed[p] = std::sqrt(largest_acoustic(pushed(A[p], in.F[p])).value / material.density());
}

}  // namespace titin
