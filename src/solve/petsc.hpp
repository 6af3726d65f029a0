/// PETSc and hypre for the life of the program, and PETSc's error codes as exceptions.
#pragma once

#include <petscsnes.h>

#include <stdexcept>
#include <string>

namespace titin {

class PetscSession {
 public:
  PetscSession();  ///< after MpiSession
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
};

/// A PETSc call that failed where it should not: an internal error, not one of the user's.
class PetscError : public std::runtime_error {
 public:
  explicit PetscError(PetscErrorCode code);
};

inline void check(PetscErrorCode code) {
  if (code) throw PetscError(code);
}

}  // namespace titin
