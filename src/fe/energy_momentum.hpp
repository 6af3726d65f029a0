/// Forces of one cell over a step that keep energy and angular momentum: the discrete gradient of its potential.
///
/// With both ends of the step, C_m = (C_n + C) / 2, dC = C - C_n and F_m = (F_n + F) / 2, every function phi of C gets
///
///   S[phi] = 2 phi'(C_m) + 2 (phi - phi_n - phi'(C_m) : dC) / |dC|^2 dC,   so that  S[phi] : dC / 2 = phi - phi_n,
///
/// and the cell's forces are, with u' = (U(D) - U(D_n)) / (D - D_n) and Pi the projection of the three fields,
///
///   r = int F_m (S[W] + Pi u' S[J]) : Grad N dV + int P_rest : Grad N dV.
///
/// r . (u - u_n) is the change of int W + U(D) exactly, whatever the step; S is symmetric, so r has no torque about the
/// midpoint. Terms that store no energy, or remember, give their stress P_rest at F_m at the middle of the step.
/// Gonzalez (2000), Comput. Methods Appl. Mech. Eng. 190:1763, eq. 50; Simo, Tarnow (1992), ZAMP 43:757.
/// docs/theory/muscle.md. SI units.
#pragma once

#include <vector>

#include "fe/three_field.hpp"

namespace titin {

class EnergyMomentum {
 public:
  explicit EnergyMomentum(const CellTables& tables) : tables_(tables) {}

  /// Sets the stresses of a cell that `kernel` has deformed. `in` is that of the end of the step. Returns false where
  /// the middle of the step is inside out; bad_point() says where.
  bool deform(int cell, const Material& material, const ThreeField& kernel, const PointInput& in, bool with_tangent);
  int bad_point() const { return bad_point_; }
  void add_forces(int cell, const ThreeField& kernel, double* r) const;
  /// The derivative by the displacement at the end of the step: not symmetric.
  void add_tangent(int cell, ThreeField& kernel, double* K) const;

 private:
  struct Point {
    Mat3 P;         // of everything [Pa]
    Mat9 A;         // dP / dF at fixed p [Pa]
    Mat3 Q;         // F_m S[J]: what p acts on
    double dp = 0;  // d u' / dD
  };
  void set_elastic(const Material& material, const ThreeField& kernel, const PointInput& in, bool with_tangent);
  bool add_rest(const Material& material, const ThreeField& kernel, const PointInput& in, bool with_tangent);
  void set_pressure(int cell, const Material& material, const ThreeField& kernel);
  void add_pressure(const ThreeField& kernel, bool with_tangent, bool alone);
  void add_volumetric_stiffness(int cell, const ThreeField& kernel, double* K) const;

  const CellTables& tables_;
  int bad_point_ = -1;
  std::vector<Point> points_;
  std::vector<double> p_;  // [Pa] at points
};

}  // namespace titin
