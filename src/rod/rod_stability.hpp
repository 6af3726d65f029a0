/// Small motions of a rod about a state at rest: M u'' + C u' + K u = 0 with the ends held as they are.
///
///   K = int A k dN/dX dN/dX dX,   C the same of c,   dN = k dm + c dm/dt   (rod/uniaxial.hpp).
///
/// u = exp(s t) x: all s with their x, by LAPACK (dggev on the system of first order; dsbgv for squares of
/// eigenfrequencies where nothing depends on the rate). A state is stable while no s has a positive real part.
/// docs/theory/rod.md. SI units.
#pragma once

#include <complex>
#include <vector>

#include "rod/rod_system.hpp"

namespace titin {

/// All finite s [1/s], by falling real part.
std::vector<std::complex<double>> growth_rates(RodSystem& system, const mfem::Vector& u, double time);
/// Eigenvalues w^2 [1/s^2] of K x = w^2 M x, increasing, where every free node has mass: whatever depends on the rate
/// is left out.
std::vector<double> squared_frequencies(RodSystem& system, const mfem::Vector& u, double time);

}  // namespace titin
