/// One cell of the three-field formulation (displacement, pressure, dilatation), total Lagrangian.
///
///   W(u, p, D) = int W_iso(F) + U(D) + p (J - D) dV,   F = I + Grad u, J = det F          (Simo, Taylor, Pister 1985)
///
/// p and D share one discontinuous space, so both are explicit functions of u in each cell, D = Pi J and p = Pi U'(D)
/// with Pi the L2 projection onto that space. What is left is a residual and its exact tangent in u alone:
///
///   r = int (P_iso + p cof F) : Grad N dV
///   K = int Grad N : (A_iso + p d cof F / dF) : Grad N dV + B^T M^-1 [int U''(D) psi psi^T] M^-1 B,
///   B_l = int psi_l cof F : Grad N dV,   M = int psi psi^T dV.
///
/// Where the displacement is alone (CellTables::modes == 0), Pi is the identity: D = J and p = U'(J) at each point.
/// Plane strain has two components of displacement and the same tensors, with F_33 = 1.
#pragma once

#include <vector>

#include "fe/cell_tables.hpp"
#include "fe/tangent_points.hpp"
#include "materials/material.hpp"

namespace titin {

/// Scratch and results of the kernels at the points of one cell. Element vectors are [components][nodes].
class ThreeField {
 public:
  explicit ThreeField(const CellTables& tables);

  /// Deformation of a cell: F, F_old, J, D, p at its points. Returns false where J or D is not positive; bad_point()
  /// says where.
  bool deform(int cell, const Material& material, const double* u, const double* u_old);
  int bad_point() const { return bad_point_; }
  /// After deform: the rate of fibres is that from `u_old` in `dt` [s] to this step's end, or to its beginning if it is
  /// known by then.
  void deform_rate(int cell, const double* u_old, double dt, bool known);

  /// Adds the internal forces to r. `in` carries time, dt and rate; the points are filled in here.
  void add_forces(int cell, const Material& material, PointInput in, double* r);
  /// Adds the tangent to K [values][values], row-major; one that is symmetric to zero, or to another such one.
  void add_tangent(int cell, const Material& material, PointInput in, double* K);
  /// Adds int Grad N : A : Grad N for moduli [points] times the points' weights.
  void add_moduli(int cell, const Mat9* A, bool symmetric, double* K);

  /// The same in parts, for kernels over several cells; good until the next call.
  TangentPoints tangent_points(int cell, const Material& material, PointInput in, double inertia);

  /// Adds density * N_a N_b dV, one component: [nodes][nodes].
  void add_mass(int cell, double density, double* M) const;

  /// The points as a batch for a material, with its directions where `in` has none; current after deform. The vectors
  /// below hold in.n of them, or more.
  PointInput points(PointInput in) const;
  const std::vector<Mat3>& F() const { return F_; }
  const std::vector<Mat3>& F_old() const { return F_old_; }
  const std::vector<double>& J() const { return J_; }
  const std::vector<double>& dilatation() const { return D_; }
  const std::vector<double>& pressure() const { return p_; }
  const double* gradients() const { return G_.data(); }

  /// projected = Pi values, both at points; the values themselves when the displacement is alone.
  void project(int cell, const std::vector<double>& values, std::vector<double>& projected) const;

 private:
  void set_total_moduli(int cell, const Material& material, const PointInput& in);
  /// M^-1 [int U''(D) psi psi^T dV] M^-1: the stiffness of the volume modes.
  void set_mode_stiffness(int cell, const Material& material, double* S) const;
  void add_volumetric_stiffness(int cell, const Material& material, double* K);
  void add_block(int cell, const Mat9* moduli, int i, int k, double* K);

  const CellTables& tables_;
  int points_ = 0;  // of the cell that was deformed last
  int bad_point_ = -1;
  std::vector<double> G_;  // [q][J][a]
  std::vector<double> H_;  // [q][J][b]: w A G
  std::vector<Mat3> F_, F_old_, cofactor_, P_;
  std::vector<Mat3> F_rate_old_;  // empty where the rate is this step's
  double rate_dt_ = 0;            // [s]
  bool rate_known_ = false;
  std::vector<Mat9> A_;                     // w (A_iso + p d cof F / dF)
  std::vector<Vec3> fibre_, second_fibre_;  // of the material; cells may have their own
  std::vector<double> J_, D_, p_, dU_;
  std::vector<double> factor_, S_;  // p / J; [modes][modes]
};

}  // namespace titin
