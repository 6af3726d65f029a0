/// From a scene file to a finished run folder.
#pragma once

#include <string>
#include <vector>

namespace titin {

/// How a run ended: also the exit code of the program (1: input error, 4: internal error).
enum class Outcome { finished = 0, not_converged = 2, stopped = 3 };

struct RunOptions {
  std::string scene_file;  ///< of a restart may be "": the scene of the checkpoint
  std::vector<std::string> overrides;
  std::string folder;  ///< "": results/<name of the scene file>
  bool overwrite = false;
  std::string restart;  ///< folder of a run, or one of its checkpoints, to go on from; "": begin
};

/// Collective. Throws InputError, and then has touched nothing.
Outcome run(const RunOptions& options);
/// Reads the scene as a run would, and says what it would be. Collective. Throws InputError.
void check_scene(const RunOptions& options);

}  // namespace titin
