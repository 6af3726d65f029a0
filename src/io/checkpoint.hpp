/// Checkpoints: the state of a run in one HDF5 file, written by all ranks together, from which it goes on.
///
///   (head)                          io/checkpoint_head.hpp, in HDF5's user block
///   /common/NAME        [n]         numbers that all ranks have
///   /parts/NAME         [ranks][n]  each rank's parts of sums
///   /KIND/number        [rows]      of the cells or nodes, one rank's after the other's; /KIND/first [ranks] where
///   /KIND/NAME          [numbers]   their values, in that order; /KIND/NAME/... sizes and firsts where rows differ
///
/// and with each a check sum. A file is written beside its place, put on disk, and then renamed: whenever a run is
/// killed, the last checkpoint is whole. On as many ranks as wrote it everything is read back by the bit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/checkpoint_head.hpp"
#include "solve/state_walk.hpp"

namespace titin {

/// A checkpoint to restart from.
struct FoundCheckpoint {
  std::string path;
  CheckpointHead head;
  std::string problem;  ///< "" or what is wrong and what to do
};
/// The newest checkpoint of a run's folder, or the file `path` itself. Collective.
FoundCheckpoint find_checkpoint(const std::string& path);

/// Reads the state in a checkpoint's file: walk(reader). Collective. Throws std::runtime_error on a file that does not
/// hold what is asked for.
void read_checkpoint(const std::string& file, const std::function<void(StateWalk&)>& walk);

/// Those of one run.
class Checkpoints {
 public:
  /// In RUN/checkpoints; all but the newest `keep` are removed.
  Checkpoints(const std::string& run_folder, int keep) : folder_(run_folder + "/checkpoints"), keep_(keep) {}

  /// Collective. Throws OutputError, and then has left the older ones as they are.
  void write(const CheckpointHead& head, const std::function<void(StateWalk&)>& walk);
  /// Removes those after this step, of a future that is not to be. Collective.
  void forget_after(long step);

 private:
  std::string folder_;
  int keep_;
};

}  // namespace titin
