/// y = K x of a tangent, without its matrix: hexahedra Q_k, sum-factorised, several cells side by side in a register.
///
/// Of each point are kept the moduli A (45 numbers, symmetric), c = w cof F, the volume modes psi and the mass, all
/// in coordinates xi of the cell (fe/hexahedron_batch.hpp); of each cell the stiffness S of the volume modes. With
/// g = dx/dxi at the points
///
///   y = sum_points [A g + c psi^T S (sum_points psi c : g)] : dN/dxi + inertia.
///
/// Q2 with 27 points: 12.7 kB a cell (half of that in single precision), where the rows of an assembled matrix have 55.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <vector>

#include "fe/tangent_points.hpp"
#include "solve/petsc.hpp"

namespace titin {

class CellTables;

/// Numbers and arithmetic of an action.
enum class Precision { full, single };

class TangentAction {
 public:
  virtual ~TangentAction() = default;
  /// `space` of Q_k hexahedra, byVDIM, conforming; `constrained` marks local dofs, whose rows and columns are units;
  /// `symmetric` promises symmetric moduli. Null when there is no kernel for this order, number of points and symmetry.
  /// Collective.
  static std::unique_ptr<TangentAction> create(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                                               const std::vector<char>& constrained, bool symmetric,
                                               Precision precision);

  /// Takes the tangent of each cell of this rank, in an order of its own.
  virtual void set(const TangentOfCell& at) = 0;
  /// y = K x, true dofs of this rank. Collective.
  virtual void multiply(const double* x, double* y) = 0;
  virtual std::size_t bytes() const = 0;  ///< kept on this rank

  /// A PETSc matrix of which MatMult is multiply(); it must not outlive this. The caller destroys it. Collective.
  Mat shell(const mfem::ParFiniteElementSpace& space);
};

}  // namespace titin
