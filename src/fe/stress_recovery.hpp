/// How far the stress is off, cell by cell: its distance from a continuous stress (Zienkiewicz, Zhu 1987, Int. J.
/// Numer. Meth. Eng. 24:337).
///
///   e_K^2 = int_K |P* - P|^2 dV,   P* the L2 projection of the first Piola stress P onto continuous P_k or Q_k
///
/// P is discontinuous between cells and less accurate than its projection, so e is near the true error of P in L2 where
/// the solution is smooth. Where materials meet, the stress may jump in truth; the estimate there is too large.
#pragma once

#include <array>
#include <memory>
#include <mfem.hpp>
#include <vector>

#include "fe/muscle_system.hpp"

namespace titin {

class StressRecovery {
 public:
  /// `thickness` of a plane body [m], 1 for solid ones.
  StressRecovery(MuscleSystem& system, double thickness);

  /// Of the state u at the end of the step that the system holds. Collective.
  void update(const mfem::Vector& u);
  double cell_error(int cell) const { return cell_error_[cell]; }     ///< e_K [Pa m^(3/2)]
  double density(int cell) const;                                     ///< e_K over the root of the cell's volume [Pa]
  double error() const { return error_; }                             ///< root of the sum of e_K^2 over all ranks
  double relative() const { return norm_ > 0 ? error_ / norm_ : 0; }  ///< over the norm of P

 private:
  void take_stress(const mfem::Vector& u);
  mfem::Vector smooth(int component);
  int first_point(int cell) const { return first_point_[cell]; }
  const std::vector<double>& shapes(int cell) const;

  MuscleSystem& system_;
  mfem::H1_FECollection collection_;
  mfem::ParFiniteElementSpace space_;
  std::unique_ptr<mfem::HypreParMatrix> mass_;
  std::array<std::vector<double>, mfem::Geometry::NumGeom> shapes_;  // [q][a] by geometry of the cell
  std::vector<int> first_point_;
  std::vector<Mat3> stress_;  // at the points of all cells
  std::vector<double> cell_error_;
  double error_ = 0, norm_ = 0;
};

}  // namespace titin
