/// A smooth function on an interval, kept as Taylor polynomials about the midpoints of equal cells: for functions that
/// cost many sines or exponentials a point. Exact to round-off when the cells are small enough, which a test has to
/// show.
#pragma once

#include <array>

#include "math/dual.hpp"

namespace titin {

template <int cells, int degree>
class TaylorTable {
 public:
  /// `derivative(x, k)` is the k-th derivative at x.
  template <class Derivative>
  TaylorTable(double begin, double end, Derivative derivative) : begin_(begin), width_((end - begin) / cells) {
    for (int i = 0; i < cells; ++i) {
      double factorial = 1;
      for (int k = 0; k <= degree; ++k) {
        coefficients_[i][k] = derivative(midpoint(i), k) / factorial;
        factorial *= k + 1;
      }
    }
  }

  /// The function at x in [begin, end], a plain or a dual number.
  template <class T>
  T operator()(const T& x) const {
    const int i = cell(value_of(x));
    const auto& c = coefficients_[i];
    const T s = x - midpoint(i);
    T p = c[degree];
    for (int k = degree - 1; k >= 0; --k) p = p * s + c[k];
    return p;
  }

 private:
  double midpoint(int i) const { return begin_ + (i + 0.5) * width_; }
  int cell(double x) const {
    const double i = (x - begin_) / width_;
    if (!(i > 0)) return 0;  // also what is not a number
    return i < cells ? static_cast<int>(i) : cells - 1;
  }

  double begin_, width_;
  std::array<std::array<double, degree + 1>, cells> coefficients_;
};

}  // namespace titin
