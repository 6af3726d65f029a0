/// Piecewise polynomials: measured curves (force-length, force-velocity) given by their breakpoints and coefficients.
///
/// On [b_i, b_i+1) the value is the sum of c_ik s^k with s = x - b_i; outside of [b_0, b_n] the curve goes on constant
/// or along its tangent.
#pragma once

#include <array>
#include <cmath>

#include "math/dual.hpp"

namespace titin {

enum class Continuation { constant, linear };

template <int pieces, int degree>
struct Piecewise {
  using Polynomial = std::array<double, degree + 1>;  ///< ascending powers

  std::array<double, pieces + 1> breaks{};
  std::array<Polynomial, pieces> coefficients{};
  Continuation below = Continuation::constant, above = Continuation::constant;

  /// The curve at x, a plain or a dual number.
  template <class T>
  T operator()(const T& x) const {
    if (x < breaks.front()) return outside(x, 0, breaks.front(), below);
    if (x >= breaks.back()) return outside(x, pieces - 1, breaks.back(), above);
    const int i = piece(value_of(x));
    return horner(coefficients[i], x - breaks[i]);
  }

  /// The integral of p(x) / x from `from` to `to` (both > 0), in closed form: the energy that a fibre stores whose
  /// Kirchhoff stress is p of its stretch.
  double integral_over_x(double from, double to) const {
    if (to < from) return -integral_over_x(to, from);
    double sum = 0, left = from;
    if (left < breaks.front()) {
      const double right = std::min(to, breaks.front());
      sum += outside_over_x(0, breaks.front(), below, left, right);
      left = right;
    }
    for (int i = 0; i < pieces && left < to; ++i) {
      const double right = std::min(to, breaks[i + 1]);
      if (right > left) sum += polynomial_over_x(coefficients[i], breaks[i], left, right), left = right;
    }
    if (left < to) sum += outside_over_x(pieces - 1, breaks.back(), above, left, to);
    return sum;
  }

 private:
  int piece(double x) const {
    int i = 0;
    while (i + 1 < pieces && x >= breaks[i + 1]) ++i;
    return i;
  }
  template <class T>
  static T horner(const Polynomial& c, const T& s) {
    T p = c[degree];
    for (int k = degree - 1; k >= 0; --k) p = p * s + c[k];
    return p;
  }
  /// Value and slope of piece i at x, which continue the curve.
  Polynomial tangent(int i, double x, Continuation how) const {
    const Dual<1, 1> p = horner(coefficients[i], Dual<1, 1>::variable(x - breaks[i], 0));
    Polynomial line{};
    line[0] = p.value;
    if (how == Continuation::linear) line[1] = p.gradient[0];
    return line;
  }
  template <class T>
  T outside(const T& x, int i, double end, Continuation how) const {
    return horner(tangent(i, end, how), x - end);
  }
  double outside_over_x(int i, double end, Continuation how, double from, double to) const {
    return polynomial_over_x(tangent(i, end, how), end, from, to);
  }
  /// With s = x - b: p(s) = q(s) (s + b) + r, so that p/x integrates to the integral of q and r ln x.
  static double polynomial_over_x(const Polynomial& p, double b, double from, double to) {
    Polynomial q{};
    double r = p[degree];
    for (int k = degree - 1; k >= 0; --k) {
      q[k] = r;
      r = p[k] - b * r;
    }
    const auto primitive = [&](double s) {
      double sum = 0;
      for (int k = degree - 1; k >= 0; --k) sum = (sum + q[k] / (k + 1)) * s;
      return sum;
    };
    return primitive(to - b) - primitive(from - b) + r * std::log(to / from);
  }
};

}  // namespace titin
