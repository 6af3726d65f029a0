/// What a tangent is made of at the points of one cell: formulations fill it, kernels over cells read it.
#pragma once

#include <functional>

#include "math/tensor.hpp"

namespace titin {

/// K = int Grad N : (A + f (cof F (x) cof F)') : Grad N dV + B^T S B + inertia int N N dV, where the bracket is the
/// derivative of p cof F with f = p / J, and B_l = int psi_l cof F : Grad N dV. Pointers stay the caller's.
struct TangentPoints {
  const Mat9* moduli = nullptr;       ///< [points] A = dP/dF of all but the pressure [Pa]
  const Mat3* cofactors = nullptr;    ///< [points] cof F
  const double* factor = nullptr;     ///< [points] p / J [Pa]
  const double* stiffness = nullptr;  ///< [modes][modes] S, symmetric
  double inertia = 0;                 ///< density / dt^2, or 0 [kg/m^3/s^2]
};

/// The tangent of a cell, called for one cell after the other; what the result points to is good until the next call.
using TangentOfCell = std::function<TangentPoints(int cell)>;

}  // namespace titin
