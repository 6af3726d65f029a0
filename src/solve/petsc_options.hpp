/// Options of PETSc and hypre that a scene gives in its table [petsc], for those who know them;
/// docs/howto/solver_options.md tells which solver takes which.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/config.hpp"
#include "solve/petsc.hpp"

namespace titin {

/// Names without PETSc's leading "-", and values as PETSc would read them on a command line.
struct PetscOptionsConfig {
  std::vector<std::pair<std::string, std::string>> values;
  void bind(Section& s);
};

/// The options are PETSc's as long as this lives.
class PetscOptionsInForce {
 public:
  explicit PetscOptionsInForce(PetscOptionsConfig config);
  ~PetscOptionsInForce();
  PetscOptionsInForce(const PetscOptionsInForce&) = delete;

  /// Those that no solver has asked for so far, as the scene names them, sorted.
  std::vector<std::string> unused() const;

 private:
  PetscOptionsConfig config_;
};

/// Sets an option unless the scene gave it.
void set_default_option(const std::string& name, const char* value);

/// KSPSetFromOptions and its like. What PETSc refuses there is the scene's fault if the scene gave any option: an
/// InputError then, else a PetscError.
void check_options(PetscErrorCode code);

}  // namespace titin
