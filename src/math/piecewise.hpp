/// Piecewise polynomials: measured curves (force-length, force-velocity) given by their breakpoints and coefficients.
///
/// On [b_i, b_i+1) the value is the sum of c_ik s^k with s = x - b_i; outside of [b_0, b_n] the curve goes on constant
/// or along its tangent.
#pragma once

#include <algorithm>
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

  /// The integral of p(x) from `from` to `to`.
  double integral(double from, double to) const { return sum_parts(polynomial_integral, from, to); }

  /// The integral of p(x) / x from `from` to `to` (both > 0), in closed form: the energy that a fibre stores whose
  /// Kirchhoff stress is p of its stretch.
  double integral_over_x(double from, double to) const { return sum_parts(polynomial_over_x, from, to); }

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
  /// Sum of part(polynomial, its origin, left, right) over the pieces between `from` and `to`.
  template <class Part>
  double sum_parts(Part part, double from, double to) const {
    if (to < from) return -sum_parts(part, to, from);
    double sum = 0;
    const auto take = [&](const Polynomial& p, double origin, double left, double right) {
      if (right > left) sum += part(p, origin, left, right);
    };
    take(tangent(0, breaks.front(), below), breaks.front(), from, std::min(to, breaks.front()));
    for (int i = 0; i < pieces; ++i)
      take(coefficients[i], breaks[i], std::max(from, breaks[i]), std::min(to, breaks[i + 1]));
    take(tangent(pieces - 1, breaks.back(), above), breaks.back(), std::max(from, breaks.back()), to);
    return sum;
  }
  static double primitive(const Polynomial& p, double s) {
    double sum = 0;
    for (int k = degree; k >= 0; --k) sum = (sum + p[k] / (k + 1)) * s;
    return sum;
  }
  static double polynomial_integral(const Polynomial& p, double b, double from, double to) {
    return primitive(p, to - b) - primitive(p, from - b);
  }
  /// With s = x - b: p(s) = q(s) (s + b) + r, so that p/x integrates to the integral of q and r ln x.
  static double polynomial_over_x(const Polynomial& p, double b, double from, double to) {
    Polynomial q{};
    double r = p[degree];
    for (int k = degree - 1; k >= 0; --k) {
      q[k] = r;
      r = p[k] - b * r;
    }
    return primitive(q, to - b) - primitive(q, from - b) + r * std::log(to / from);
  }
};

}  // namespace titin
