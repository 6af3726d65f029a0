/// hypre's BoomerAMG by PETSc, with defaults for three dimensions.
#pragma once

#include <string>

#include "solve/petsc.hpp"

namespace titin {

/// One V-cycle; what the user's PETSc options say under `prefix` (such as "coarse_") stays.
void set_boomeramg(PC pc, const std::string& prefix);

}  // namespace titin
