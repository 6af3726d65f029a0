/// run.json: what a run was, how it ended and what it cost.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "solve/state_walk.hpp"

namespace titin {

struct RunSummary {
  std::string status = "running";  ///< running, finished, not_converged, stopped or failed
  std::string reason;              ///< why it is not finished, in words
  std::string title, scene, model;
  std::map<std::string, std::string> libraries;  ///< name -> version
  int ranks = 1;
  long cells = 0, unknowns = 0;

  long restarted_at = -1;       ///< step of the checkpoint that this run went on from; -1: from the beginning
  int steps = 0, rejected = 0;  ///< accepted; tried with success, but with too large an error
  double time = 0;              ///< [s] reached
  struct {
    std::vector<int> per_step;           ///< of accepted steps
    int failed = 0;                      ///< iterations in steps that failed
    int rejected = 0;                    ///< iterations in steps whose error was too large
    int cuts = 0;                        ///< how often a step was halved
    std::vector<double> last_residuals;  ///< of the last accepted step: shows the order of convergence
  } newton;
  long krylov = 0;

  double cpu_seconds = 0;       ///< of all ranks
  double wall_seconds = 0;      ///< since the program started
  double stepping_seconds = 0;  ///< wall time of the run loop, output included
  double peak_rss_bytes = 0;    ///< of all ranks
  struct Timer {
    double cpu = 0, wall = 0;  ///< [s] of all ranks; of the slowest rank
    long calls = 0;
  };
  std::map<std::string, Timer> timers;
  /// Of explicit formulations: cell-steps per CPU-second, what memory allows of them, and what that follows from.
  std::map<std::string, double> speed;
  int warnings = 0;
  std::vector<std::string> unused_options;     ///< of PETSc that the scene gives and no solver asked for
  std::map<std::string, double> errors;        ///< norms by name, where a reference is known
  std::map<std::string, double> conservation;  ///< what should stay zero

  std::string json() const;
  /// What a restarted run counts on from.
  void walk(StateWalk& walk);
};

}  // namespace titin
