/// What the block solver needs of the muscle's cells (solve/block_cells.hpp), taken as the tangent is assembled.
#pragma once

#include "fe/cell_tables.hpp"
#include "fe/loads.hpp"
#include "fe/three_field.hpp"
#include "solve/block_cells.hpp"

namespace titin {

/// Which dofs and vertices the cells have, and where the functions of order 1 are at their nodes. Collective.
CellLayout cell_layout(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                       const Constraints& constraints);

class TangentCells {
 public:
  TangentCells(const mfem::ParFiniteElementSpace& space, const CellTables& tables, const Constraints& constraints,
               double gamma);

  /// A cell whose tangent K [component][node] x [component][node] was just computed by `kernel`; K holds everything,
  /// also inertia: `mass` is what multiplies N_a N_b there [kg/(m^3 s^2)], 0 without.
  void set(int cell, const ThreeField& kernel, const Material& material, const double* K, double mass);
  const CellBlocks& blocks() const { return blocks_; }

 private:
  void set_divergence(int cell, const ThreeField& kernel);
  void set_stiffness(int cell, const ThreeField& kernel, const Material& material);
  double shear_modulus(int cell, const double* K, double mass) const;

  const CellTables& tables_;
  CellBlocks blocks_;
  std::vector<double> gradient_square_, mass_square_;  // [cell] sum_a int |Grad N_a|^2 [m], sum_a int N_a^2 [m^3]
  std::vector<double> volume_, size_;                  // [cell] [m^3], of an edge [m]
  double least_bulk_ = 0;
  std::vector<double> B_, S_, inertia_;  // of the cell at hand
};

}  // namespace titin
