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
      R"((resolved\.toml|run\.log|run\.json|history\.csv)(\.part)?|fields/fields\.pvd(\.part)?|)"
      R"(fields/Cycle\d+/(data\.pvtu|proc\d+\.vtu)|fields/fields(_\d+)?\.vtkhdf|fields/fields\.vtkhdf\.series(\.part)?|)"
      R"(checkpoints/step_\d+\.h5(\.part)?)");
  return names;
}

bool is_run(const fs::path& folder) {
  return fs::is_regular_file(folder / "run.json") && fs::is_regular_file(folder / "resolved.toml");
}

std::string problem_here(const fs::path& folder, bool overwrite) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return "";
  if (!fs::is_directory(status)) return "is a file; name a folder with -o";
  const bool empty = fs::is_empty(folder, error);
  if (error) return "cannot be read; name another folder with -o";
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

std::string make(const fs::path& folder, bool keep) {
  try {
    if (fs::exists(folder) && !keep) clear(folder);
    fs::create_directories(folder);
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
  stop_at(path, broadcast(is_root() ? make(path, false) : ""));
}

RunFolder RunFolder::of_restart(const std::string& path) {
  stop_at(path, broadcast(is_root() && !is_run(path) ? "holds no run of Titin that could go on" : ""));
  stop_at(path, broadcast(is_root() ? make(path, true) : ""));
  return RunFolder(path);
}

void RunFolder::write(const std::string& name, const std::string& text) const {
  if (!is_root()) return;
  const std::string part = file(name + ".part");
  const bool written = static_cast<bool>(std::ofstream(part, std::ios::binary) << text << std::flush);
  std::error_code error;
  if (written) fs::rename(part, file(name), error);
  if (!written || error) throw OutputError(file(name));
}

}  // namespace titin
