/// The cells around the vertices of this rank: its own, then those of other ranks that touch one of its vertices.
#pragma once

#include <memory>
#include <vector>

#include "base/exchange.hpp"
#include "solve/block_cells.hpp"

namespace titin {

class CellHalo {
 public:
  explicit CellHalo(const CellBlocks& blocks);  ///< Collective

  const CellLayout& layout() const { return blocks_.layout(); }
  int cells() const { return layout().cells + ghosts_; }
  PetscInt first_corner() const { return first_corner_; }  ///< global number of this rank's first vertex
  const PetscInt* dofs(int cell) const;                    ///< global, as CellLayout::dofs
  const PetscInt* corner(int cell) const;
  /// Lower triangle of A_g, entry e at [e * float_lanes].
  const float* matrix(int cell) const;

  /// Fetches the matrices of other ranks' cells. Collective.
  void update();
  std::size_t bytes() const;

 private:
  std::vector<Exchange::Part> choose_cells();
  std::vector<PetscInt> fetch(const std::vector<PetscInt>& own, int size);

  const CellBlocks& blocks_;
  std::unique_ptr<Exchange> exchange_;  // null on one rank
  std::vector<int> sent_;               // cells, by receiver
  int ghosts_ = 0;
  PetscInt first_corner_ = 0;
  std::vector<PetscInt> ghost_dofs_, ghost_corner_;
  std::vector<FloatLanes> ghost_matrices_;
};

}  // namespace titin
