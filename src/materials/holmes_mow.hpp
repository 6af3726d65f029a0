/// Holmes-Mow solid of cartilage: W = c/2 (exp(Q) - 1) [J/m^3], c = (lambda + 2 mu)/(2 beta),
/// Q = beta/(lambda + 2 mu) [(2 mu - lambda)(I1 - 3) + lambda (I2 - 3) - (lambda + 2 mu) ln J^2], I1 and I2 of C.
/// Holmes & Mow (1990), J. Biomech. 23, 1145. Aggregate modulus at rest lambda + 2 mu. Takes no volumetric law.
#pragma once

#include "materials/full_strain.hpp"
#include "materials/registry.hpp"

namespace titin {

struct HolmesMow {
  static constexpr auto name = "holmes_mow";
  static constexpr auto formula =
      "W = c/2 (exp(Q) - 1), c = H/(2 beta), Q = beta/H [(2 mu - lambda)(I1 - 3) + lambda (I2 - 3) - H ln J^2], H = "
      "lambda + 2 mu";
  static constexpr auto source = "Holmes & Mow 1990, J. Biomech. 23:1145";
  inline static const std::array published{ParameterSet{
      "bovine articular cartilage, confined compression", R"(mu = "0.2 MPa", lambda = "0 Pa", beta = 0.35)",
      "Ateshian et al. 1997, J. Biomech. 30:1157 (H = lambda + 2 mu = 0.40 MPa; confined compression does not tell "
      "lambda, which is 0 here)"}};
  static constexpr std::array uses{Invariant::I1, Invariant::I2, Invariant::J};

  double mu = 0, lambda = 0, beta = 0;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .range = positive, .required = true, .doc = "shear modulus at rest"});
    s.read("lambda", lambda,
           {.unit = "Pa", .range = non_negative, .required = true, .doc = "first Lame constant at rest"});
    s.read("beta", beta, {.range = positive, .required = true, .doc = "how fast it stiffens"});
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
    using std::expm1;
    const auto [e1, e2, log_J] = full_strain(x);
    const double H = lambda + 2 * mu;
    const T Q = beta / H * ((2 * mu - lambda) * e1 + lambda * e2 - 2 * H * log_J);
    return 0.25 * H / beta * expm1(Q);
  }
};
TITIN_LAW(HolmesMow)

}  // namespace titin
