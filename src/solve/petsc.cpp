#include "solve/petsc.hpp"

#include <fmt/format.h>

#include <mfem.hpp>

namespace titin {

PetscSession::PetscSession() {
  mfem::Hypre::Init();
  check(PetscInitializeNoArguments());
  check(PetscPopSignalHandler());                                  // signals end a run cleanly: scene/run
  check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr));  // one sentence, not one traceback a rank
}

PetscSession::~PetscSession() { PetscFinalize(); }

PetscError::PetscError(PetscErrorCode code)
    : std::runtime_error([code] {
        const char* text = nullptr;
        PetscErrorMessage(code, &text, nullptr);
        return fmt::format("PETSc error {}: {}", static_cast<int>(code), text ? text : "unknown");
      }()) {}

}  // namespace titin
