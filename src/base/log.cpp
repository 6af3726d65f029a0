#include "base/log.hpp"

#include <cstdio>
#include <memory>

#include "base/parallel.hpp"

namespace titin::logging {
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
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
  if (!is_root()) return;
  const std::string text = fmt::format("warning: {}", line);
  to_file(text);
  put(stderr, text);
}

void error(std::string_view line) {
  if (!is_root()) return;
  const std::string text = fmt::format("error: {}", line);
  to_file(text);
  put(stderr, text);
}

int warnings() { return warning_count; }

}  // namespace titin::logging
