#include "scene/run_report.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "solve/model.hpp"
#include "solve/petsc.hpp"

namespace titin {

std::map<std::string, std::string> library_versions() {
  return {{"mfem", MFEM_VERSION_STRING},
          {"petsc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
          {"hypre", HYPRE_RELEASE_VERSION},
          {"mpi", mpi_version()}};
}

void add_costs(RunSummary& summary) {
  summary.cpu_seconds = sum(cpu_seconds());
  summary.wall_seconds = max(wall_seconds());
  summary.peak_rss_bytes = sum(static_cast<double>(peak_rss_bytes()));
  summary.warnings = logging::warnings();
  std::string names;
  for (const auto& [name, phase] : Timers::phases()) names += name + '\n';
  std::istringstream lines(broadcast(names));  // rank 0's, so that all ranks reduce the same
  for (std::string name; std::getline(lines, name);) {
    const auto it = Timers::phases().find(name);
    const Timers::Phase phase = it == Timers::phases().end() ? Timers::Phase{} : it->second;
    summary.timers[name] = {sum(phase.cpu), max(phase.wall), phase.calls};
  }
}

void add_step(RunSummary& summary, const Step& step) {
  summary.newton.per_step.push_back(step.newton);
  summary.newton.last_residuals = step.residuals;
}

void log_timers(const RunSummary& summary) {
  std::vector<std::pair<std::string, RunSummary::Timer>> phases(summary.timers.begin(), summary.timers.end());
  std::sort(phases.begin(), phases.end(), [](const auto& a, const auto& b) { return a.second.wall > b.second.wall; });
  logging::detail("{:<24}  {:>10}  {:>10}  {:>9}", "phase", "wall [s]", "cpu [s]", "calls");
  for (const auto& [name, t] : phases)
    logging::detail("{:<24}  {:>10.3f}  {:>10.3f}  {:>9}", name, t.wall, t.cpu, t.calls);
}

void log_explicit_speed(const RunSummary& summary) {
  double cpu = 0;
  for (const char* phase : {"step", "accept"})
    if (const auto found = summary.timers.find(phase); found != summary.timers.end()) cpu += found->second.cpu;
  if (cpu > 0)
    logging::info("{:.3g} cell-steps per CPU-second", static_cast<double>(summary.cells) * summary.steps / cpu);
}

}  // namespace titin
