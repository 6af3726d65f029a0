/// What the user reads: printed by rank 0 only, and kept in run.log when a run has a folder.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace titin::logging {  // "log" is the logarithm, of dual numbers too

enum class Level { quiet, normal, verbose, debug };  // -q, nothing, -v, -vv

void set_level(Level level);
Level level();
/// Also appends everything from now on to this file (rank 0), whatever the level; "" closes it. False when it cannot
/// be.
bool open_file(const std::string& path);

void write(Level level, std::string_view line);  ///< one line, shown if the level is at least this
void warning(std::string_view line);             ///< shown always, to stderr, counted
void error(std::string_view line);               ///< shown always, to stderr
int warnings();                                  ///< how many so far: for run.json

template <class... Args>
void info(fmt::format_string<Args...> text, Args&&... args) {
  write(Level::normal, fmt::format(text, std::forward<Args>(args)...));
}
template <class... Args>
void detail(fmt::format_string<Args...> text, Args&&... args) {
  write(Level::verbose, fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace titin::logging
