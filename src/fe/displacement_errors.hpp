/// How far displacement and velocity are from a motion that is known exactly: norms over the body at rest.
#pragma once

#include <mfem.hpp>
#include <vector>

#include "mesh/exact_motion.hpp"
#include "solve/model.hpp"

namespace titin {

/// displacement_L1, _L2, _Linf and velocity_L1, _L2, _Linf: integral of the size of the error, root of the integral of
/// its square, largest at the points of a rule two degrees above the product of shape functions. `u`, `v`: true dofs
/// [m], [m/s]; `time` [s]. Of a plane body per thickness. Collective.
std::vector<Quantity> displacement_errors(mfem::ParFiniteElementSpace& space, const mfem::Vector& u,
                                          const mfem::Vector& v, const ExactMotion& exact, double time);

}  // namespace titin
