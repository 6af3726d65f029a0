/// Shape functions at quadrature points by geometry of the cell, and what one undeformed cell adds to them.
///
/// Layouts are chosen for the kernels: the node index runs fastest and is padded to a multiple of eight doubles. Plane
/// bodies have three-dimensional gradients too, whose third component is zero.
#pragma once

#include <array>
#include <mfem.hpp>
#include <vector>

#include "fe/cell_element.hpp"

namespace titin {

/// Exponents (a, b, c) of the monomials of degree <= d in so many dimensions, constant first; none for d < 0.
std::vector<std::array<int, 3>> monomials(int d, int dimension);

class CellTables {
 public:
  /// `points` per direction (see CellElements::rule); `thickness` of a plane body [m], 1 for solid ones.
  CellTables(const mfem::ParFiniteElementSpace& space, const CellElements& elements, int points, double thickness);
  CellTables(const CellTables&) = delete;  // cells point to the shapes in here

  /// The geometry of all cells of all ranks; INVALID when there are several.
  mfem::Geometry::Type geometry() const { return geometry_; }
  int dimension() const { return dimension_; }  ///< components of the displacement: 3, or 2 in plane strain
  int cells() const { return static_cast<int>(cells_.size()); }
  int nodes(int cell) const { return of(cell).nodes; }
  int values(int cell) const { return dimension_ * of(cell).nodes; }  ///< length of an element vector
  int padded(int cell) const { return of(cell).padded; }              ///< nodes, rounded up to a multiple of 8
  int points(int cell) const { return of(cell).points; }
  /// Polynomials of pressure and dilatation; 0: displacement alone.
  int modes(int cell) const { return of(cell).modes; }
  const mfem::IntegrationRule& rule(int cell) const { return *of(cell).rule; }
  int most_points() const { return most_points_; }  ///< of any cell of this rank
  int most_modes() const { return most_modes_; }
  int most_values() const { return most_values_; }
  int most_gradients() const { return most_gradients_; }  ///< doubles that gradients() may write

  const double* shape(int cell, int q) const { return &of(cell).shape[q * of(cell).padded]; }   ///< N_a [padded]
  double weight(int cell, int q) const { return cells_[cell].weight[q]; }                       ///< [m^3]
  const double* mode(int cell, int q) const { return &cells_[cell].mode[q * modes(cell)]; }     ///< psi_l [modes]
  const double* mode_mass_inverse(int cell) const { return cells_[cell].mass_inverse.data(); }  ///< (int psi psi^T)^-1
  /// dxi_M / dX_J at [3 M + J] [1/m]
  const double* inverse_jacobian(int cell, int q) const { return &cells_[cell].inverse_jacobian[9 * q]; }
  /// Gradients of all shape functions in the reference configuration: G[q][J][a], J = 0..2, padded [1/m].
  void gradients(int cell, double* G) const;

 private:
  /// What all cells of one geometry share.
  struct Shapes {
    const mfem::IntegrationRule* rule = nullptr;
    int nodes = 0, padded = 0, points = 0, modes = 0;
    std::vector<double> shape;                 // [q][a]
    std::vector<double> slope;                 // [q][M][a], dN_a / dxi_M
    std::vector<std::array<int, 3>> monomial;  // exponents of the modes
  };
  struct Cell {
    const Shapes* shapes = nullptr;
    std::vector<double> weight, inverse_jacobian, mode, mass_inverse;
  };
  const Shapes& of(int cell) const { return *cells_[cell].shapes; }
  void set_shapes(const mfem::FiniteElement& element, const CellElement& pair, Shapes& shapes) const;
  void set_cell(mfem::ElementTransformation& map, double thickness, Cell& cell) const;
  void set_modes(const mfem::Vector& centre, const mfem::DenseMatrix& X, double size, Cell& cell) const;

  mfem::Geometry::Type geometry_;
  int dimension_, most_points_ = 0, most_modes_ = 0, most_values_ = 0, most_gradients_ = 0;
  std::array<Shapes, mfem::Geometry::NumGeom> shapes_;
  std::vector<Cell> cells_;
};

}  // namespace titin
