#include "io/run_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <vector>

#include "base/config.hpp"
#include "base/parallel.hpp"
#include "io/output_error.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

/// Files that a run writes, as paths inside its folder.
const std::regex& ours() {
  static const std::regex names(
      R"((resolved\.toml|run\.log|run\.json|history\.csv|history\.h5)(\.part)?|fields/fields\.pvd(\.part)?|)"
      R"(fields/Cycle\d+/(data\.pvtu|proc\d+\.vtu)|fields/fields(_\d+)?\.vtkhdf|fields/fields\.vtkhdf\.series(\.part)?|)"
      R"(checkpoints/step_\d+\.h5(\.part)?)");
  return names;
}

bool is_run(const fs::path& folder) {
  return fs::is_regular_file(folder / "run.json") && fs::is_regular_file(folder / "resolved.toml");
}

/// Empty, or but for the lock of a run that was killed before it wrote anything.
bool is_unused(const fs::path& folder, std::error_code& error) {
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().filename() != lock_file) return false;
  return true;
}

std::string problem_here(const fs::path& folder, bool overwrite) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return "";
  if (!fs::is_directory(status)) return "is a file; name a folder with -o";
  const bool empty = is_unused(folder, error);
  if (error) return "cannot be read; name another folder with -o";
  if (const std::string problem = FolderLock::problem_in(folder.string()); !problem.empty()) return problem;
  if (empty) return "";
  if (!is_run(folder)) return "is not empty, and no run of Titin wrote it; name another folder with -o";
  return overwrite ? "" : "holds an earlier run; replace it with --overwrite, or name another folder with -o";
}

/// Removes an earlier run. Links are not followed.
void clear(const fs::path& folder) {
  std::vector<fs::path> files, folders;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink())
      folders.push_back(entry.path());
    else if (std::regex_match(entry.path().lexically_relative(folder).generic_string(), ours()))
      files.push_back(entry.path());
  }
  for (const auto& file : files) fs::remove(file);
  // The innermost first; only those in which nothing of the user's is left.
  for (auto it = folders.rbegin(); it != folders.rend(); ++it)
    if (fs::is_empty(*it)) fs::remove(*it);
}

/// Makes the folder and locks it; only then an earlier run is removed.
std::string take(const fs::path& folder, bool keep, FolderLock& lock) {
  try {
    fs::create_directories(folder);
    lock = FolderLock(folder.string());
    if (!lock.problem().empty()) return lock.problem();
    if (!keep) clear(folder);
    const fs::path probe = folder / "run.json.part";
    const bool writable = static_cast<bool>(std::ofstream(probe) << '\n' << std::flush);
    fs::remove(probe);
    return writable ? "" : "cannot be written to; name another folder with -o";
  } catch (const fs::filesystem_error& error) {
    return fmt::format("cannot be made ({}); name another folder with -o", error.code().message());
  }
}

void stop_at(const std::string& path, const std::string& problem) {
  if (!problem.empty()) throw InputError({fmt::format("output folder {}: {}", path, problem)});
}

}  // namespace

std::string RunFolder::problem(const std::string& path, bool overwrite) {
  const std::string problem = broadcast(is_root() ? problem_here(path, overwrite) : "");
  return problem.empty() ? "" : fmt::format("output folder {}: {}", path, problem);
}

RunFolder::RunFolder(const std::string& path, bool overwrite) : path_(path) {
  stop_at(path, broadcast(is_root() ? problem_here(path, overwrite) : ""));
  make(false);
}

RunFolder RunFolder::of_restart(const std::string& path) {
  stop_at(path, broadcast(is_root() && !is_run(path) ? "holds no run of Titin that could go on" : ""));
  RunFolder folder(path);
  folder.make(true);
  return folder;
}

void RunFolder::make(bool keep) { stop_at(path_, broadcast(is_root() ? take(path_, keep, lock_) : "")); }

void RunFolder::write(const std::string& name, const std::string& text) const {
  if (!is_root()) return;
  const std::string part = file(name + ".part");
  const bool written = static_cast<bool>(std::ofstream(part, std::ios::binary) << text << std::flush);
  std::error_code error;
  if (written) fs::rename(part, file(name), error);
  if (!written || error) throw OutputError(file(name));
}

}  // namespace titin
