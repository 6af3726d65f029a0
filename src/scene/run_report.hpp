/// What a run says of itself: the parts of run.json that are no physics.
#pragma once

#include <map>
#include <string>

#include "io/run_summary.hpp"
#include "solve/model.hpp"

namespace titin {

std::map<std::string, std::string> library_versions();
/// Time, memory and warnings so far, of all ranks. Collective.
void add_costs(RunSummary& summary);
/// Adds one accepted step.
void add_step(RunSummary& summary, const Step& step);
/// The phases and what they took, longest first, into the log.
void log_timers(const RunSummary& summary);
/// The figure of merit of explicit formulations and the bound that memory sets it (roofline: Williams, Waterman,
/// Patterson 2009, Commun. ACM 52:65). Collective.
void add_explicit_speed(RunSummary& summary, const Model& model);
void log_explicit_speed(const RunSummary& summary);

}  // namespace titin
