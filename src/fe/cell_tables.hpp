/// Shape functions of Q_k hexahedra at Gauss points, and what one undeformed cell adds to them.
///
/// Layouts are chosen for the kernels: the node index runs fastest and is padded to a multiple of eight doubles.
#pragma once

#include <mfem.hpp>
#include <vector>

namespace titin {

/// The Gauss points of a hexahedron, `points` a direction.
const mfem::IntegrationRule& cell_rule(int points);

class CellTables {
 public:
  /// `order` k of the displacement; `points` Gauss points per direction.
  CellTables(const mfem::ParFiniteElementSpace& space, int order, int points);

  int nodes() const { return nodes_; }
  int padded() const { return padded_; }  ///< nodes, rounded up to a multiple of 8
  int points() const { return points_; }
  int modes() const { return modes_; }  ///< polynomials of degree <= k-1: pressure and dilatation
  const mfem::IntegrationRule& rule() const { return *rule_; }

  const double* shape(int q) const { return &shape_[q * padded_]; }                             ///< N_a [padded]
  double weight(int cell, int q) const { return cells_[cell].weight[q]; }                       ///< [m^3]
  const double* mode(int cell, int q) const { return &cells_[cell].mode[q * modes_]; }          ///< psi_l [modes]
  const double* mode_mass_inverse(int cell) const { return cells_[cell].mass_inverse.data(); }  ///< (int psi psi^T)^-1
  /// dxi_M / dX_J at [3 M + J] [1/m]
  const double* inverse_jacobian(int cell, int q) const { return &cells_[cell].inverse_jacobian[9 * q]; }
  /// Gradients of all shape functions in the reference configuration: G[q][J][a], padded [1/m].
  void gradients(int cell, double* G) const;

 private:
  struct Cell {
    std::vector<double> weight, inverse_jacobian, mode, mass_inverse;
  };
  void set_cell(mfem::ElementTransformation& map, double size, Cell& cell) const;
  void set_modes(const mfem::Vector& centre, const mfem::DenseMatrix& X, double size, Cell& cell) const;

  int order_, nodes_, padded_, points_, modes_;
  const mfem::IntegrationRule* rule_;
  std::vector<double> shape_;            // [q][a]
  std::vector<double> reference_slope_;  // [q][M][a], dN_a / dxi_M
  std::vector<Cell> cells_;
};

}  // namespace titin
