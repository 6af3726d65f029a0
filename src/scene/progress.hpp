/// The line of a step: what a user watches. Explicit runs have many steps, and a line for each percent of their time.
#pragma once

#include <string>

#include "solve/clock.hpp"
#include "solve/model.hpp"

namespace titin {

class Progress {
 public:
  /// Prints the header. `done`: part of the simulated time that an earlier run did.
  Progress(const Quantity& shown, bool is_explicit, double done = 0);
  void line(const Clock& clock, const Step& step, const Quantity& shown);

 private:
  double start_, done_at_start_;
  int width_;  // of the shown quantity's column
  bool is_explicit_;
  int percent_ = -1;  // of the last line
};

/// "0.8 s", "80 s", "3 min", "2.5 h".
std::string duration(double seconds);

}  // namespace titin
