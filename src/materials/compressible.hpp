/// A material's whole stress where the volume is that of the deformation itself (no separate dilatation field): adds
/// P = J U'(J) F^-T of the volumetric law and its derivative. [Pa]
#pragma once

#include "materials/material.hpp"

namespace titin {

/// P F^T / J [Pa] of a stress P that does not turn the body.
Sym3 cauchy(const Mat3& P, const Mat3& F);
/// Material::stress plus the volumetric law at J = det F.
void whole_stress(const Material& material, const PointInput& in, Mat3* P, Mat9* A);
/// Material::potential plus U(J) [J/m^3].
void whole_energy(const Material& material, const PointInput& in, double* W);

}  // namespace titin
