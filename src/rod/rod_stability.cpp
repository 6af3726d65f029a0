#include "rod/rod_stability.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rod/lapack.hpp"

namespace titin {
namespace {

/// An s this much faster than the slowest time scale of the matrices is an infinite one: of nodes without mass.
constexpr double infinite = 1e-13;

/// M, C and K of the nodes that are free.
struct SmallMotion {
  BandMatrix M, C, K;
  std::vector<int> free;

  SmallMotion(RodSystem& system, const mfem::Vector& u, double time)
      : M(system.lattice().mass()), C(system.lattice().matrix()), K(system.lattice().matrix()) {
    const std::size_t points = system.lattice().points().size();
    std::vector<double> stiffness(points), viscosity(points);
    const std::vector<double> slope = system.lattice().gradients(u);
    for (const RodSystem::Part& part : system.parts())
      for (int p = 0; p < part.count; ++p) {
        const int row = part.law.material().history_size();
        const auto linear =
            part.law.linearise(1 + slope[part.first + p], time, row ? system.history(part) + p * row : nullptr);
        stiffness[part.first + p] = linear.stiffness;
        viscosity[part.first + p] = system.config().rate() == FibreRate::none ? 0 : linear.viscosity;
      }
    system.lattice().add_stiffness(stiffness, K);
    system.lattice().add_stiffness(viscosity, C);
    for (int i = 0; i < K.size(); ++i)
      if (system.given().Find(i) < 0) free.push_back(i);
  }
};

}  // namespace

/// With y = (x, s x):  [0 1; -K -C] y = s [1 0; 0 M] y. Time is measured in units of `unit`, forces per length in those
/// of K, so that the matrices have entries near 1.
std::vector<std::complex<double>> growth_rates(RodSystem& system, const mfem::Vector& u, double time) {
  const SmallMotion motion(system, u, time);
  const int n = static_cast<int>(motion.free.size()), size = 2 * n;
  double stiffest = 0, heaviest = 0, most_viscous = 0;
  for (int i : motion.free) {
    stiffest = std::max(stiffest, std::abs(motion.K(i, i)));
    heaviest = std::max(heaviest, motion.M(i, i));
    most_viscous = std::max(most_viscous, std::abs(motion.C(i, i)));
  }
  if (stiffest == 0) return {};
  const double unit = heaviest > 0 ? std::sqrt(heaviest / stiffest) : std::max(most_viscous / stiffest, 1e-300);
  std::vector<double> A(std::size_t(size) * size), B(A.size()), real(size), imaginary(size), beta(size);
  const auto at = [size](int i, int j) { return std::size_t(size) * j + i; };
  for (int a = 0; a < n; ++a) {
    A[at(a, n + a)] = B[at(a, a)] = 1;
    for (int b = 0; b < n; ++b) {
      const int i = motion.free[a], j = motion.free[b];
      A[at(n + a, b)] = -motion.K(i, j) / stiffest;
      A[at(n + a, n + b)] = -motion.C(i, j) / (stiffest * unit);
      B[at(n + a, n + b)] = motion.M(i, j) / (stiffest * unit * unit);
    }
  }
  const int one = 1, work_size = 16 * size;
  std::vector<double> work(work_size);
  int info = 0;
  dggev_("N", "N", &size, A.data(), &size, B.data(), &size, real.data(), imaginary.data(), beta.data(), nullptr, &one,
         nullptr, &one, work.data(), &work_size, &info);
  if (info != 0) throw std::runtime_error("LAPACK found no eigenvalues of a rod's small motions");
  std::vector<std::complex<double>> rates;
  for (int k = 0; k < size; ++k)
    if (std::abs(beta[k]) > infinite * std::hypot(real[k], imaginary[k]))
      rates.emplace_back(real[k] / beta[k] / unit, imaginary[k] / beta[k] / unit);
  std::sort(rates.begin(), rates.end(), [](const auto& a, const auto& b) { return a.real() > b.real(); });
  return rates;
}

std::vector<double> squared_frequencies(RodSystem& system, const mfem::Vector& u, double time) {
  const SmallMotion motion(system, u, time);
  const int n = static_cast<int>(motion.free.size()), half = motion.K.half(), rows = half + 1, one = 1;
  std::vector<double> A(std::size_t(rows) * n), B(A.size()), w(n), work(3 * n);
  for (int j = 0; j < n; ++j)
    for (int i = std::max(0, j - half); i <= j; ++i) {
      A[std::size_t(rows) * j + half + i - j] = motion.K(motion.free[i], motion.free[j]);
      B[std::size_t(rows) * j + half + i - j] = motion.M(motion.free[i], motion.free[j]);
    }
  int info = 0;
  dsbgv_("N", "U", &n, &half, &half, A.data(), &rows, B.data(), &rows, w.data(), nullptr, &one, work.data(), &info);
  if (info != 0) throw std::runtime_error("LAPACK found no eigenfrequencies: does every free node have mass?");
  return w;
}

}  // namespace titin
