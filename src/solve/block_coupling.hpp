/// B of the block solver, cell by cell: what displacements at local dofs do to a cell's pressure modes, and back.
#pragma once

#include <vector>

#include "solve/block_multigrid.hpp"

namespace titin {

class Coupling {
 public:
  Coupling(const CellBlocks& blocks, const Multigrid& multigrid);

  /// t = B x of a cell; x at local dofs.
  void divergence(int cell, const double* x, double* t) const;
  /// y += B^T p of a cell.
  void add_gradient(int cell, const double* p, double* y) const;
  std::size_t bytes() const { return places_.capacity() * sizeof(int); }

 private:
  const CellBlocks& blocks_;
  std::vector<int> places_;             // [cell][dof]: local dofs
  mutable std::vector<double> values_;  // of a cell's dofs
};

}  // namespace titin
