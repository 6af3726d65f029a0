/// A run that writes nothing: how one quantity of a scene goes, and what that costs.
#pragma once

#include <string>
#include <vector>

namespace titin {

struct Probe {
  std::vector<double> times, values;        // [s], in the quantity's unit, from the start on
  double largest = 0, largest_of_unit = 0;  // size of the quantity; of all with its unit
  double cpu_seconds = 0;                   // of all ranks
  long cells = 0, unknowns = 0;
  int steps = 0, order = 1;  // of the scheme, as its steps say
  long newton = 0;           // iterations, those of steps that failed too
  std::string failure;       ///< empty when it got to the end; else in words what kept it
  bool ok() const { return failure.empty(); }
};

/// Runs the scene with these overrides. A quantity that the run does not follow is an InputError, as is a scene that is
/// wrong. Collective.
Probe probe(const std::string& file, const std::vector<std::string>& overrides, const std::string& quantity);

/// max |a - b| / max |b|, at the times of the one with fewer, linear between those of the other. Both must have got to
/// the end.
double difference(const Probe& a, const Probe& b);

/// Fewest straight lines over equal times, a power of two, that miss it by at most this part of its largest value.
int lines_that_follow(const Probe& probe, double error);

}  // namespace titin
