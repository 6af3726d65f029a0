/// Exponentials of squared strains, exp(b E^2), run out of numbers at b E^2 = 709: does that come within the stretches
/// of tissue? Newton's trial states go there too, and a point that is not a number costs a step.
#pragma once

#include <cmath>

#include "materials/registry.hpp"

namespace titin {

/// I4 - 1 at a stretch of 1.5, more than muscle and artery bear.
inline constexpr double strain_of_tissue = 1.5 * 1.5 - 1;

/// Advice when exp(exponent strain^2) has no value.
inline std::vector<Advice> advice_of_exponent(const char* key, double exponent, double strain) {
  constexpr double largest = 709;  // ln of the largest double
  if (!(exponent * strain * strain > largest)) return {};
  return {
      {key, fmt::format("its exponential overflows before a stretch of 1.5, at a strain of {:.3g}: steps that go there "
                        "fail",
                        std::sqrt(largest / exponent))}};
}

}  // namespace titin
