#include "fv/radial_gas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace titin {
namespace {

constexpr double courant = 0.45;

using State = std::array<double, 3>;  // rho, u, p or what is conserved

class RadialSolver {
 public:
  RadialSolver(const Explosion::Setup& setup, int dimension)
      : gamma_(setup.gamma), width_(setup.end / setup.shells), q_(setup.shells) {
    for (int i = 0; i < setup.shells; ++i) {
      const auto& side = (i + 0.5) * width_ < setup.radius ? setup.inside : setup.outside;
      q_[i] = conserved({side.density, 0, side.pressure});
    }
    for (int i = 0; i <= setup.shells; ++i) {
      area_.push_back(std::pow(i * width_, dimension - 1));
      if (i > 0)
        volume_.push_back((std::pow(i * width_, dimension) - std::pow((i - 1) * width_, dimension)) / dimension);
    }
  }

  void run_to(double end) {
    for (double t = 0; t < end;) {
      double fastest = 0;
      for (const State& q : q_) {
        const State w = primitive(q);
        fastest = std::max(fastest, std::abs(w[1]) + sound(w));
      }
      const double dt = std::min(courant * width_ / fastest, end - t);
      const std::vector<State> start = q_;
      add_euler_step(dt);
      add_euler_step(dt);
      for (std::size_t i = 0; i < q_.size(); ++i)
        for (int k = 0; k < 3; ++k) q_[i][k] = 0.5 * (start[i][k] + q_[i][k]);
      t += dt;
    }
  }

  State shell(int i) const { return primitive(q_[i]); }
  double width() const { return width_; }

 private:
  State conserved(const State& w) const { return {w[0], w[0] * w[1], w[2] / (gamma_ - 1) + 0.5 * w[0] * w[1] * w[1]}; }
  State primitive(const State& q) const {
    return {q[0], q[1] / q[0], (gamma_ - 1) * (q[2] - 0.5 * q[1] * q[1] / q[0])};
  }
  double sound(const State& w) const { return std::sqrt(gamma_ * w[2] / w[0]); }

  /// Toro 2009, secs. 10.4-10.6.
  State flux(const State& l, const State& r) const {
    const double cl = sound(l), cr = sound(r);
    const double left = std::min(l[1] - cl, r[1] - cr), right = std::max(l[1] + cl, r[1] + cr);
    const double ml = l[0] * (left - l[1]), mr = r[0] * (right - r[1]);
    const double contact = (r[2] - l[2] + ml * l[1] - mr * r[1]) / (ml - mr);
    const auto side = [&](const State& w, double fast) {
      const State q = conserved(w);
      State F{q[1], q[1] * w[1] + w[2], w[1] * (q[2] + w[2])};
      if ((fast < 0) != (contact < 0) || fast == 0) {  // between this wave and the contact
        const double factor = w[0] * (fast - w[1]) / (fast - contact);
        const State star{factor, factor * contact,
                         factor * (q[2] / w[0] + (contact - w[1]) * (contact + w[2] / (w[0] * (fast - w[1]))))};
        for (int k = 0; k < 3; ++k) F[k] += fast * (star[k] - q[k]);
      }
      return F;
    };
    return contact >= 0 ? side(l, left) : side(r, right);
  }

  static double slope(double before, double after) {
    return before * after > 0 ? 2 * before * after / (before + after) : 0;
  }

  void add_euler_step(double dt) {
    const int n = static_cast<int>(q_.size());
    std::vector<State> w(n + 2), F(n + 1);
    for (int i = 0; i < n; ++i) w[i + 1] = primitive(q_[i]);
    w[0] = w[1], w[0][1] = -w[0][1];  // mirror at the origin
    w[n + 1] = w[n];
    std::vector<State> s(n + 2);
    for (int i = 1; i <= n; ++i)
      for (int k = 0; k < 3; ++k) s[i][k] = slope(w[i][k] - w[i - 1][k], w[i + 1][k] - w[i][k]);
    s[0] = s[1], s[0][0] = -s[1][0], s[0][2] = -s[1][2];
    for (int i = 0; i <= n; ++i) {
      State l, r;
      for (int k = 0; k < 3; ++k) l[k] = w[i][k] + 0.5 * s[i][k], r[k] = w[i + 1][k] - 0.5 * s[i + 1][k];
      F[i] = flux(l, r);
    }
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 3; ++k) q_[i][k] += dt / volume_[i] * (area_[i] * F[i][k] - area_[i + 1] * F[i + 1][k]);
      q_[i][1] += dt / volume_[i] * w[i + 1][2] * (area_[i + 1] - area_[i]);
    }
  }

  double gamma_, width_;
  std::vector<State> q_;               // conserved, of each shell
  std::vector<double> area_, volume_;  // of faces and shells, over 2 pi or 4 pi
};

}  // namespace

FlowPoint RadialProfile::at(double radius) const {
  const double place = std::clamp(radius / width - 0.5, 0.0, double(density.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), density.size() - 2);
  const double s = place - i;
  const auto between = [&](const std::vector<double>& f) { return (1 - s) * f[i] + s * f[i + 1]; };
  return {between(density), between(pressure), {between(velocity), 0, 0}};
}

RadialProfile Explosion::profile(double t) const {
  RadialSolver solver(setup_, dimension_);
  solver.run_to(t);
  RadialProfile profile{t, solver.width(), {}, {}, {}};
  for (int i = 0; i < setup_.shells; ++i) {
    const auto w = solver.shell(i);
    profile.density.push_back(w[0]);
    profile.velocity.push_back(w[1]);
    profile.pressure.push_back(w[2]);
  }
  return profile;
}

FlowPoint Explosion::at(const Vec3& x, double t) const {
  const double r = norm(x);
  if (t == 0) {
    const Side& side = r < setup_.radius ? setup_.inside : setup_.outside;
    return {side.density, side.pressure, {}};
  }
  if (known_.density.empty() || known_.time != t) known_ = profile(t);
  FlowPoint point = known_.at(r);
  const double speed = point.velocity[0];
  for (int i = 0; i < 3; ++i) point.velocity[i] = r > 0 ? speed * x[i] / r : 0;
  return point;
}

}  // namespace titin
