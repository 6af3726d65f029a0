/// What a term's table says should be wrapped around it.
#include <fmt/format.h>

#include <algorithm>

#include "base/log.hpp"
#include "materials/damage.hpp"
#include "materials/fibre_maxwell.hpp"
#include "materials/maxwell.hpp"
#include "materials/response.hpp"
#include "materials/viscoelastic.hpp"

namespace titin {
namespace {

enum class Reference { long_term, instantaneous };

void read_reference(Section& s, Reference& reference) {
  s.choose("reference", reference, {{"long_term", Reference::long_term}, {"instantaneous", Reference::instantaneous}},
           {.doc = "which stress the law gives: the one that stays, or the one at once"});
}

/// Branches with nearly the same time are one branch: fits with such pairs do not determine their strengths.
void advise_times(const Section& s, std::vector<double> times) {
  constexpr double least = 1.5;
  std::sort(times.begin(), times.end());
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (times[i + 1] < least * times[i])
      logging::warning(fmt::format("{}.time: {:g} s and {:g} s are nearly the same branch; one is enough", s.path(),
                                   times[i], times[i + 1]));
}

/// Strengths over the reference stress; instantaneous ones must leave something.
RelaxationSeries read_prony(Section s) {
  RelaxationSeries series;
  Reference reference = Reference::long_term;
  read_reference(s, reference);
  s.read("strength", series.strength,
         {.range = non_negative, .required = true, .doc = "of each branch, over the reference stress"});
  s.read("time", series.time,
         {.unit = "s", .range = positive, .required = true, .doc = "relaxation time of each branch"});
  if (series.strength.size() != series.time.size())
    s.error("time", fmt::format("{} times for {} strengths", series.time.size(), series.strength.size()),
            "give one for each branch");
  advise_times(s, series.time);
  if (reference == Reference::instantaneous) {
    for (double g : series.strength) series.elastic -= g;
    if (series.elastic < 0)
      s.error("strength", "the branches take more than the instantaneous stress", "keep their sum below 1");
  }
  return series;
}

RelaxationSeries read_spectrum(Section s) {
  double c = 0, shortest = 0, longest = 0;
  Reference reference = Reference::instantaneous;
  read_reference(s, reference);
  s.read("c", c, {.range = positive, .required = true, .doc = "height of the spectrum c / tau"});
  s.read("shortest", shortest,
         {.unit = "s", .range = positive, .required = true, .doc = "relaxation time where it begins"});
  s.read("longest", longest,
         {.unit = "s", .range = positive, .required = true, .doc = "relaxation time where it ends"});
  if (s.describing() || !(shortest > 0) || !(longest > 0)) return {};
  if (longest <= shortest) {
    s.error("longest", "not above the shortest", "give longest > shortest");
    return {};
  }
  const RelaxationSeries series = RelaxationSeries::fung(c, shortest, longest);
  return reference == Reference::instantaneous ? series.instantaneous() : series;
}

RelaxationSeries read_fractional(Section s) {
  double order = 0, modulus = 0, window = 0;
  s.read("order", order,
         {.range = {.min = 0, .max = 1, .open_min = true, .open_max = true},
          .required = true,
          .doc = "alpha of D^alpha, 0.1 to 0.3 in tissue"});
  s.read("modulus", modulus,
         {.range = non_negative, .required = true, .doc = "B of S = S_e + B D^alpha S_e, in s^alpha"});
  s.read("window", window,
         {.unit = "s",
          .range = positive,
          .required = true,
          .doc = "longest time that matters; the series is good from 1e-4 of it"});
  return s.describing() || !(window > 0) ? RelaxationSeries{} : RelaxationSeries::caputo(order, modulus, window);
}

Wrapper viscoelastic(RelaxationSeries series) {
  return [series = std::move(series)](std::shared_ptr<const Response> inside) {
    return std::make_shared<ViscoelasticResponse>(series, std::move(inside));
  };
}

Wrapper read_maxwell(Section s, const Term* term, TermOptions options) {
  MaxwellFlow flow;
  flow.bind(s);
  if (!term) return {};
  const bool along_fibres = term->needs_fibre() || term->needs_second_fibre();
  const bool both_families = term->needs_fibre() && term->needs_second_fibre();
  if (both_families || term->uses().has_rate() || !term->stores_energy())
    s.error("", "the spring of a Maxwell branch is an isotropic law, or one of a single fibre that stores energy",
            "take prony for other laws");
  return [=](std::shared_ptr<const Response> spring) -> std::shared_ptr<const Response> {
    if (along_fibres) return std::make_shared<FibreMaxwellResponse>(flow.viscosity, options, std::move(spring));
    return std::make_shared<MaxwellResponse>(flow, std::move(spring));
  };
}

}  // namespace

std::vector<Wrapper> read_wrappers(Section& term, const Term* law, TermOptions options) {
  std::vector<Wrapper> wrappers;
  const auto wants = [&](const char* name) { return term.describing() || term.has(name); };
  if (wants("maxwell"))
    wrappers.push_back(
        read_maxwell(term.section("maxwell", "a finite-strain branch: the term is the spring of a dashpot in series"),
                     law, options));
  if (wants("prony")) wrappers.push_back(viscoelastic(read_prony(term.section("prony", "relaxation by branches"))));
  if (wants("spectrum"))
    wrappers.push_back(viscoelastic(read_spectrum(term.section("spectrum", "Fung's continuous relaxation spectrum"))));
  if (wants("fractional"))
    wrappers.push_back(viscoelastic(read_fractional(term.section("fractional", "Caputo's fractional derivative"))));
  if (wrappers.size() > 1 && !term.describing())
    term.error("", "one of maxwell, prony, spectrum and fractional at a time", "drop the others");
  if (wants("damage")) {
    DamageLaw law;
    Section damage = term.section("damage", "softening by the largest energy so far");
    law.bind(damage);
    if (!term.describing() && law.time == 0)
      logging::warning(
          fmt::format("{}.time: without a relaxation time softening gathers in one row of elements, and "
                      "results depend on the mesh",
                      damage.path()));
    wrappers.push_back([law](std::shared_ptr<const Response> inside) {
      return std::make_shared<DamageResponse>(law, std::move(inside));
    });
  }
  return wrappers;
}

}  // namespace titin
