/// When a run saves its state, and when it must end to be in time.
#pragma once

#include "base/config.hpp"
#include "solve/clock.hpp"

namespace titin {

struct SavingConfig {
  int every = 0;           // steps; 0: not by steps
  double interval = 1800;  // [s] of real time
  int keep = 2;
  double limit = 0;  // [s] of real time since the program started; 0: none
  void bind(Section& s);
};

/// All functions are collective: rank 0's clock counts.
class Saving {
 public:
  explicit Saving(const SavingConfig& config) : config_(config), last_save_(0) {}

  bool due_by_steps(const Clock& clock) const;
  bool due_by_time() const;
  /// Another step and a checkpoint, as long as the longest so far, would not be in time.
  bool out_of_time() const;
  void stepped();                      ///< one more step, whatever came of it
  void saved(long step, double took);  ///< `took` [s]
  long last_step() const { return last_step_; }

 private:
  SavingConfig config_;
  double last_save_ = 0, last_step_end_ = 0;    // [s] since the program started
  double longest_step_ = 0, longest_save_ = 0;  // [s]
  long last_step_ = -1;                         // that was saved
};

}  // namespace titin
