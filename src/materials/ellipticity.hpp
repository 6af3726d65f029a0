/// Does a material resist every small band of shear? Legendre-Hadamard: a_i n_J A_iJkL a_k n_L > 0 for all directions n
/// and a, A = dP/dF. For a unit n this is the smallest eigenvalue of the acoustic tensor Q_ik = A_iJkL n_J n_L; where
/// it is negative over all n, a band with normal n slides along a by itself, and no mesh resolves its width. The
/// largest eigenvalue is density times the square of the fastest wave's speed: what a time step has to know.
///
/// n is a direction of the reference configuration. Of an unsymmetric A the symmetric part of Q is taken.
/// Truesdell & Noll (1965), The Non-Linear Field Theories of Mechanics, secs. 44, 68bis, 71. Values in [Pa].
#pragma once

#include "materials/material.hpp"

namespace titin {

struct AcousticValue {
  double value = 0;  ///< eigenvalue of Q [Pa]
  Vec3 normal{};     ///< n, of unit length
  Vec3 motion{};     ///< a, of unit length
};

/// Smallest value over all directions: on a grid, then by Newton's method from its lowest places.
AcousticValue smallest_acoustic(const Mat9& A);
AcousticValue largest_acoustic(const Mat9& A);

/// Smallest values of n points of a material, its volumetric law at J = det F included; not a number where the stress
/// is none.
void legendre_hadamard(const Material& material, const PointInput& in, AcousticValue* values);
/// Speed of the fastest wave [m/s] in any direction of the deformed body: sqrt of the largest eigenvalue of
/// A_iJkL F_jJ n_j F_lL n_l over the reference density. An explicit step is shorter than size of a cell over speed.
void wave_speed(const Material& material, const PointInput& in, double* speed);

}  // namespace titin
