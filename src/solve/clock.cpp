#include "solve/clock.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

/// Steps between two times that differ by less than this part of a step are round-off, not steps.
constexpr double sliver = 1e-8;
/// A step that Newton's method solved in so few iterations could have been longer.
constexpr int easy_iterations = 8;
constexpr int easy_steps_to_grow = 3;
/// Below this part of the nominal step, cutting further only delays the answer.
constexpr double smallest_part = 1e-9;
/// Of the controller, as usual (Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2).
constexpr double safety = 0.9, integral = 0.7, proportional = 0.4, least_change = 0.2, largest_change = 5;
/// An error of nothing tells no step size: a step this much too accurate grows as fast as any.
constexpr double least_excess = 1e-10;

}  // namespace

void ClockConfig::bind(Section& s) {
  s.read("end", end, {.unit = "s", .range = positive, .required = true, .doc = "end of the simulated time"});
  if (by_stability) step = end;
  s.read(
      "step", step,
      {.unit = "s",
       .range = positive,
       .required = !by_stability,
       .doc = "nominal time step; the first one of adaptive steps; the longest of explicit ones (default: the end)"});
  s.read("max_cuts", max_cuts,
         {.range = {.min = 0, .max = 60}, .doc = "how often in a row a step that fails is halved before the run ends"});
  if (by_stability) return;
  s.read("tolerance", tolerance,
         {.range = {.min = 0, .max = 1},
          .doc = "of adaptive steps: error of the displacement over its size, to which the error of the run is "
                 "proportional; 0 keeps the step"});
  s.read("largest_step", largest_step, {.unit = "s", .range = non_negative, .doc = "of adaptive steps; 0: no limit"});
  if (tolerance == 0 && s.has("largest_step"))
    s.error("largest_step", "limits adaptive steps, and this run keeps its step", "give time.tolerance, such as 1e-3");
}

Clock::Clock(const ClockConfig& config, double largest_dt)
    : config_(config), dt_(std::min(config.step, config.end)), largest_dt_(largest_dt) {}

void Clock::land_on(const std::vector<double>& times) {
  landings_.insert(landings_.end(), times.begin(), times.end());
  std::sort(landings_.begin(), landings_.end());
}

bool Clock::done() const { return time_ >= config_.end; }

/// The next time that a step must not pass.
double Clock::target() const {
  if (!varies()) return config_.end;
  const auto next = std::upper_bound(landings_.begin(), landings_.end(), time_ + sliver * config_.step);
  return next == landings_.end() ? config_.end : std::min(*next, config_.end);
}

bool Clock::reaches(double time, double dt) const { return time - time_ <= dt * (1 + sliver); }

double Clock::dt() const {
  const double dt = std::min(dt_, largest_dt_), remaining = target() - time_;
  const bool same = std::abs(remaining - dt) <= sliver * dt;
  if (reaches(target(), dt)) return same && !varies() ? dt : remaining;
  return varies() && reaches(target(), 2 * dt) ? remaining / 2 : dt;  // two equal steps, not one and a rest
}

double Clock::fraction() const { return time_ / config_.end; }

double Clock::excess(const Step& step) const {
  const double order = step.order;
  return step.error / std::pow(config_.tolerance, (order + 1) / order);
}

bool Clock::reject(const Step& step) {
  if (!adaptive() || excess(step) <= 1) return false;
  const double tried = dt(), change = safety * std::pow(excess(step), -1.0 / (step.order + 1));
  if (tried * change < smallest_part * config_.step) return false;  // no step is short enough: go on with this one
  dt_ = tried * std::max(change, least_change);
  failed_ = true;
  ++rejected_;
  return true;
}

void Clock::accept(const Step& step, double largest_dt) {
  const double dt = this->dt(), target = this->target();
  if (dt != stride_) {
    origin_ = time_;
    stride_ = dt;
    strides_ = 0;
  }
  ++strides_;
  // Not a running sum: equal steps do not gather round-off.
  time_ = reaches(target, dt) ? target : origin_ + static_cast<double>(strides_) * stride_;
  if (time_ == target) stride_ = 0;
  ++steps_;
  cuts_in_a_row_ = 0;
  if (adaptive())
    control(step, dt);
  else
    grow_back(step);
  largest_dt_ = largest_dt;
}

void Clock::grow_back(const Step& step) {
  easy_steps_ = step.newton <= easy_iterations ? easy_steps_ + 1 : 0;
  if (easy_steps_ < easy_steps_to_grow || dt_ >= config_.step) return;
  dt_ = std::min(2 * dt_, config_.step);
  easy_steps_ = 0;
}

/// The next step after one of length `tried`, which may have been shorter than dt_ to land on a time.
void Clock::control(const Step& step, double tried) {
  const double e = std::max(excess(step), least_excess), power = 1.0 / (step.order + 1);
  double change = safety * std::pow(e, -integral * power) * std::pow(last_excess_, proportional * power);
  change = std::clamp(change, least_change, largest_change);
  if (failed_ || step.newton > easy_iterations) change = std::min(change, 1.0);
  const double next = tried * change;
  dt_ = tried < dt_ && !failed_ && e <= 1 ? std::max(next, dt_) : next;
  if (config_.largest_step > 0) dt_ = std::min(dt_, config_.largest_step);
  last_excess_ = e;
  failed_ = false;
}

void Clock::walk(StateWalk& walk) {
  double nominal = config_.step;
  walk.number("clock_nominal_step", nominal);
  walk.number("clock_time", time_);
  walk.number("clock_dt", dt_);
  walk.number("clock_largest_dt", largest_dt_);
  walk.number("clock_origin", origin_);
  walk.number("clock_stride", stride_);
  walk.number("clock_strides", strides_);
  walk.number("clock_steps", steps_);
  walk.number("clock_cuts", cuts_);
  walk.number("clock_cuts_in_a_row", cuts_in_a_row_);
  walk.number("clock_easy_steps", easy_steps_);
  walk.number("clock_rejected", rejected_);
  walk.number("clock_last_excess", last_excess_);
  walk.number("clock_failed", failed_);
  if (nominal != config_.step && !config_.by_stability) dt_ = config_.step;
}

bool Clock::cut(const Step&) {
  const double half = dt() / 2;
  if (cuts_in_a_row_ >= config_.max_cuts || half < smallest_part * std::min(config_.step, largest_dt_)) return false;
  dt_ = half;
  ++cuts_in_a_row_;
  ++cuts_;
  easy_steps_ = 0;
  failed_ = true;
  return true;
}

}  // namespace titin
