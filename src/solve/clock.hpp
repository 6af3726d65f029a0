/// Where a run is in time, and how large its next step is.
///
/// Fixed steps (tolerance 0): the nominal one, halved when a step fails, doubled back when steps are easy again.
/// Adaptive steps: chosen by a PI controller from the error that the formulation estimates for each,
///
///   dt_next = dt safety e^(-k_I) e_last^(k_P),   e = error / tolerance^((p+1)/p),   k_I = 0.7 / (p+1), k_P = 0.4 /
///   (p+1)
///
/// (Gustafsson 1991, ACM Trans. Math. Softw. 17:533), p the order of the scheme: steps with e <= 1 are accepted, and
/// what such steps add up to in a run is proportional to the tolerance. They land on every time at which something has
/// a kink or is to be written. No step goes past the end.
///
/// Explicit formulations say themselves how long a step may be (Model::largest_dt); theirs land on those times too.
#pragma once

#include <limits>
#include <vector>

#include "base/config.hpp"
#include "solve/model.hpp"

namespace titin {

struct ClockConfig {
  double end = 0, step = 0;  // [s]
  int max_cuts = 8;
  double tolerance = 0;       // of adaptive steps; 0: fixed ones
  double largest_step = 0;    // [s] of adaptive steps; 0: no limit
  bool by_stability = false;  // explicit formulation: steps are as long as it can take them, `step` at most
  void bind(Section& s);
};

class Clock {
 public:
  /// `largest_dt` [s]: what the formulation can take from the start (Model::largest_dt).
  explicit Clock(const ClockConfig& config, double largest_dt = std::numeric_limits<double>::infinity());

  bool adaptive() const { return config_.tolerance > 0; }
  /// Adaptive and explicit steps end exactly at these times, besides the end of the run.
  void land_on(const std::vector<double>& times);

  bool done() const;
  double time() const { return time_; }
  double dt() const;  ///< next step to try; lands on the end exactly
  int steps() const { return steps_; }
  int cuts() const { return cuts_; }          ///< in the whole run
  int rejected() const { return rejected_; }  ///< steps whose error was too large, the same
  double fraction() const;                    ///< of the simulated time that is done

  /// Is the error of a step that succeeded too large? If so the next dt() is shorter.
  bool reject(const Step& step);
  void accept(const Step& step, double largest_dt);
  /// Where it stands. A nominal step that the scene has changed since counts from there on.
  void walk(StateWalk& walk);
  /// Halves the step. Returns false when it may not be cut further: the run ends there.
  bool cut(const Step& step);

 private:
  double target() const;
  bool reaches(double time, double dt) const;
  bool varies() const { return adaptive() || config_.by_stability; }
  double excess(const Step& step) const;
  void grow_back(const Step& step);
  void control(const Step& step, double tried);

  ClockConfig config_;
  double time_ = 0, dt_ = 0;
  double largest_dt_;
  double origin_ = 0, stride_ = 0;  // since the step last changed, time is origin + strides * stride
  long strides_ = 0;
  int steps_ = 0, cuts_ = 0, cuts_in_a_row_ = 0, easy_steps_ = 0, rejected_ = 0;
  std::vector<double> landings_;  // increasing
  double last_excess_ = 1;        // of the last accepted step
  bool failed_ = false;           // the step before was cut or rejected
};

}  // namespace titin
