/// The tangent of mixed elements, kept cell by cell for the block solver.
///
/// A cell's tangent is  A + B^T S B  with S = M^-1 [int U'' psi psi^T] M^-1 of the pressure modes psi. With
///
///   G = gamma mu M^-1,   A_g = A + B^T G B,   S' = S - G,   p = S' B u,
///
/// K u = b is the same as  [A_g  B^T; B  -S'^-1] [u; p] = [b; 0]  (augmented Lagrangian: Fortin, Glowinski 1983). A_g
/// is what multigrid works on: kept in float, symmetric part, eight cells at a time. The rest is small and kept in
/// double.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "solve/block_dofs.hpp"
#include "solve/block_lanes.hpp"

namespace titin {

/// What the block solver must know of a mesh and its elements, all of one kind; this rank's part.
struct CellLayout {
  int cells = 0;
  int components = 3;
  int nodes = 0;    ///< of a cell's displacement
  int corners = 0;  ///< of a cell: nodes of the coarse space, order 1
  int modes = 0;    ///< of a cell's pressure; may be 0
  PetscInt owned_dofs = 0, owned_corners = 0;
  std::vector<PetscInt> dofs;     ///< [cell][component][node] global true dof; -1 where it is constrained
  std::vector<PetscInt> corner;   ///< [cell][corner] global number of the mesh's vertex
  std::vector<double> hat;        ///< [node][corner] the coarse functions at the nodes; 0 but in a vertex's open star
  std::vector<double> position;   ///< [own corner][component] of the mesh's vertices [m]
  double elongation = 1;          ///< largest ratio of a cell's longest and shortest extent
  std::vector<double> mode_size;  ///< [cell][mode] root mean square of psi in the cell
  int size() const { return components * nodes; }
};

/// Numbers of one cell's tangent.
struct CellTangent {
  const double* K;             ///< [component][node] x [component][node], with B^T S B
  const double* B;             ///< [mode][component][node] int psi cof F : Grad N [m^2]
  const double* mass_inverse;  ///< M^-1 [mode][mode]
  const double* stiffness;     ///< S [mode][mode]
  const double* inertia;  ///< [node] lumped mass over what turns displacements into accelerations [N/m]; null: none
  double bulk;            ///< least U'' in the cell [Pa]
  double shear;           ///< mean shear modulus of A, inertia left out [Pa]
  double size;            ///< edge length [m]
};

class CellBlocks {
 public:
  /// `gamma`: see above; infinite takes A_g = A + B^T S B: no pressure is left.
  CellBlocks(CellLayout layout, double gamma);

  const CellLayout& layout() const { return layout_; }
  /// Sets the numbers of a cell of this rank.
  void set(int cell, const CellTangent& tangent);

  int batches() const { return (layout_.cells + float_lanes - 1) / float_lanes; }
  /// A_g of eight cells, packed; rows and columns of constrained dofs are zero.
  const FloatLanes* matrices(int batch) const { return &A_[batch * packed_size(layout_.size())]; }

  const double* B(int cell) const { return &B_[std::size_t(cell) * layout_.modes * layout_.size()]; }
  const double* stiffness(int cell) const { return &small_[(4 * cell + 0) * square()]; }     ///< S'
  const double* compliance(int cell) const { return &small_[(4 * cell + 1) * square()]; }    ///< S'^-1
  const double* mass_inverse(int cell) const { return &small_[(4 * cell + 2) * square()]; }  ///< M^-1
  /// (M / ((1 + gamma) mu) + S'^-1)^-1: inverse Schur complement where inertia is small.
  const double* schur_inverse(int cell) const { return &small_[(4 * cell + 3) * square()]; }
  /// A pressure over a scaled one, so that the residuals of both equations are forces [Pa]: [mode], of later cells too.
  const double* pressure_scale(int cell) const { return scale_.data() + std::size_t(cell) * layout_.modes; }
  bool has_pressure() const { return layout_.modes > 0 && !std::isinf(gamma_); }
  const double* inertia(int cell) const { return &inertia_[std::size_t(cell) * layout_.nodes]; }  ///< [N/m], lumped
  std::size_t bytes() const;

 private:
  std::size_t square() const { return std::size_t(layout_.modes) * layout_.modes; }
  void set_small(int cell, const CellTangent& tangent, double augmentation);
  void set_matrix(int cell, const CellTangent& tangent, const std::vector<double>& change);

  CellLayout layout_;
  double gamma_;
  std::vector<FloatLanes> A_;
  std::vector<double> B_, small_, scale_, inertia_;
};

}  // namespace titin
