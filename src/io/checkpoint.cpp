#include "io/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "base/parallel.hpp"
#include "io/checkpoint_walks.hpp"
#include "io/output_error.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t least_head = 512;  // HDF5's smallest user block
constexpr std::string_view prefix = "step_", suffix = ".h5";

std::string name_of(long step) { return fmt::format("{}{:010}{}", prefix, step, suffix); }

/// The step of a checkpoint's name, or -1.
long step_of(const fs::path& file) {
  const std::string name = file.filename().string();
  long step = -1;
  if (name.size() != name_of(0).size() || !name.starts_with(prefix) || !name.ends_with(suffix)) return -1;
  const char *begin = name.data() + prefix.size(), *end = name.data() + name.size() - suffix.size();
  const auto [stopped, error] = std::from_chars(begin, end, step);
  return error == std::errc() && stopped == end ? step : -1;
}

/// Of a folder, oldest first.
std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (step_of(entry.path()) >= 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Waits until what was written to a file, or into a folder, is on disk.
bool sync(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  return (file < 0 || ::close(file) == 0) && synced;
}

ParsedHead read_head_here(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {{}, "is not there"};
  const std::uint64_t size = fs::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  std::string start(first_line, '\0');
  in.read(start.data(), first_line);
  start.resize(in.gcount());
  const std::uint64_t wanted = std::min(wanted_bytes(start), size);
  if (wanted > first_line) {
    start.resize(wanted);
    in.read(start.data() + first_line, static_cast<std::streamsize>(wanted - first_line));
    start.resize(first_line + in.gcount());
  }
  return parse_head(start, size);
}

std::string path_here(const std::string& path) {
  if (!fs::is_directory(path)) return path;
  const auto files = checkpoints_in(fs::path(path) / "checkpoints");
  return files.empty() ? "" : files.back().string();
}

/// Puts the head into the user block of a file that HDF5 has closed.
bool write_head(const std::string& path, const CheckpointHead& head) {
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  return !error && (file << to_bytes(head, size) << std::flush);
}

}  // namespace

FoundCheckpoint find_checkpoint(const std::string& path) {
  FoundCheckpoint found;
  found.path = broadcast(is_root() ? path_here(path) : "");
  if (found.path.empty())
    found.problem = fmt::format(
        "restart {}: this folder has no checkpoints; a run writes them when it is stopped, "
        "and as output.checkpoint_every asks",
        path);
  else if (!broadcast(is_root() && !fs::exists(path) ? "no" : "").empty())
    found.problem = fmt::format("restart {}: is not there; give the folder of a run, or one of its checkpoints", path);
  if (!found.problem.empty()) return found;
  ParsedHead parsed;
  if (is_root()) parsed = read_head_here(found.path);
  parsed.problem = broadcast(parsed.problem);
  if (parsed.problem.empty()) {
    const std::string bytes = broadcast(is_root() ? to_bytes(parsed.head, 0) : "");
    found.head = parse_head(bytes, 0).head;
  } else {
    found.problem =
        fmt::format("restart {}: {}; name an earlier one: --restart RUN/checkpoints/FILE", found.path, parsed.problem);
  }
  return found;
}

void read_checkpoint(const std::string& file, const std::function<void(StateWalk&)>& walk) {
  CheckpointReader reader(file);
  walk(reader);
}

void Checkpoints::write(const CheckpointHead& head, const std::function<void(StateWalk&)>& walk) {
  const std::string file = folder_ + "/" + name_of(head.step), part = file + ".part";
  if (is_root()) {
    std::error_code error;
    fs::create_directories(folder_, error);
  }
  any_of(false);  // waits for it
  bool good = true;
  try {
    CheckpointWriter writer(part, std::bit_ceil(std::max(least_head, size_of(head))));
    walk(writer);
    good = writer.close();
  } catch (const std::runtime_error&) {
    good = false;  // on all ranks
  }
  if (is_root()) good = good && write_head(part, head);
  good = !any_of(!good || !sync(part));  // every node has its own cache of files
  std::error_code error;
  if (good && is_root()) {
    fs::rename(part, file, error);
    good = !error && sync(folder_);
    auto files = checkpoints_in(folder_);
    files.resize(std::max<std::ptrdiff_t>(std::ptrdiff_t(files.size()) - keep_, 0));
    for (const fs::path& old : files) fs::remove(old, error);
  }
  if (!any_of(!good)) return;
  if (is_root()) fs::remove(part, error);
  throw OutputError(file);
}

void Checkpoints::forget_after(long step) {
  if (is_root()) {
    std::error_code error;
    for (const fs::path& file : checkpoints_in(folder_))
      if (step_of(file) > step) fs::remove(file, error);
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder_, error))
      if (entry.path().extension() == ".part" && step_of(entry.path().stem()) >= 0) parts.push_back(entry.path());
    for (const fs::path& part : parts) fs::remove(part, error);
  }
  any_of(false);
}

}  // namespace titin
