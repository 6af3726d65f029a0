/// Forward dual numbers: a value with its derivatives in M directions, of first order (gradient) or of second order
/// (gradient and Hessian), carried through +, -, *, / and the elementary functions by the chain rule.
///
/// A law written once for a number type T gives its derivatives when T is a Dual: exact, no step size, no tape.
/// Comparisons look at the value alone, so that branches work; at a kink the derivative is that of the branch taken.
#pragma once

#include <array>
#include <cmath>
#include <compare>

namespace titin {

template <int M, int order = 2>
struct Dual {
  static_assert(M >= 1 && (order == 1 || order == 2));
  static constexpr int pairs = order == 2 ? M * (M + 1) / 2 : 0;

  double value = 0;
  std::array<double, M> gradient{};
  std::array<double, pairs> hessian{};  ///< entries a <= b, see pair()

  constexpr Dual() = default;
  constexpr Dual(double x) : value(x) {}
  /// The independent variable of one direction.
  static constexpr Dual variable(double x, int direction) {
    Dual d(x);
    d.gradient[direction] = 1;
    return d;
  }
  /// Where the second derivative in directions a and b is kept.
  static constexpr int pair(int a, int b) { return a <= b ? a * (2 * M - a - 1) / 2 + b : pair(b, a); }

  Dual& operator+=(const Dual& y) { return *this = *this + y; }
  Dual& operator-=(const Dual& y) { return *this = *this - y; }
  Dual& operator*=(const Dual& y) { return *this = *this * y; }
  Dual& operator/=(const Dual& y) { return *this = *this / y; }

  friend Dual operator+(const Dual& x, const Dual& y) { return combine(x, y, x.value + y.value, 1, 1); }
  friend Dual operator-(const Dual& x, const Dual& y) { return combine(x, y, x.value - y.value, 1, -1); }
  friend Dual operator-(const Dual& x) { return chain(x, -x.value, -1, 0); }
  friend Dual operator*(const Dual& x, const Dual& y) {
    Dual z = combine(x, y, x.value * y.value, y.value, x.value);
    if constexpr (order == 2)
      for (int a = 0; a < M; ++a)
        for (int b = a; b < M; ++b)
          z.hessian[pair(a, b)] += x.gradient[a] * y.gradient[b] + x.gradient[b] * y.gradient[a];
    return z;
  }
  friend Dual operator/(const Dual& x, const Dual& y) {
    const double r = 1 / y.value;
    return x * chain(y, r, -r * r, 2 * r * r * r);
  }
  // A plain number costs no products with its zero derivatives.
  friend Dual operator+(const Dual& x, double c) { return shifted(x, x.value + c); }
  friend Dual operator+(double c, const Dual& x) { return shifted(x, c + x.value); }
  friend Dual operator-(const Dual& x, double c) { return shifted(x, x.value - c); }
  friend Dual operator-(double c, const Dual& x) { return chain(x, c - x.value, -1, 0); }
  friend Dual operator*(const Dual& x, double c) { return scaled(x, c); }
  friend Dual operator*(double c, const Dual& x) { return scaled(x, c); }
  friend Dual operator/(const Dual& x, double c) { return scaled(x, 1 / c); }
  friend Dual operator/(double c, const Dual& x) {
    const double r = 1 / x.value;
    return chain(x, c * r, -c * r * r, 2 * c * r * r * r);
  }

  friend bool operator==(const Dual& x, const Dual& y) { return x.value == y.value; }
  friend std::partial_ordering operator<=>(const Dual& x, const Dual& y) { return x.value <=> y.value; }
  friend bool operator==(const Dual& x, double y) { return x.value == y; }
  friend std::partial_ordering operator<=>(const Dual& x, double y) { return x.value <=> y; }

  /// f(x) from the value and the first two derivatives of f at x.
  friend Dual chain(const Dual& x, double f, double df, double d2f) {
    Dual z(f);
    for (int a = 0; a < M; ++a) z.gradient[a] = df * x.gradient[a];
    if constexpr (order == 2)
      for (int a = 0; a < M; ++a)
        for (int b = a; b < M; ++b)
          z.hessian[pair(a, b)] = df * x.hessian[pair(a, b)] + d2f * x.gradient[a] * x.gradient[b];
    return z;
  }

 private:
  static Dual combine(const Dual& x, const Dual& y, double f, double fx, double fy) {
    Dual z(f);
    for (int a = 0; a < M; ++a) z.gradient[a] = fx * x.gradient[a] + fy * y.gradient[a];
    for (int k = 0; k < pairs; ++k) z.hessian[k] = fx * x.hessian[k] + fy * y.hessian[k];
    return z;
  }
  static Dual shifted(Dual x, double f) {
    x.value = f;
    return x;
  }
  static Dual scaled(const Dual& x, double c) {
    Dual z(c * x.value);
    for (int a = 0; a < M; ++a) z.gradient[a] = c * x.gradient[a];
    for (int k = 0; k < pairs; ++k) z.hessian[k] = c * x.hessian[k];
    return z;
  }
};

template <int M, int order>
Dual<M, order> sqrt(const Dual<M, order>& x) {
  const double r = std::sqrt(x.value);
  return chain(x, r, 0.5 / r, -0.25 / (r * x.value));
}
template <int M, int order>
Dual<M, order> exp(const Dual<M, order>& x) {
  const double e = std::exp(x.value);
  return chain(x, e, e, e);
}
template <int M, int order>
Dual<M, order> expm1(const Dual<M, order>& x) {
  const double e = std::expm1(x.value);
  return chain(x, e, e + 1, e + 1);
}
template <int M, int order>
Dual<M, order> log(const Dual<M, order>& x) {
  const double r = 1 / x.value;
  return chain(x, std::log(x.value), r, -r * r);
}
template <int M, int order>
Dual<M, order> log1p(const Dual<M, order>& x) {
  const double r = 1 / (1 + x.value);
  return chain(x, std::log1p(x.value), r, -r * r);
}
template <int M, int order>
Dual<M, order> sin(const Dual<M, order>& x) {
  const double s = std::sin(x.value), c = std::cos(x.value);
  return chain(x, s, c, -s);
}
template <int M, int order>
Dual<M, order> cos(const Dual<M, order>& x) {
  const double s = std::sin(x.value), c = std::cos(x.value);
  return chain(x, c, -s, -c);
}
template <int M, int order>
Dual<M, order> pow(const Dual<M, order>& x, double n) {
  const double p = std::pow(x.value, n - 2);
  return chain(x, p * x.value * x.value, n * p * x.value, n * (n - 1) * p);
}

/// The number without its derivatives.
inline double value_of(double x) { return x; }
template <int M, int order>
double value_of(const Dual<M, order>& x) {
  return x.value;
}

}  // namespace titin
