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

Progress::Progress(const Quantity& shown)
    : start_(wall_seconds()), width_(std::max(least_width, static_cast<int>(heading(shown).size()))) {
  logging::info("{:>6}  {:>10}  {:>10}  {:>6}  {:>6}  {:>8}  {:>{}}  {:>5}  {:>7}", "step", "time [s]", "dt [s]",
                "newton", "krylov", "residual", heading(shown), width_, "done", "left");
}

void Progress::line(const Clock& clock, const Step& step, const Quantity& shown) const {
  const double done = clock.fraction(), left = (wall_seconds() - start_) * (1 - done) / done;
  logging::info("{:>6}  {:>10.6g}  {:>10.4g}  {:>6}  {:>6}  {:>8.1e}  {:>{}.6g}  {:>3.0f} %  {:>7}", clock.steps(),
                clock.time(), step.dt, step.newton, step.krylov, step.residual, shown.value, width_, 100 * done,
                duration(left));
}

}  // namespace titin
