#include "scene/progress.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "base/timers.hpp"

namespace titin {
namespace {

std::string heading(const Quantity& q) { return q.unit.empty() ? q.name : fmt::format("{} [{}]", q.name, q.unit); }

constexpr int least_width = 12;  // holds a number of six digits with sign and exponent

}  // namespace

std::string duration(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5970) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

Progress::Progress(const Quantity& shown, bool is_explicit, double done)
    : start_(wall_seconds()),
      done_at_start_(done),
      width_(std::max(least_width, static_cast<int>(heading(shown).size()))),
      is_explicit_(is_explicit) {
  const std::string iterations =
      is_explicit ? "" : fmt::format("  {:>6}  {:>6}  {:>8}", "newton", "krylov", "residual");
  logging::info("{:>6}  {:>10}  {:>10}{}  {:>{}}  {:>5}  {:>7}", "step", "time [s]", "dt [s]", iterations,
                heading(shown), width_, "done", "left");
}

void Progress::line(const Clock& clock, const Step& step, const Quantity& shown) {
  const int percent = static_cast<int>(100 * clock.fraction());
  if (is_explicit_ && percent == percent_) return;
  percent_ = percent;
  const std::string iterations =
      is_explicit_ ? "" : fmt::format("  {:>6}  {:>6}  {:>8.1e}", step.newton, step.krylov, step.residual);
  const double done = clock.fraction(), left = (wall_seconds() - start_) * (1 - done) / (done - done_at_start_);
  logging::info("{:>6}  {:>10.6g}  {:>10.4g}{}  {:>{}.6g}  {:>3.0f} %  {:>7}", clock.steps(), clock.time(), step.dt,
                iterations, shown.value, width_, 100 * done, duration(left));
}

}  // namespace titin
