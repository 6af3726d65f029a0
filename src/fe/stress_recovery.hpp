/// How far the stress is off, cell by cell: its distance from a smoother one (Zienkiewicz, Zhu 1992, Int. J. Numer.
/// Meth. Eng. 33:1331).
///
///   e_K^2 = int_K |P* - P|^2 dV,   P* = sum over vertices v of the cell of N_v p_v
///
/// P is the first Piola stress, N_v the linear shape function of a vertex, and p_v the complete polynomial of degree k
/// nearest to P, in L2, over the cells around v. One polynomial cannot follow what repeats from cell to cell, which is
/// the leading error of P: Legendre's polynomial of degree k in each. (A projection onto *continuous* functions can, if
/// k is even: at both ends of a cell that polynomial is 1, so the error is continuous, is kept, and goes unseen.)
///
/// Polynomials end where materials meet: stresses may jump there. Around a vertex at the surface there are too few
/// cells to tell; cells with vertices inside their material take the polynomials of those alone.
#pragma once

#include <mfem.hpp>
#include <vector>

#include "fe/muscle_system.hpp"
#include "fe/patch_fit.hpp"
#include "solve/model.hpp"

namespace titin {

class StressRecovery {
 public:
  /// Collective.
  explicit StressRecovery(MuscleSystem& system);

  /// Of the state u at the end of the step that the system holds. Collective.
  void update(const mfem::Vector& u);
  double cell_error(int cell) const { return cell_error_[cell]; }     ///< e_K [Pa m^(3/2)]
  double density(int cell) const;                                     ///< e_K over the root of the cell's volume [Pa]
  double error() const { return error_; }                             ///< root of the sum of e_K^2 over all ranks
  double relative() const { return norm_ > 0 ? error_ / norm_ : 0; }  ///< over the norm of P
  /// Over the root of the body's volume [Pa], and relative.
  std::vector<Quantity> quantities() const;

 private:
  void take_stress(const mfem::Vector& u);
  void compare(const PatchFit& fit);

  MuscleSystem& system_;
  CellPoints points_;
  std::vector<PatchFit> fits_;  // of each material
  std::vector<Mat3> stress_;    // at points
  std::vector<double> cell_error_;
  double error_ = 0, norm_ = 0, volume_ = 0;
};

}  // namespace titin
