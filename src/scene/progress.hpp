/// The line of a step: what a user watches.
#pragma once

#include <string>

#include "solve/clock.hpp"
#include "solve/model.hpp"

namespace titin {

class Progress {
 public:
  explicit Progress(const Quantity& shown);  ///< prints the header
  void line(const Clock& clock, const Step& step, const Quantity& shown) const;

 private:
  double start_;
  int width_;  // of the shown quantity's column
};

/// "0.8 s", "80 s", "3 min", "2.5 h".
std::string duration(double seconds);

}  // namespace titin
