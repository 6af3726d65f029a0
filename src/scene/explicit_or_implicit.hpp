/// What the steps of the other formulation would come to: a line for those who choose between both.
///
/// Explicit steps are as long as the fastest wave, c^2 = (K + 4 mu / 3) / rho, takes through 0.4 of the inner ball of a
/// simplex that a box is cut into. Implicit ones are as many as straight lines need to follow the quantity.
#pragma once

#include <string>

#include "scene/candidate.hpp"
#include "scene/scene_facts.hpp"

namespace titin {

/// Of the scene on a box of so many nodes; NaN where it cannot be told.
double explicit_steps(const SceneFacts& facts, const Candidate& nodes, double end);

/// Of a box that has implicit steps; "" where it cannot be told.
std::string explicit_instead(const SceneFacts& facts, const Candidate& best, double end);

/// Of a solid that has `steps` explicit ones; `error` is what lines may miss of the quantity's largest value. "" for
/// fluids.
std::string implicit_instead(const SceneFacts& facts, const Probe& probe, double steps, double error);

}  // namespace titin
