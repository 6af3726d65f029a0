/// What a run begins with: the scene and, of one that goes on, the checkpoint.
#pragma once

#include "scene/restart.hpp"
#include "scene/run.hpp"
#include "scene/scene.hpp"

namespace titin {

struct Start {
  Scene scene;
  FoundCheckpoint checkpoint;  // of a restart
};

/// Collective. Throws InputError with all that is wrong: with the scene, the folder and the checkpoint.
Start read_start(const RunOptions& options);

/// Where the run writes.
std::string folder_of(const RunOptions& options);

}  // namespace titin
