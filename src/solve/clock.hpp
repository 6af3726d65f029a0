/// Where a run is in time, and how large its next step is: halved when a step fails, doubled back towards the nominal
/// step when steps are easy again, and never past the end.
#pragma once

#include <limits>

#include "base/config.hpp"
#include "solve/model.hpp"

namespace titin {

struct ClockConfig {
  double end = 0, step = 0;  // [s]
  int max_cuts = 8;
  void bind(Section& s);
};

class Clock {
 public:
  /// `largest_dt` [s]: what the formulation can take from the start (Model::largest_dt).
  explicit Clock(const ClockConfig& config, double largest_dt = std::numeric_limits<double>::infinity());

  bool done() const;
  double time() const { return time_; }
  double dt() const;  ///< next step to try; lands on the end exactly
  int steps() const { return steps_; }
  int cuts() const { return cuts_; }  ///< in the whole run
  double fraction() const;            ///< of the simulated time that is done

  void accept(const Step& step, double largest_dt);
  /// Halves the step. Returns false when it may not be cut further: the run ends there.
  bool cut(const Step& step);

 private:
  bool reaches_end(double dt) const;

  ClockConfig config_;
  double time_ = 0, dt_ = 0;
  double largest_dt_;
  double origin_ = 0, stride_ = 0;  // since the step last changed, time is origin + strides * stride
  long strides_ = 0;
  int steps_ = 0, cuts_ = 0, cuts_in_a_row_ = 0, easy_steps_ = 0;
};

}  // namespace titin
