/// What a run begins with: the scene and, of one that goes on, the checkpoint.
#pragma once

#include "scene/advise.hpp"
#include "scene/restart.hpp"
#include "scene/run.hpp"
#include "scene/scene.hpp"

namespace titin {

struct Start {
  Scene scene;
  std::vector<std::string> choice;  // overrides that fidelity = "auto" came to, now or before the restart
  Proposal advice;                  // of a run that has just chosen
  FoundCheckpoint checkpoint;       // of a restart
  /// What was chosen, in a line; "" of a scene that is run as it is written.
  std::string chosen() const;
};

/// Collective. Throws InputError with all that is wrong: with the scene, the folder and the checkpoint.
Start read_start(const RunOptions& options);

/// Where the run writes.
std::string folder_of(const RunOptions& options);

}  // namespace titin
