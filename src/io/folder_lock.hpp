/// One run at a time in a folder: a lock on its file run.lock, which the system takes back when the run ends in any
/// way. Where files cannot be locked (some file systems of clusters) nothing is refused.
#pragma once

#include <string>

namespace titin {

inline constexpr const char* lock_file = "run.lock";

/// Held as long as it lives; what concerns one rank is done by rank 0 alone.
class FolderLock {
 public:
  FolderLock() = default;
  /// Takes the lock of a folder that is there. Not collective; `problem` says who has it already.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  const std::string& problem() const { return problem_; }
  /// Why the lock could not be taken now, "" when it could. Makes no file.
  static std::string problem_in(const std::string& folder);

 private:
  FolderLock(const std::string& folder, bool make);
  int file_ = -1;
  std::string problem_;
};

}  // namespace titin
