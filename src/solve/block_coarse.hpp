/// The coarse level of the block solver's multigrid: order 1 on the same mesh, by Galerkin projection of A_g.
#pragma once

#include "solve/block_cells.hpp"

namespace titin {

class CoarseLevel {
 public:
  /// Largest problem that is worth a factorisation. Above, a few steps of conjugate gradients (FGMRES allows what is
  /// not linear) with one V-cycle of BoomerAMG for systems.
  static constexpr PetscInt largest_direct = 3000;

  CoarseLevel(const CellBlocks& blocks, const LocalDofs& dofs);  ///< Collective
  ~CoarseLevel();
  CoarseLevel(const CoarseLevel&) = delete;

  /// A_c = P^T A_g P, cell by cell, and its solver. Collective.
  void update();
  /// x += P A_c^-1 P^T r; the values of this rank's dofs. Collective. False when the solver failed.
  bool correct(const float* r, float* x);
  PetscInt size() const { return size_; }  ///< of all ranks

 private:
  void number();
  void create_prolongation(const LocalDofs& dofs);
  void create_matrix();
  void attach_rigid_motions();
  void create_solver();
  void set_weights();
  void add_batch(int batch, Mat A);
  void add_cell(int cell, const std::vector<double>& values, Mat A) const;
  void finish(Mat A) const;

  /// Of a cell's dof in one of its coarse dofs.
  struct Weight {
    int from, to;
    float value;
  };

  const CellBlocks& blocks_;
  int owned_;
  PetscInt size_ = 0;
  std::vector<Weight> weights_;
  std::vector<FloatLanes> half_, coarse_;  // A_g P and P^T A_g P of eight cells
  std::vector<PetscInt> dofs_;             // [cell][component][corner], -1 where constrained
  Mat P_ = nullptr, A_ = nullptr;
  KSP solver_ = nullptr;
  Vec fine_ = nullptr, right_ = nullptr, left_ = nullptr;
};

}  // namespace titin
