/// Integrals of smooth functions of one variable to round-off.
#pragma once

#include <cmath>

namespace titin {

/// Gauss-Legendre with eight points on each of `panels` equal parts of [from, to]: exact for polynomials of degree 15.
/// Abscissae and weights: Abramowitz & Stegun, table 25.4.
template <class Function>
double integrate(Function f, double from, double to, int panels = 1) {
  constexpr double x[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double w[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const double half = 0.5 * (to - from) / panels;
  double sum = 0;
  for (int p = 0; p < panels; ++p) {
    const double middle = from + (2 * p + 1) * half;
    for (int i = 0; i < 4; ++i) sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i]));
  }
  return half * sum;
}

}  // namespace titin
