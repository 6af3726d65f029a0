#include "rod/rod_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace titin {
namespace {

constexpr int most_cuts = 12;
constexpr double armijo = 1e-4;  // asked decrease of |R|, as usual
constexpr double still = 1e-12;  // a change below this part of the rod is round-off

/// How far off nodes are whose displacement is given [m].
double gap(const RodSystem& system, const mfem::Vector& given, const mfem::Vector& u) {
  double largest = 0;
  for (int node : system.given()) largest = std::max(largest, std::abs(u(node) - given(node)));
  return largest;
}

/// u - s y with the first s of 1, 1/2, ... that lowers |R|, else the best seen. False when none is in the domain.
bool search(RodSystem& system, const mfem::Vector& y, double norm, mfem::Vector& u, mfem::Vector& R) {
  const mfem::Vector start(u);
  double s = 1, best = 0, best_norm = std::numeric_limits<double>::infinity();
  for (int cut = 0; cut <= most_cuts; ++cut, s *= 0.5) {
    add(start, -s, y, u);
    if (!system.residual(u, R)) continue;
    const double now = R.Norml2();
    if (now < best_norm) best = s, best_norm = now;
    if (now <= (1 - armijo * s) * norm) return true;
  }
  if (best == 0) return false;
  add(start, -best, y, u);
  return system.residual(u, R);
}

}  // namespace

NewtonResult solve_rod(RodSystem& system, const mfem::Vector& given, mfem::Vector& u) {
  const RodConfig& config = system.config();
  NewtonResult result;
  const auto fail = [&](const std::string& why) {
    result.failure = why;
    return result;
  };
  mfem::Vector R(u.Size());
  if (!system.residual(u, R)) return fail(system.domain_error());
  double change = std::numeric_limits<double>::infinity();
  const double length = system.lattice().X().back();
  for (;; ++result.iterations) {
    const double norm = R.Norml2(), scale = system.force_scale();
    result.residual = scale > 0 ? norm / scale : norm;
    result.residuals.push_back(result.residual);
    if (!std::isfinite(norm)) return fail("the residual is not a finite number");
    const bool there = gap(system, given, u) == 0;
    if (there && (norm <= config.tolerance * scale || change <= still * length)) return result;
    if (result.iterations == config.max_iterations)
      return fail(fmt::format("residual {:.1e} is above the tolerance {:.1e} after {} Newton iterations",
                              result.residual, config.tolerance, result.iterations));
    mfem::Vector y(R);
    for (int node : system.given()) y(node) = u(node) - given(node);
    if (!system.tangent(u).solve(y)) return fail("the tangent is singular");
    change = y.Normlinf();
    if (there && !search(system, y, norm, u, R)) return fail(system.domain_error());
    if (there) continue;
    u -= y;
    for (int node : system.given()) u(node) = given(node);
    if (!system.residual(u, R)) return fail(system.domain_error());
  }
}

}  // namespace titin
