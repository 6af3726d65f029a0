/// Invariants of C itself from those of Cbar and J, for laws that do not split off the volume.
#pragma once

#include "materials/term.hpp"

namespace titin {

template <class T>
struct FullStrain {
  T e1, e2, log_J;  ///< tr C - 3, ((tr C)^2 - tr C^2)/2 - 3, ln J
};

/// Small strains keep their digits: J^(2/3) - 1 comes from expm1.
template <class T>
FullStrain<T> full_strain(const Invariants<T>& x) {
  using std::expm1, std::log1p;
  const T log_J = log1p(x.eJ());
  return {x.e1() + (3.0 + x.e1()) * expm1(2.0 / 3 * log_J), x.e2() + (3.0 + x.e2()) * expm1(4.0 / 3 * log_J), log_J};
}

}  // namespace titin
