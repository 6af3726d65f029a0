#include "io/run_summary.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/version.hpp"

namespace titin {

void RunSummary::walk(StateWalk& walk) {
  std::vector<double> counts(newton.per_step.begin(), newton.per_step.end());
  walk.common("summary_newton_per_step", counts);
  newton.per_step.assign(counts.begin(), counts.end());
  walk.common("summary_last_residuals", newton.last_residuals);
  walk.number("summary_newton_failed", newton.failed);
  walk.number("summary_newton_rejected", newton.rejected);
  walk.number("summary_krylov", krylov);
}

std::string RunSummary::json() const {
  using Json = nlohmann::ordered_json;
  const auto& counts = newton.per_step;
  const long accepted = std::accumulate(counts.begin(), counts.end(), 0L);
  Json timer_table = Json::object();
  for (const auto& [name, t] : timers) timer_table[name] = {{"cpu", t.cpu}, {"wall", t.wall}, {"calls", t.calls}};
  const Json newton_table = {
      {"total", accepted + newton.failed + newton.rejected},
      {"max_per_step", counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end())},
      {"mean_per_step", counts.empty() ? 0.0 : static_cast<double>(accepted) / static_cast<double>(counts.size())},
      {"per_step", counts},
      {"failed", newton.failed},
      {"rejected", newton.rejected},
      {"cuts", newton.cuts},
      {"last_residuals", newton.last_residuals},
  };
  const Json all = {
      {"status", status},
      {"reason", reason},
      {"title", title},
      {"scene", scene},
      {"model", model},
      {"version", version()},
      {"commit", commit()},
      {"libraries", libraries},
      {"ranks", ranks},
      {"cells", cells},
      {"unknowns", unknowns},
      {"restarted_at_step", restarted_at < 0 ? Json(nullptr) : Json(restarted_at)},
      {"steps", steps},
      {"rejected", rejected},
      {"time", time},
      {"newton", newton_table},
      {"krylov", {{"total", krylov}}},
      {"cpu_seconds", cpu_seconds},
      {"wall_seconds", wall_seconds},
      {"stepping_seconds", stepping_seconds},
      {"peak_rss_bytes", peak_rss_bytes},
      {"timers", timer_table},
      {"speed", speed},
      {"warnings", warnings},
      {"unused_options", unused_options},
      {"errors", errors},
      {"conservation", conservation},
  };
  // A file name need not be UTF-8; JSON must be.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace titin
