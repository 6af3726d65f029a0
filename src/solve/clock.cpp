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

}  // namespace

void ClockConfig::bind(Section& s) {
  s.read("end", end, {.unit = "s", .range = positive, .required = true, .doc = "end of the simulated time"});
  s.read("step", step, {.unit = "s", .range = positive, .required = true, .doc = "nominal time step"});
  s.read("max_cuts", max_cuts,
         {.range = {.min = 0, .max = 60}, .doc = "how often in a row a step that fails is halved before the run ends"});
}

Clock::Clock(const ClockConfig& config, double largest_dt)
    : config_(config), dt_(std::min(config.step, config.end)), largest_dt_(largest_dt) {}

bool Clock::done() const { return time_ >= config_.end; }

bool Clock::reaches_end(double dt) const { return config_.end - time_ <= dt * (1 + sliver); }

double Clock::dt() const {
  const double dt = std::min(dt_, largest_dt_), remaining = config_.end - time_;
  const bool same = std::abs(remaining - dt) <= sliver * dt;
  return reaches_end(dt) && !same ? remaining : dt;
}

double Clock::fraction() const { return time_ / config_.end; }

void Clock::accept(const Step& step, double largest_dt) {
  const double dt = this->dt();
  if (dt != stride_) {
    origin_ = time_;
    stride_ = dt;
    strides_ = 0;
  }
  ++strides_;
  // Not a running sum: equal steps do not gather round-off.
  time_ = reaches_end(dt) ? config_.end : origin_ + static_cast<double>(strides_) * stride_;
  ++steps_;
  cuts_in_a_row_ = 0;
  easy_steps_ = step.newton <= easy_iterations ? easy_steps_ + 1 : 0;
  if (easy_steps_ >= easy_steps_to_grow && dt_ < config_.step) {
    dt_ = std::min(2 * dt_, config_.step);
    easy_steps_ = 0;
  }
  largest_dt_ = largest_dt;
}

bool Clock::cut(const Step&) {
  const double half = dt() / 2;
  if (cuts_in_a_row_ >= config_.max_cuts || half < smallest_part * config_.step) return false;
  dt_ = half;
  ++cuts_in_a_row_;
  ++cuts_;
  easy_steps_ = 0;
  return true;
}

}  // namespace titin
