#include "scene/restart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

namespace titin {
namespace {

/// Tables and keys that may change between a run and its restart.
constexpr std::array may_change = {
    "title =",    "fidelity",    "output.",         "solver.",          "petsc.",
    "time.end =", "time.step =", "time.max_cuts =", "time.tolerance =", "time.largest_step ="};
constexpr std::size_t most_named = 8;

std::set<std::string> that_matter(const std::vector<std::string>& settings) {
  std::set<std::string> left;
  for (const std::string& setting : settings)
    if (std::none_of(may_change.begin(), may_change.end(), [&](const char* free) { return setting.starts_with(free); }))
      left.insert(setting);
  return left;
}

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find(" = ")); }

/// Keys that only one of the two has, or that have other values.
std::vector<std::string> different_keys(const CheckpointHead& head, const Scene& scene) {
  const auto old = that_matter(head.settings), now = that_matter(scene.settings);
  std::set<std::string> keys;
  for (const std::string& setting : old)
    if (!now.count(setting)) keys.insert(key_of(setting));
  for (const std::string& setting : now)
    if (!old.count(setting)) keys.insert(key_of(setting));
  return {keys.begin(), keys.end()};
}

}  // namespace

std::string folder_of_restart(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path given(path);
  if (!fs::is_regular_file(given)) return path;
  const fs::path folder = given.parent_path().parent_path();
  return folder.empty() ? (given.parent_path().empty() ? ".." : ".") : folder.string();
}

std::vector<std::string> restart_problems(const std::string& path, const CheckpointHead& head, const Scene& scene) {
  std::vector<std::string> problems;
  std::vector<std::string> keys = different_keys(head, scene);
  if (!keys.empty()) {
    const std::size_t more = keys.size() - std::min(keys.size(), most_named);
    keys.resize(keys.size() - more);
    problems.push_back(
        fmt::format("restart {}: the checkpoint is of another scene: {}{} differ; leave them as they were, or begin a "
                    "new run",
                    path, fmt::join(keys, ", "), more > 0 ? fmt::format(" and {} more", more) : ""));
  } else if (head.mesh != scene.mesh_identity) {
    problems.push_back(
        fmt::format("restart {}: the checkpoint is of another mesh; use the one it was written with", path));
  }
  if (scene.clock.end < head.time)
    problems.push_back(
        fmt::format("restart {}: the checkpoint is at {:g} s and time.end at {:g} s; name an earlier "
                    "checkpoint, or a later end",
                    path, head.time, scene.clock.end));
  return problems;
}

}  // namespace titin
