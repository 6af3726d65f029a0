#include "materials/maxwell.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace titin {
namespace {

constexpr int most_iterations = 40;
constexpr double converged = 1e-14;     // of logarithmic strains: round-off
constexpr double largest_change = 0.5;  // of a logarithmic strain in one iteration: exponential laws overflow beyond
constexpr double equal = 1e-6;          // relative distance of squared stretches that the limit formula serves

Vec3 solve3(const Mat3& A, const Vec3& b) { return multiply(inverse(A), b); }

/// Sum of x_a n_a (x) n_a.
Mat3 spectral(const Vec3& x, const std::array<Vec3, 3>& n) {
  Mat3 T{};
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) T[3 * i + j] += x[a] * n[a][i] * n[a][j];
  return T;
}

}  // namespace

void MaxwellFlow::bind(Section& s) {
  s.read("viscosity", viscosity,
         {.unit = "Pa s", .range = positive, .required = true, .doc = "eta_D of the change of shape"});
  if (s.describing() || s.has("bulk_viscosity")) {
    bulk_viscosity = 0;
    s.read("bulk_viscosity", bulk_viscosity,
           {.unit = "Pa s", .range = positive, .doc = "eta_V of the change of volume (default: volume does not flow)"});
  }
}

void MaxwellResponse::start(const PointInput&, double* row) const { std::fill_n(row, own_size, 0.0); }

void MaxwellResponse::evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const {
  std::vector<Point> points(in.n);
  for (int p = 0; p < in.n; ++p) {
    const double* old = history.old + p * history.stride;
    Mat3 Ci_inverse = full({old[1], old[2], old[3], old[4], old[5], old[6]});
    for (int i = 0; i < 3; ++i) Ci_inverse[4 * i] += 1;
    points[p].trial = eigenpairs(multiply(multiply(in.F[p], Ci_inverse), transpose(in.F[p])));
    for (int a = 0; a < 3; ++a)
      points[p].strain[a] = points[p].trial_strain[a] = 0.5 * std::log(points[p].trial.values[a]);
  }
  solve(points, in.dt, W);
  for (int p = 0; p < in.n; ++p)
    write(points[p], in.F[p], in.dt, history.old + p * history.stride, history.now + p * history.stride, P[p],
          A ? A + p : nullptr);
}

/// Newton's method on the flow equations of all points; at the end tau and the algorithmic moduli are those of the
/// step.
void MaxwellResponse::solve(std::vector<Point>& points, double dt, double* W) const {
  double largest = converged + 1;
  for (int i = 0; i < most_iterations && largest > converged; ++i) {
    pull(points, W);
    largest = 0;
    for (Point& point : points) largest = std::max(largest, correct(point, dt));
  }
  pull(points, W);
  for (Point& point : points) {
    correct(point, dt);  // round-off by now: called for the jacobian
    point.moduli = multiply(point.moduli, inverse(point.jacobian));
  }
}

/// The spring at F = diag(exp e): tau_a = P_aa l_a, d tau_a / d e_b = l_a A_aabb l_b + delta_ab tau_a.
void MaxwellResponse::pull(std::vector<Point>& points, double* W) const {
  const int n = static_cast<int>(points.size());
  std::vector<Mat3> F(n), P(n);
  std::vector<Mat9> A(n);
  for (int p = 0; p < n; ++p) {
    F[p] = {};
    for (int a = 0; a < 3; ++a) F[p][4 * a] = std::exp(points[p].strain[a]);
  }
  PointInput in;
  in.n = n;
  in.F = in.F_old = F.data();
  spring_->evaluate(in, {}, P.data(), A.data(), W);
  for (int p = 0; p < n; ++p)
    for (int a = 0; a < 3; ++a) {
      points[p].tau[a] = P[p][4 * a] * F[p][4 * a];
      for (int b = 0; b < 3; ++b)
        points[p].moduli[3 * a + b] =
            F[p][4 * a] * A[p][9 * 4 * a + 4 * b] * F[p][4 * b] + (a == b ? points[p].tau[a] : 0.0);
    }
}

/// One Newton correction of the strains; returns its size. Leaves the jacobian of the flow equations.
double MaxwellResponse::correct(Point& point, double dt) const {
  const double shape = dt / (2 * flow_.viscosity), volume = dt / (9 * flow_.bulk_viscosity);
  const double trace = point.tau[0] + point.tau[1] + point.tau[2];
  Vec3 r;
  for (int a = 0; a < 3; ++a) {
    r[a] = point.strain[a] - point.trial_strain[a] + shape * (point.tau[a] - trace / 3) + volume * trace;
    for (int b = 0; b < 3; ++b) {
      const double column = point.moduli[b] + point.moduli[3 + b] + point.moduli[6 + b];
      point.jacobian[3 * a + b] = (a == b) + shape * (point.moduli[3 * a + b] - column / 3) + volume * column;
    }
  }
  const Vec3 change = solve3(point.jacobian, r);
  double size = 0;
  for (int a = 0; a < 3; ++a) {
    point.strain[a] -= std::clamp(change[a], -largest_change, largest_change);
    size = std::max(size, std::abs(change[a]));
  }
  return size;
}

/// P = tau F^-T, the new history, and A[H] = (c : sym l + l tau) F^-T with l = H F^-1 and c in the trial's axes.
void MaxwellResponse::write(const Point& point, const Mat3& F, double dt, const double* old, double* now, Mat3& P,
                            Mat9* A) const {
  const auto& n = point.trial.vectors;
  const Vec3& x = point.trial.values;
  const Mat3 F_inverse = inverse(F), F_inverse_T = transpose(F_inverse), tau = spectral(point.tau, n);
  P = multiply(tau, F_inverse_T);
  Vec3 squares;
  for (int a = 0; a < 3; ++a) squares[a] = std::exp(2 * point.strain[a]);
  const Sym3 Ci_inverse = symmetric_part(multiply(multiply(F_inverse, spectral(squares, n)), F_inverse_T));
  const double trace = point.tau[0] + point.tau[1] + point.tau[2];
  double power = trace * trace / (9 * flow_.bulk_viscosity);
  for (int a = 0; a < 3; ++a) power += (point.tau[a] - trace / 3) * (point.tau[a] - trace / 3) / (2 * flow_.viscosity);
  now[0] = old[0] + dt * power;
  for (int c = 0; c < 6; ++c) now[1 + c] = Ci_inverse[c] - (c < 3 ? 1 : 0);
  if (!A) return;
  for (int k = 0; k < 3; ++k)
    for (int L = 0; L < 3; ++L) {
      Mat3 l{};
      for (int j = 0; j < 3; ++j) l[3 * k + j] = F_inverse[3 * L + j];
      Mat3 change{};  // c : sym l, summed over pairs of axes
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          const double d_ab = 0.5 * (dot(n[a], multiply(l, n[b])) + dot(n[b], multiply(l, n[a])));
          double c_ab = 0;
          if (a == b) {
            for (int e = 0; e < 3; ++e)
              c_ab += (point.moduli[3 * a + e] - (a == e ? 2 * point.tau[a] : 0.0)) * dot(n[e], multiply(l, n[e]));
          } else {
            const double gap = x[b] - x[a];
            const double t = std::abs(gap) > equal * x[a]
                                 ? (point.tau[b] * x[a] - point.tau[a] * x[b]) / gap
                                 : 0.5 * (point.moduli[4 * b] - point.moduli[3 * a + b]) - point.tau[a];
            c_ab = 2 * t * d_ab;
          }
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) change[3 * i + j] += c_ab * n[a][i] * n[b][j];
        }
      const Mat3 l_tau = multiply(l, tau);
      for (int i = 0; i < 9; ++i) change[i] += l_tau[i];
      const Mat3 dP = multiply(change, F_inverse_T);
      for (int i = 0; i < 9; ++i) (*A)[9 * i + 3 * k + L] = dP[i];
    }
}

}  // namespace titin
