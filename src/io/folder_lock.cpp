#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "base/words.hpp"

namespace titin {
namespace {

constexpr std::size_t longest_name = 200;  // of what a lock file says of its owner, in bytes

std::string owner() {
  std::array<char, longest_name> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}", getpid(), host.data());
}

std::string text_in(int file) {
  std::array<char, 2 * longest_name> text{};
  const ssize_t size = pread(file, text.data(), text.size(), 0);
  return printable(std::string(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0));
}

/// For people only: that it could not be written is no fault.
void sign(int file) {
  const std::string text = owner();
  if (ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) : FolderLock(folder, true) {}

FolderLock::FolderLock(const std::string& folder, bool make)
    : file_(open((folder + "/" + lock_file).c_str(), O_RDWR | O_CLOEXEC | (make ? O_CREAT : 0), 0666)) {
  if (file_ < 0) return;
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    problem_ =
        fmt::format("another run is writing to it ({}); wait for its end, or take another folder", text_in(file_));
  else if (make)
    sign(file_);
}

std::string FolderLock::problem_in(const std::string& folder) { return FolderLock(folder, false).problem_; }

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), problem_(std::move(other.problem_)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(problem_, other.problem_);
  return *this;
}

}  // namespace titin
