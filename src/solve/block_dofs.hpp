/// A rank's view of distributed dofs: its own, then those of others that its cells and patches touch (ghosts), then one
/// more place that is always zero and stands for every constrained dof.
#pragma once

#include <petscsf.h>

#include <vector>

#include "solve/petsc.hpp"

namespace titin {

class LocalDofs {
 public:
  /// `owned` dofs on this rank; `touched`: global numbers, any order, repetitions and negative ones (constrained)
  /// allowed. Collective.
  LocalDofs(PetscInt owned, std::vector<PetscInt> touched);
  ~LocalDofs();
  LocalDofs(const LocalDofs&) = delete;

  int owned() const { return owned_; }
  int zero() const { return owned_ + static_cast<int>(ghosts_.size()); }  ///< the place that stays zero
  int size() const { return zero() + 1; }
  PetscInt first() const { return first_; }  ///< global number of this rank's first
  int local(PetscInt global) const;          ///< zero() for negative numbers

  /// Ghosts take their owners' values. Collective.
  void fetch(float* v) const { fetch(v, MPI_FLOAT); }
  void fetch(double* v) const { fetch(v, MPI_DOUBLE); }
  /// Owners add their ghosts' values; the last place becomes zero again. Collective.
  void add(float* v) const { add(v, MPI_FLOAT, sizeof(float)), v[zero()] = 0; }
  void add(double* v) const { add(v, MPI_DOUBLE, sizeof(double)), v[zero()] = 0; }

 private:
  void fetch(void* v, MPI_Datatype type) const;
  void add(void* v, MPI_Datatype type, std::size_t bytes) const;

  int owned_;
  PetscInt first_ = 0;
  std::vector<PetscInt> ghosts_;  // global, increasing
  PetscSF exchange_ = nullptr;    // null on one rank
};

}  // namespace titin
