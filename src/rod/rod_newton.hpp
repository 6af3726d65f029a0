/// Newton's method on a rod's few unknowns: banded factors, and steps that are shortened until |R| falls.
#pragma once

#include "rod/rod_system.hpp"
#include "solve/newton.hpp"

namespace titin {

/// Solves from u for the displacement at the end of the system's step; `given` holds that of given nodes. The first
/// iteration takes them there, and the others with them as the tangent has it.
NewtonResult solve_rod(RodSystem& system, const mfem::Vector& given, mfem::Vector& u);

}  // namespace titin
