/// Ogden, distortional: W = sum_p mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) [J/m^3], l_a = J^-1/3
/// lambda_a. Ogden (1972), Proc. R. Soc. A 326, 565. Shear modulus at rest 1/2 sum mu_p alpha_p.
///
/// Published sets use three normalisations of the coefficient: mu/alpha (`ogden`), 2 mu/alpha^2 (`abaqus`, where the
/// shear modulus is sum mu_p) and mu/alpha^2 (`febio`, 1/2 sum mu_p). A term is rank-one convex for alpha >= 3/2 and
/// for alpha <= -3: Hartmann & Neff (2003), Int. J. Solids Struct. 40, 2767.
#pragma once

#include "materials/registry.hpp"

namespace titin {

struct Ogden {
  static constexpr auto name = "ogden";
  static constexpr auto formula =
      "W = sum_p mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3), l_a = J^-1/3 lambda_a";
  static constexpr auto source = "Ogden 1972, Proc. R. Soc. A 326:565";
  enum class Normalisation { ogden, abaqus, febio };
  inline static const std::array published{
      ParameterSet{"human brain, at once", R"(mu = "842 Pa", alpha = [-4.7], normalisation = "abaqus")",
                   "Miller & Chinzei 2002, J. Biomech. 35:483; its W = 2 mu/alpha^2 (...) is the normalisation abaqus; "
                   "relaxes by 0.450 in 0.5 s and 0.365 in 50 s"},
      ParameterSet{
          "adipose tissue", R"(mu = "0.4 kPa", alpha = [20], normalisation = "abaqus")",
          "Comley & Fleck 2012, Int. J. Impact Eng. 46:1; its W = 2 mu/alpha^2 (...) is the normalisation abaqus"},
      ParameterSet{
          "vulcanised rubber of Treloar", R"(mu = "630, 1.2, -10 kPa", alpha = [1.3, 5, -2])",
          "Ogden 1972, Proc. R. Soc. A 326:565 (6.3, 0.012, -0.1 kg/cm^2, here with 100 kPa for one of these)"}};

  std::vector<double> mu, alpha;
  Normalisation normalisation = Normalisation::ogden;

  void bind(Section& s) {
    s.read("mu", mu, {.unit = "Pa", .required = true, .doc = "moduli, one for each power"});
    s.read("alpha", alpha, {.required = true, .doc = "exponents, none of them 0"});
    s.choose("normalisation", normalisation,
             {{"ogden", Normalisation::ogden}, {"abaqus", Normalisation::abaqus}, {"febio", Normalisation::febio}},
             {.doc = "coefficient of a power: mu/alpha, 2 mu/alpha^2, or mu/alpha^2"});
    if (!s.describing()) check(s);
  }
  std::vector<Advice> advice() const {
    std::vector<Advice> list;
    for (const StretchPower& p : powers())
      if (!(p.coefficient > 0 && (p.exponent >= 1.5 || p.exponent <= -3)))
        list.push_back({"alpha", fmt::format("the term with alpha = {:g} is not rank-one convex (those with alpha >= "
                                             "1.5 or <= -3 and mu alpha > 0 are): large strains may find no stable "
                                             "state",
                                             p.exponent)});
    return list;
  }
  std::vector<StretchPower> powers() const {
    std::vector<StretchPower> list;
    for (std::size_t p = 0; p < std::min(mu.size(), alpha.size()); ++p)
      list.push_back({coefficient(mu[p], alpha[p]), alpha[p]});
    return list;
  }

 private:
  double coefficient(double modulus, double exponent) const {
    if (normalisation == Normalisation::ogden) return modulus / exponent;
    return (normalisation == Normalisation::abaqus ? 2 : 1) * modulus / (exponent * exponent);
  }
  void check(Section& s) const {
    if (mu.size() != alpha.size() || mu.empty())
      return s.error("alpha", fmt::format("{} exponents for {} moduli", alpha.size(), mu.size()),
                     "give one for each modulus");
    double shear_modulus = 0;
    for (const StretchPower& p : powers()) {
      if (p.exponent == 0) return s.error("alpha", "an exponent of 0 stores no energy", "leave that term out");
      shear_modulus += 0.5 * p.coefficient * p.exponent * p.exponent;
    }
    if (!(shear_modulus > 0))
      s.error("mu", "the shear modulus at rest is not positive", "check the signs of mu and alpha");
  }
};
TITIN_LAW(Ogden)

}  // namespace titin
