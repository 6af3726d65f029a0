#include "io/run_contents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/config.hpp"
#include "base/words.hpp"
#include "io/folder_lock.hpp"

namespace titin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uintmax_t largest_index = 64 << 20;  // [bytes] of run.json and of lists of saved times

std::string text_of(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error || size > largest_index) return "";
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Values of a run.json that may be of another version, or damaged: what is not there is left out.
struct Summary {
  Json json;

  std::string text(const char* key) const {
    const auto it = json.find(key);
    return it != json.end() && it->is_string() ? printable(it->get<std::string>()) : "";
  }
  double number(const char* key, const char* below = nullptr) const {
    auto it = json.find(key);
    if (it == json.end()) return 0;
    const Json value = !below ? *it : it->is_object() && it->contains(below) ? (*it)[below] : Json();
    return value.is_number() ? value.get<double>() : 0;
  }
};

std::string bytes(double size) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; size >= 999.5 && unit < 4; ++unit) size /= 1000;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

/// Regular files at and below a path; links are not followed.
struct Files {
  long number = 0;
  double size = 0;
  std::string text() const { return fmt::format("{}, {}", count(static_cast<double>(number), "file"), bytes(size)); }
};

Files files_below(const fs::path& path) {
  Files files;
  std::error_code error;
  const auto add = [&](const fs::directory_entry& entry) {
    if (entry.is_symlink(error) || !entry.is_regular_file(error)) return;
    ++files.number;
    files.size += static_cast<double>(entry.file_size(error));
  };
  add(fs::directory_entry(path, error));
  if (fs::is_directory(path, error))
    for (fs::recursive_directory_iterator it(path, error), end; !error && it != end; it.increment(error)) add(*it);
  return files;
}

/// A list of saved times: a ParaView collection, or a series of VTKHDF files. (No regular expression: those of the
/// standard library call themselves for each character, and a damaged file may be one long word.)
std::set<double> saved_times(const fs::path& index) {
  const std::string_view before = index.extension() == ".pvd" ? "timestep=\"" : "\"time\"";
  const std::string text = text_of(index);
  std::set<double> times;
  for (auto at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
    at = std::min(text.find_first_not_of(" \t:", at + before.size()), text.size());
    double time = 0;
    const auto [end, status] = std::from_chars(text.data() + at, text.data() + text.size(), time);
    if (status == std::errc() && std::isfinite(time)) times.insert(time);
  }
  return times;
}

std::string span(const std::set<double>& times) {
  if (times.empty()) return "no time saved";
  return fmt::format("{} from {:g} to {:g} s", count(static_cast<double>(times.size()), "time"), *times.begin(),
                     *times.rbegin());
}

void add_summary(RunContents& contents, const Summary& run) {
  const auto add = [&](const char* what, const std::string& text) {
    if (!text.empty()) contents.facts.emplace_back(what, text);
  };
  add("title", run.text("title"));
  const std::string reason = run.text("reason");
  add("status", run.text("status") + (reason.empty() ? "" : ": " + reason));
  add("scene", fmt::format("{} ({})", run.text("scene"), run.text("model")));
  add("program",
      fmt::format("Titin {} ({}) on {}", run.text("version"), run.text("commit"), count(run.number("ranks"), "rank")));
  add("size", fmt::format("{}, {}", count(run.number("cells"), "cell"), count(run.number("unknowns"), "unknown")));
  add("reached", fmt::format("{:g} s in {}", run.number("time"), count(run.number("steps"), "step")));
  if (run.number("newton", "total") > 0)
    add("iterations", fmt::format("{:g} of Newton's method, {:g} of linear solvers", run.number("newton", "total"),
                                  run.number("krylov", "total")));
  add("cost",
      fmt::format("{:.3g} CPU seconds, {} of memory", run.number("cpu_seconds"), bytes(run.number("peak_rss_bytes"))));
  if (run.number("warnings") > 0) add("warnings", fmt::format("{:g}, see run.log", run.number("warnings")));
}

void add_files(RunContents& contents, const fs::path& folder) {
  const auto add = [&](const std::string& what, const std::string& text) { contents.facts.emplace_back(what, text); };
  if (fs::is_regular_file(folder / "history.csv")) {
    contents.history = read_history_file((folder / "history.csv").string());
    add("history.csv", count(static_cast<double>(contents.history.rows), "row") + " of " +
                           count(static_cast<double>(contents.history.columns.size()), "column") +
                           (contents.history.problem.empty() ? "" : "; " + contents.history.problem));
  }
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  for (const std::string& name : names) {
    if (name == "history.csv" || name == "run.json" || name == lock_file) continue;
    const fs::path path = folder / name;
    const Files files = files_below(path);
    if (!fs::is_directory(path) || fs::is_symlink(path)) {
      add(printable(name), bytes(files.size));
      continue;
    }
    std::set<double> times;
    for (const auto& entry : fs::directory_iterator(path))
      if (entry.path().extension() == ".pvd" || entry.path().extension() == ".series")
        times.merge(saved_times(entry.path()));
    add(printable(name) + "/", (times.empty() ? "" : span(times) + ", ") + files.text());
  }
}

}  // namespace

RunContents read_run_contents(const std::string& folder) {
  const fs::path path(folder);
  const auto refuse = [&](const std::string& problem) {
    throw InputError({fmt::format("{}: {}", folder.empty() ? "\"\"" : printable(folder), problem)});
  };
  if (!fs::is_directory(path)) refuse("is no folder; give that of a run, such as results/block");
  if (!fs::is_regular_file(path / "run.json")) refuse("holds no run.json, so no run of Titin wrote it");
  const Summary run{Json::parse(text_of(path / "run.json"), nullptr, false)};
  if (!run.json.is_object()) refuse("its run.json cannot be read; is it whole?");
  RunContents contents;
  add_summary(contents, run);
  try {
    add_files(contents, path);
  } catch (const fs::filesystem_error& error) {
    refuse(fmt::format("cannot be read ({})", error.code().message()));
  }
  return contents;
}

}  // namespace titin
