/// The part of the tangent that lies beside its matrix (solve/bordered.hpp): plates on rails, and links.
///
/// A plate's q has K T as its column with T one at the plate's dofs, T' K as its row and T' K T + m / dt^2 as its
/// corner. A link adds g kappa g' to K, kappa = ds/de: with kappa g' x as an unknown a column g, a row kappa g' and -1.
#pragma once

#include "fe/links.hpp"
#include "fe/loads.hpp"
#include "solve/bordered.hpp"

namespace titin {

class TangentBorder {
 public:
  TangentBorder(const mfem::ParFiniteElementSpace& space, const Constraints& constraints, const Links& links);

  const Border& border() const { return border_; }
  void begin();
  /// K [components][nodes] x [components][nodes] of a cell with these local dofs.
  void add(const int* dofs, int n, const double* K);
  /// `inertia`: acceleration at the end of the step in the balance over displacement [1/s^2]. A link's stiffness is
  /// displacement_part times its spring's and velocity_factor times its damper's. Collective.
  void end(double inertia, double displacement_part, double velocity_factor);

 private:
  void set_links(double displacement_part, double velocity_factor);
  const mfem::ParFiniteElementSpace& space_;
  const Constraints& constraints_;
  const Links& links_;
  Border border_;
  std::vector<mfem::Vector> columns_, rows_;  // of rails, local dofs
  std::vector<mfem::Vector> free_g_;          // of links, zero where K has unit rows
};

}  // namespace titin
