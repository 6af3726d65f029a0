/// Where the degrees of freedom of a displacement are.
#pragma once

#include <mfem.hpp>

namespace titin {

/// True-dof vector of the positions at rest [m].
mfem::Vector places_of_dofs(mfem::ParFiniteElementSpace& space);

}  // namespace titin
