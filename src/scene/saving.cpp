#include "scene/saving.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {
namespace {

constexpr double reserve = 0.01;  // of the limit: for what comes after the last step

}  // namespace

void SavingConfig::bind(Section& s) {
  s.read("checkpoint_every", every,
         {.range = {.min = 0},
          .doc = "steps between two checkpoints, which are also the times to which a restarted run is the same by the "
                 "bit; 0: none by steps"});
  s.read("checkpoint_interval", interval,
         {.unit = "s", .range = positive, .doc = "real time after which a checkpoint is written in any case"});
  s.read("checkpoint_keep", keep, {.range = {.min = 1, .max = 1000}, .doc = "how many checkpoints are kept"});
  s.read("wall_limit", limit,
         {.unit = "s",
          .range = non_negative,
          .doc = "real time that the run may take: it ends before, with a checkpoint (exit code 3); 0: no limit"});
}

bool Saving::due_by_steps(const Clock& clock) const {
  return config_.every > 0 && (clock.steps() % config_.every == 0 || clock.done()) && clock.steps() != last_step_;
}

bool Saving::due_by_time() const { return any_of(is_root() && wall_seconds() - last_save_ > config_.interval); }

bool Saving::out_of_time() const {
  if (config_.limit == 0) return false;
  const double needed = longest_step_ + longest_save_ + reserve * config_.limit;
  return any_of(is_root() && wall_seconds() + needed > config_.limit);
}

void Saving::stepped() {
  const double now = wall_seconds();
  if (last_step_end_ > 0) longest_step_ = std::max(longest_step_, now - last_step_end_);
  last_step_end_ = now;
}

void Saving::saved(long step, double took) {
  last_step_ = step;
  last_save_ = last_step_end_ = wall_seconds();
  longest_save_ = std::max(longest_save_, took);
}

}  // namespace titin
