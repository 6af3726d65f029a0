/// Additive Schwarz with one subspace for each vertex of the mesh: all dofs of displacement in the vertex's open star.
/// Such stars hold the local motions without divergence, which point smoothers damp badly as gamma or the bulk modulus
/// grows (Schoeberl 1999; Arnold, Falk, Winther 2000).
///
/// The dense inverses are made in float, eight patches at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/block_halo.hpp"
#include "solve/block_matrices.hpp"

namespace titin {

class VertexPatches {
 public:
  /// Patches of this rank's vertices; `dofs` knows what the halo's cells touch.
  VertexPatches(const CellHalo& halo, const LocalDofs& dofs, BlockMatrices::Entries entries);

  /// Sums the cells' matrices and inverts; CellHalo::update comes before.
  void update();
  /// z += sum_v R_v^T A_v^-1 R_v r, local vectors: ghosts of r are current, those of z are for the caller to add.
  void apply(const float* r, float* z) const;

  std::size_t count() const { return patches_; }
  std::size_t bytes() const;

 private:
  /// Dof `from` of a cell is dof `to` of the patch.
  struct Pair {
    std::uint16_t from, to;
  };
  struct Part {
    int cell, lane;
    std::size_t first, end;  // of pairs_
  };
  struct Batch {
    int size;                          // dofs of the largest patch
    std::size_t dofs;                  // where its dofs [size][lane] begin
    std::size_t first_part, end_part;  // of parts_
    std::vector<int> sizes;            // [lane]
  };
  struct Star;
  std::vector<Star> stars(const LocalDofs& dofs) const;
  void add_batch(const std::vector<Star>& stars, std::size_t first, int zero);
  void assemble(const Batch& batch, FloatLanes* A) const;

  const CellHalo& halo_;
  std::size_t patches_ = 0;
  int largest_ = 0;
  std::vector<Batch> batches_;
  std::vector<Part> parts_;
  std::vector<Pair> pairs_;
  std::vector<int> dofs_;
  BlockMatrices inverses_;
};

}  // namespace titin
