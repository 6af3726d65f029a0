#include "scene/fidelity.hpp"

#include <fmt/format.h>

#include "base/words.hpp"
#include "scene/followed.hpp"

namespace titin {
namespace {

constexpr Range tolerances{.min = 1e-6, .max = 1};

}  // namespace

void FidelityConfig::bind(Section root) {
  root.choose("fidelity", fidelity, {{"as_written", Fidelity::as_written}, {"auto", Fidelity::automatic}},
              {.doc = "auto: a run first finds the cheapest setting that keeps fidelity_quantity within "
                      "fidelity_tolerance, as titin advise does, and takes it"});
  root.read("fidelity_quantity", quantity,
            {.doc = "a column of history.csv, without its unit (default: the one that a run shows)"});
  root.read("fidelity_tolerance", tolerance,
            {.range = tolerances, .doc = "error of fidelity_quantity over its largest value in time"});
  const bool said = root.has("fidelity");
  for (const char* key : {"fidelity_quantity", "fidelity_tolerance"})
    if (root.has(key) && !said) root.error(key, "has no effect without fidelity", "add fidelity = \"auto\"");
}

void FidelityConfig::match(const std::vector<Quantity>& followed, Section root) const {
  if (!quantity.empty() && !place_of(quantity, followed))
    root.error("fidelity_quantity", fmt::format("this run follows no {}", in_quotes(quantity)),
               meant_instead(quantity, followed));
}

std::vector<std::string> as_chosen(std::vector<std::string> proposal, const std::string& quantity) {
  for (const auto& [key, value] :
       {std::pair("fidelity", std::string("as_written")), std::pair("fidelity_quantity", toml_string(quantity))})
    proposal.push_back(fmt::format("{}={}", key, value));
  return proposal;
}

}  // namespace titin
