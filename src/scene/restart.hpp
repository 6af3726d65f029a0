/// From a checkpoint to the scene that it is of, and whether that is the scene that the user asks for.
#pragma once

#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "scene/scene.hpp"

namespace titin {

/// The folder of the run that a checkpoint is of; `path` is that folder, or a file in its checkpoints/.
std::string folder_of_restart(const std::string& path);

/// What speaks against going on from `head` with this scene, one message each. What only says how long, how fast or
/// what else is written may differ.
std::vector<std::string> restart_problems(const std::string& path, const CheckpointHead& head, const Scene& scene);

}  // namespace titin
