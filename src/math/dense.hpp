/// A few linear equations with a dense matrix: Gauss's elimination with exchange of rows.
#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace titin {

template <int most>
struct DenseSystem {
  int n = 0;                            ///< equations, at most `most`
  std::array<double, most * most> A{};  ///< A_rc at [n r + c]; destroyed by solve()
  std::array<double, most> b{};         ///< right side; then the solution
  double& at(int r, int c) { return A[n * r + c]; }

  /// False when a pivot vanishes to round-off beside the largest entry, or is not a number.
  bool solve() {
    double largest = 0;
    for (int k = 0; k < n * n; ++k) largest = std::fmax(largest, std::abs(A[k]));
    for (int c = 0; c < n; ++c) {
      exchange(c, pivot_row(c));
      if (!(std::abs(at(c, c)) > vanishing * largest)) return false;
      for (int r = c + 1; r < n; ++r) eliminate(r, c);
    }
    for (int r = n - 1; r >= 0; --r) {
      for (int c = r + 1; c < n; ++c) b[r] -= at(r, c) * b[c];
      b[r] /= at(r, r);
    }
    return true;
  }

 private:
  static constexpr double vanishing = 1e-15;

  int pivot_row(int c) {
    int best = c;
    for (int r = c + 1; r < n; ++r)
      if (std::abs(at(r, c)) > std::abs(at(best, c))) best = r;
    return best;
  }
  void exchange(int r, int s) {
    if (r == s) return;
    for (int c = 0; c < n; ++c) std::swap(at(r, c), at(s, c));
    std::swap(b[r], b[s]);
  }
  void eliminate(int r, int c) {
    const double factor = at(r, c) / at(c, c);
    for (int k = c; k < n; ++k) at(r, k) -= factor * at(c, k);
    b[r] -= factor * b[c];
  }
};

}  // namespace titin
