/// p-multigrid of two levels for A_g, one cycle: the coarse level, then a few steps of Chebyshev's iteration with
/// vertex patches. FGMRES needs no symmetry: as many steps after the coarse level do more than half of them on both
/// sides of it. In float, but for the coarse solver.
#pragma once

#include "solve/block_coarse.hpp"
#include "solve/block_matrices.hpp"
#include "solve/block_patches.hpp"

namespace titin {

class Multigrid {
 public:
  explicit Multigrid(const CellBlocks& blocks);  ///< Collective

  /// Patches, coarse level and spectrum of the present matrices. Collective.
  void update();
  /// z ~ A_g^-1 r, this rank's dofs; z = r where they are constrained. Collective. False when the coarse solver failed.
  bool apply(const double* r, double* z);

  const LocalDofs& dofs() const { return dofs_; }
  /// Local number of a cell's dof.
  int place(int cell, int dof) const {
    return index_[(std::size_t(cell / float_lanes) * blocks_.layout().size() + dof) * float_lanes + cell % float_lanes];
  }
  double largest_eigenvalue() const { return largest_; }  ///< estimate, of the smoother times A_g
  PetscInt coarse_size() const { return coarse_.size(); }
  std::size_t bytes() const;

 private:
  using Vector = std::vector<float>;
  void smooth(Vector& x, Vector& r);
  void precondition(Vector& r, Vector& z) const;
  void add_product(const Vector& x, Vector& y) const;
  void subtract_product(Vector& x, Vector& r);
  void estimate_spectrum();

  const CellBlocks& blocks_;
  CellHalo halo_;
  LocalDofs dofs_;
  BlockMatrices cells_;  // A_g
  VertexPatches patches_;
  CoarseLevel coarse_;
  std::vector<int> index_;   // [batch][dof][lane]: places of the cells' dofs
  std::vector<char> fixed_;  // [own dof]
  double largest_ = 0;
  Vector x_, r_, z_, d_, product_, eigenvector_;
};

}  // namespace titin
