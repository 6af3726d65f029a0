/// Terms in the distortional principal stretches: W = sum_p c_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) [J/m^3],
/// l_a = J^-1/3 lambda_a. Such a law gives its powers, `std::vector<StretchPower> powers() const`, and nothing else.
///
/// Stress and tangent are closed forms in the eigenpairs of C, whose divided differences are those of powers: exact at
/// equal and at nearly equal stretches (docs/theory/materials.md). Ogden (1984), Non-linear Elastic Deformations, 6.1.
#pragma once

#include <concepts>
#include <vector>

#include "materials/term.hpp"

namespace titin {

struct StretchPower {
  double coefficient;  ///< c_p [Pa]
  double exponent;     ///< alpha_p; 0 stands for c_p sum (ln l_a)^2, to which powers with 2 c_p/alpha_p^2 tend
};

template <class Law>
concept PowerLaw = requires(const Law& law) {
  { law.powers() } -> std::convertible_to<std::vector<StretchPower>>;
};

class PowerTerm final : public Term {
 public:
  explicit PowerTerm(std::vector<StretchPower> powers) : powers_(std::move(powers)) {}
  InvariantSet uses() const override { return {}; }
  bool stores_energy() const override { return true; }
  void add_derivatives(const PointBlock&, double, DerivativeBlock&) const override {}
  void add_energy(const PointBlock& points, double weight, double* sum) const override;
  void add_stress(const PointBlock& points, double weight, Mat3* P, Mat9* A) const override;

 private:
  std::vector<StretchPower> powers_;
};

}  // namespace titin
