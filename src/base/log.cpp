#include "base/log.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "base/parallel.hpp"

namespace titin::logging {
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
constexpr int red = 31, yellow = 33;
Level current = Level::normal;
int warning_count = 0;
std::unique_ptr<std::FILE, CloseFile> file;

void put(std::FILE* out, std::string_view line) {
  std::fwrite(line.data(), 1, line.size(), out);
  std::fputc('\n', out);
  std::fflush(out);  // a run that is killed has said all it knew
}

void to_file(std::string_view line) {
  if (file) put(file.get(), line);
}

/// On a terminal, unless its user or its kind wants none (https://no-color.org).
bool in_colour() {
  static const bool wanted = [] {
    const char *refused = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) && !(refused && *refused) && kind && std::string_view(kind) != "dumb";
  }();
  return wanted;
}

/// "error: ...", its first word in a colour (as terminals number them).
void put_error(std::string_view word, int colour, std::string_view line) {
  to_file(fmt::format("{}: {}", word, line));
  put(stderr,
      in_colour() ? fmt::format("\x1b[1;{}m{}:\x1b[0m {}", colour, word, line) : fmt::format("{}: {}", word, line));
}

}  // namespace

void set_level(Level level) { current = level; }
Level level() { return current; }

bool open_file(const std::string& path) {
  file.reset(path.empty() || !is_root() ? nullptr : std::fopen(path.c_str(), "a"));
  return file || path.empty() || !is_root();
}

void write(Level level, std::string_view line) {
  if (!is_root()) return;
  to_file(line);
  if (level <= current) put(stdout, line);
}

void warning(std::string_view line) {
  ++warning_count;
  if (is_root()) put_error("warning", yellow, line);
}

void error(std::string_view line) {
  if (is_root()) put_error("error", red, line);
}

int warnings() { return warning_count; }

}  // namespace titin::logging
