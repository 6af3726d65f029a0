/// Which linear solver `auto` takes: by the number of unknowns, and by what factors would need of the memory that is
/// left.
#pragma once

#include <string>

#include "solve/petsc.hpp"

namespace titin {

enum class LinearMethod { automatic, direct, block, condensed };

struct LinearChoice {
  LinearMethod method = LinearMethod::direct;
  std::string why;
  bool fits = true;  ///< do factors go into the memory?
};

/// What MUMPS's factors of a matrix with so many unknowns take [bytes], measured (docs/verification/solvers.md).
double memory_of_factors(double unknowns, int components);

/// `can_block`: the elements give the block solver what it needs; `memory_left` [bytes].
LinearChoice automatic_choice(double unknowns, int components, bool can_block, double memory_left);

/// The method for K; says in the log what `automatic` took and why, and throws InputError for those who ask for what
/// the elements do not allow. Collective.
LinearMethod chosen_method(LinearMethod asked, Mat K, bool can_block);

}  // namespace titin
