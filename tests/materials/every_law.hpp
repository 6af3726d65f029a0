/// Every law of the registry with every parameter set: what the tests that no law escapes walk through.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "materials_for_tests.hpp"

namespace titin::testing {

// Tens of roundings in sums of nine products.
inline constexpr double round_off = 1e-12;

/// Parameters for laws of which no traceable set is published, and more choices of those with options.
inline const std::map<std::string, std::vector<std::string>>& more_parameters() {
  static const std::map<std::string, std::vector<std::string>> sets{
      {"mooney_rivlin", {R"(c1 = "6 kPa", c2 = "2 kPa")"}},
      {"demiray", {R"(a = "10 kPa", b = 3)"}},
      {"active_stress",
       {R"(peak_stress = "50 kPa", activation = 0.8, measure = "cauchy")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "cauchy", across = 0.4, family = "second")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "cauchy", across = 1)",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "cauchy", projection = "deviator")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "kirchhoff", across = 0.3)",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "kirchhoff", projection = "deviator")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "pk1")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "pk1", projection = "deviator")",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "pk2", along = 0.9, across = 0.3)",
        R"(peak_stress = "50 kPa", activation = 0.8, measure = "pk2", across = 0.3, projection = "deviator")"}},
      {"cann",
       {R"(moduli_1 = "5, 2, 3, 1 kPa", exponents_1 = [1.5, 0.8], moduli_2 = "4, 1, 2, 0.5 kPa", exponents_2 = [2, 0.6])"}},
      {"cann_fibre", {R"(w1 = "3 kPa", w2 = "1 kPa", b = 2.5)"}},
      {"icnn",
       {R"(amplitude = "1, 0.7, 0.4 kPa", weight_1 = [0.9, 0.3, 9], weight_2 = [0.1, 0.25, 8], bias = [-0.4, 0.1, -1])"}},
      {"isotropic_family", {R"(mu = "10 kPa", a = -0.3)"}},
      {"hencky", {R"(mu = "10 kPa")"}},
      {"fung",
       {R"(c = "2 kPa", bff = 8, bss = 6, bnn = 3, bfs = 12, bsn = 3, bfn = 2)",
        R"(c = "2 kPa", bff = 8, bss = 6, bnn = 3, bffss = 2, bssnn = -1, bnnff = 1.5, bfs = 5, bsn = 3, bfn = 2)"}},
      {"hill_active",
       {R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.6, curve = "flexodeal_smooth")",
        R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.6, curve = "degroote")",
        R"(peak_stress = "200 kPa", max_strain_rate = "5 1/s", activation = 0.6, curve = "degroote", family = "second")"}},
      {"hill_passive", {R"(peak_stress = "200 kPa", curve = "degroote")"}},
      {"veronda_westmann", {R"(c1 = "2 kPa", c2 = 3)"}},
      {"compressible_neo_hookean", {R"(mu = "10 kPa", lambda = "40 kPa")"}},
      {"st_venant_kirchhoff", {R"(mu = "10 kPa", lambda = "40 kPa")"}},
      {"holmes_mow", {R"(mu = "0.2 MPa", lambda = "0.1 MPa", beta = 1.1)"}},
      {"linear_fibre", {R"(stiffness = "200 kPa")"}},
      {"goh",
       {R"(k1 = "2.4 kPa", k2 = 0.84, kappa = 0.1)", R"(k1 = "2.4 kPa", k2 = 0.84, kappa = 0.1, switch = "I4")",
        R"(k1 = "2.4 kPa", k2 = 0.84, kappa = 0.1, switch_width = 0.05)",
        R"(k1 = "2.4 kPa", k2 = 0.84, switch = "none", family = "second")"}},
      {"weiss_fibre",
       {R"(c3 = "0.57 MPa", c4 = 48, c5 = "467.1 MPa", lambda_straight = 1.062)",
        R"(c3 = "0.57 MPa", c4 = 48, lambda_straight = 1.2)"}},
      {"blemker_passive",
       {R"(peak_stress = "300 kPa", optimal_stretch = 1, p1 = 0.05, p2 = 6.6, lambda_straight = 1.4)",
        R"(peak_stress = "300 kPa", optimal_stretch = 1, p1 = 0.05, p2 = 6.6, lambda_straight = 1.05)"}},
      {"ogden",
       {R"(mu = "2 kPa", alpha = [-20], normalisation = "abaqus")",
        R"(mu = "2, 1 kPa", alpha = [2, -4], normalisation = "febio")"}},
      {"gent", {R"(mu = "10 kPa", limit = 20)"}},
      {"arruda_boyce", {R"(mu = "10 kPa", locking_stretch = 1.8)"}},
      {"collagen_table", {R"(stress_scale = "200 kPa", stress_free_rest = true)"}},
  };
  return sets;
}

struct Case {
  LawInfo law;
  std::string parameters, more;
  bool published;
  MaterialPointer material() const { return material_of(law.name, parameters, more); }
};

/// Every law with every parameter set, with isochoric and with full fibre invariants.
inline void for_each_case(const std::function<void(const Case&)>& check) {
  for (const LawEntry& entry : law_entries()) {
    std::vector<std::pair<std::string, bool>> sets;
    for (const ParameterSet& p : entry.info.published) sets.emplace_back(p.parameters, true);
    const auto more = more_parameters().find(entry.info.name);
    if (more != more_parameters().end())
      for (const std::string& p : more->second) sets.emplace_back(p, false);
    EXPECT_FALSE(sets.empty()) << entry.info.name << " has no parameters to test it with";
    for (const auto& [parameters, published] : sets)
      for (const char* measure : {"isochoric", "full"}) {
        if (!entry.info.needs_fibre && std::string(measure) == "full") continue;
        SCOPED_TRACE(entry.info.name + " { " + parameters + " } " + measure);
        check({entry.info, parameters, fmt::format("fibre_invariants = \"{}\"\n", measure), published});
      }
  }
}

inline Mat3 stretched_along(const Mat3& F, const Vec3& a, double stretch) {
  Mat3 U = dyad(a, a);
  for (double& x : U) x *= stretch - 1;
  for (int i = 0; i < 9; i += 4) U[i] += 1;
  return multiply(F, U);
}

/// A point well inside of one piece of every curve: the fibre at stretch 1.1, shortening at 3 to 12 % of the largest
/// rate and turning.
inline Point general_point(FibreRate rate) {
  Point p{.F = general_F, .rate = rate, .dt = 0.5};
  p.F_old = multiply(rotation(0.2), stretched_along(general_F, p.fibre, 1.25));
  return p;
}

inline constexpr FibreRate rates[] = {FibreRate::none, FibreRate::stretch_difference, FibreRate::velocity_gradient};

}  // namespace titin::testing
