/// What a run follows, by name: columns of history.csv without their units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solve/model.hpp"

namespace titin {

/// Its place among them, if it is there.
std::optional<std::size_t> place_of(const std::string& name, const std::vector<Quantity>& followed);
/// Of one that is not there: "did you mean "..."?", or all that there are.
std::string meant_instead(const std::string& name, const std::vector<Quantity>& followed);

}  // namespace titin
