#include "materials/material_advice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.hpp"

namespace titin {
namespace {

/// Smallest of the three shear moduli at rest [Pa]; 0 for fibres alone.
double shear_modulus(const Material& material) {
  const Vec3 fibre = material.fibre();
  PointInput rest;
  rest.n = 1, rest.F = rest.F_old = &identity;
  if (material.has_fibres()) rest.fibre = &fibre;
  Mat3 P;
  Mat9 A;
  material.stress(rest, &P, &A);
  constexpr double rounding = 1e-9;                                           // of the stiffest entry
  const double shear = std::min({A[9 * 1 + 1], A[9 * 2 + 2], A[9 * 5 + 5]});  // A_iJiJ of xy, xz and yz
  return shear > rounding * *std::max_element(A.begin(), A.end()) ? shear : 0;
}

}  // namespace

void advise(const Section& section, const Material& material) {
  constexpr double stiffest = 1e5;  // 1e4 hold the volume to a thousandth under stresses of ten times mu
  const double bulk = material.volumetric(1).d2U, shear = shear_modulus(material);
  if (shear > 0 && bulk > stiffest * shear)
    logging::warning(fmt::format(
        "{}: the bulk modulus is {:.1g} times the shear modulus at rest: solvers lose that many digits, and "
        "1e4 hold the volume as well",
        section.path(), bulk / shear));
}

}  // namespace titin
