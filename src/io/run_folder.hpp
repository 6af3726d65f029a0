/// The folder of a run: resolved.toml, run.log, run.json, run.lock, history.csv, history.h5, fields/ (ParaView),
/// checkpoints/. What a user put there is never removed; no other run writes there as long as this object lives.
#pragma once

#include <string>

#include "io/folder_lock.hpp"

namespace titin {

class RunFolder {
 public:
  /// Why a run may not write to `path`, and what to do; "" when it may. Touches nothing. Collective.
  static std::string problem(const std::string& path, bool overwrite);
  /// Makes the folder, or empties it of an earlier run's files. Collective. Throws InputError when `problem` is one.
  RunFolder(const std::string& path, bool overwrite);
  /// The folder of an earlier run that goes on: nothing of it is removed. Collective. Throws InputError.
  static RunFolder of_restart(const std::string& path);

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a text file as a whole: a reader sees the old or the new one, never half of it. Rank 0 writes.
  void write(const std::string& name, const std::string& text) const;

 private:
  explicit RunFolder(const std::string& path) : path_(path) {}
  void make(bool keep);
  std::string path_;
  FolderLock lock_;  // rank 0's
};

}  // namespace titin
