/// Dense matrices of a cell's few pressure modes, row-major.
#pragma once

#include <mfem.hpp>

namespace titin {

/// inverse = A^-1 of a symmetric A [n][n].
inline void invert_small(int n, const double* A, double* inverse) {
  if (n == 0) return;
  std::copy_n(A, n * n, inverse);
  mfem::DenseMatrix view(inverse, n, n);  // symmetric: by rows or by columns is one
  view.Invert();
}

/// y += A x
inline void add_multiply(int n, const double* A, const double* x, double* y) {
  for (int l = 0; l < n; ++l)
    for (int k = 0; k < n; ++k) y[l] += A[l * n + k] * x[k];
}

}  // namespace titin
