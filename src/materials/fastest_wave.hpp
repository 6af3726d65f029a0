/// Speed of the fastest wave of a material, for explicit steps and impedances: the same number as wave_speed
/// (materials/ellipticity.hpp) to one part in a thousand, for a tenth of its time.
///
/// rho0 c^2 is the largest of a_ijkl m_i n_j m_k n_l over unit vectors n (direction) and m (motion), a_ijkl = A_iJkL
/// F_jJ F_lL. For one of them given the best other one is an eigenvector, so that turns of the two only ever climb.
/// They begin from the best of thirteen directions no more than 28 degrees from any other, of the principal axes of F
/// F^T, where isotropic materials have their fastest waves, and of the fibres.
#pragma once

#include "materials/material.hpp"

namespace titin {

/// Of n points [m/s]; not a number where the stress is none.
void fastest_wave(const Material& material, const PointInput& in, double* speed);

}  // namespace titin
