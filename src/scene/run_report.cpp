#include "scene/run_report.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "base/bandwidth.hpp"
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

void add_explicit_speed(RunSummary& summary, const Model& model) {
  double cpu = 0;
  for (const char* phase : {"step", "accept"})
    if (const auto found = summary.timers.find(phase); found != summary.timers.end()) cpu += found->second.cpu;
  const double bytes = model.bytes_per_step() / static_cast<double>(summary.cells);
  const double bandwidth = sum(triad_bandwidth()) / ranks();
  if (!(cpu > 0 && bytes > 0)) return;
  summary.speed = {{"cell_steps_per_cpu_second", static_cast<double>(summary.cells) * summary.steps / cpu},
                   {"bytes_per_cell_step", bytes},
                   {"triad_bytes_per_cpu_second", bandwidth},
                   {"memory_bound", bandwidth / bytes}};
}

void log_explicit_speed(const RunSummary& summary) {
  if (summary.speed.empty()) return;
  const auto& of = summary.speed;
  logging::info(
      "{:.3g} cell-steps per CPU-second; memory allows {:.3g}: {:.0f} bytes a cell and step, {:.3g} GB/s (triad)",
      of.at("cell_steps_per_cpu_second"), of.at("memory_bound"), of.at("bytes_per_cell_step"),
      1e-9 * of.at("triad_bytes_per_cpu_second"));
}

}  // namespace titin
