/// Matrices of hexahedra Q_k by sum factorisation, several cells side by side in a register.
///
/// With the tangent A in coordinates of the cell at q^3 points, and N_a = products of polynomials of one direction,
///
///   K_ia,kb = sum over points and M, N of A_iM,kN d_M N_a d_N N_b
///
/// is summed a direction at a time (Melenk, Gerdes, Schwab 2001): for Q2 and 27 points a third of the operations of the
/// plain sum. The volume modes add B^T S B, the mass its own.
#pragma once

#include <memory>
#include <mfem.hpp>

#include "fe/tangent_points.hpp"

namespace titin {

class CellTables;

class CellMatrices {
 public:
  virtual ~CellMatrices() = default;
  /// Null when there is no kernel for this order and number of points. `symmetric` promises symmetric moduli.
  static std::unique_ptr<CellMatrices> create(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                                              bool symmetric);

  virtual int cells_at_once() const = 0;
  /// The matrices of the cells first, ..., first + count - 1 < first + cells_at_once().
  virtual void form(int first, int count, const TangentOfCell& at) = 0;
  /// Of cell first + i: [3][nodes] x [3][nodes], row-major, nodes in MFEM's order. May be written to until the next
  /// form.
  virtual double* matrix(int i) = 0;
};

}  // namespace titin
