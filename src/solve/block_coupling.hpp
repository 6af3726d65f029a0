/// B of the block solver, cell by cell: what displacements at local dofs do to a cell's pressure modes, and back.
#pragma once

#include <algorithm>

#include "solve/block_multigrid.hpp"

namespace titin {

class Coupling {
 public:
  Coupling(const CellBlocks& blocks, const Multigrid& multigrid) : blocks_(blocks), multigrid_(multigrid) {}

  /// t = B x of a cell; x at local dofs.
  void divergence(int cell, const double* x, double* t) const {
    const int n = blocks_.layout().size(), m = blocks_.layout().modes;
    const double* B = blocks_.B(cell);
    std::fill_n(t, m, 0.0);
    for (int c = 0; c < n; ++c) {
      const double value = x[multigrid_.place(cell, c)];
      for (int l = 0; l < m; ++l) t[l] += B[l * n + c] * value;
    }
  }
  /// y += B^T p of a cell.
  void add_gradient(int cell, const double* p, double* y) const {
    const int n = blocks_.layout().size(), m = blocks_.layout().modes;
    const double* B = blocks_.B(cell);
    for (int c = 0; c < n; ++c) {
      double sum = 0;
      for (int l = 0; l < m; ++l) sum += B[l * n + c] * p[l];
      y[multigrid_.place(cell, c)] += sum;
    }
  }

 private:
  const CellBlocks& blocks_;
  const Multigrid& multigrid_;
};

}  // namespace titin
