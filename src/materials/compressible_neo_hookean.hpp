/// Compressible neo-Hookean: W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2 [J/m^3].
/// Simo & Pister (1984), Comput. Methods Appl. Mech. Eng. 46, 201. Takes no volumetric law.
#pragma once

#include "materials/full_strain.hpp"
#include "materials/registry.hpp"

namespace titin {

struct CompressibleNeoHookean {
  static constexpr auto name = "compressible_neo_hookean";
  static constexpr auto formula = "W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2";
  static constexpr auto source = "Simo & Pister 1984, Comput. Methods Appl. Mech. Eng. 46:201";
  inline static const std::array published{ParameterSet{
      "calf articular cartilage at equilibrium", R"(mu = "0.17 MPa", lambda = "0.30 MPa")",
      "Soltz & Ateshian 2000, J. Biomech. Eng. 122:576 (lambda is its aggregate modulus 0.64 MPa less 2 mu)"}};
  static constexpr std::array uses{Invariant::I1, Invariant::J};

  double mu = 0, lambda = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus at rest"});
    s.read("lambda", lambda, {.unit = "Pa", .required = true, .doc = "first Lame constant at rest"});
    if (!s.describing() && !(3 * lambda + 2 * mu > 0))
      s.error("lambda", "the bulk modulus lambda + 2/3 mu is not positive", "raise lambda above -2/3 mu");
  }
  std::vector<Advice> advice() const {
    constexpr double nearly_incompressible = 50;  // Poisson's ratio 0.49
    if (lambda <= nearly_incompressible * mu) return {};
    return {{"lambda",
             "Poisson's ratio is above 0.49: elements of displacements alone lock; take neo_hookean with a "
             "volumetric law"}};
  }
  template <class T>
  T energy(const Invariants<T>& x) const {
    const auto [e1, e2, log_J] = full_strain(x);
    return mu * (0.5 * e1 - log_J) + 0.5 * lambda * log_J * log_J;
  }
};
TITIN_LAW(CompressibleNeoHookean)

}  // namespace titin
