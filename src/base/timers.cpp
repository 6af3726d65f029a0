#include "base/timers.hpp"

#include <sys/resource.h>

#include <chrono>
#include <ctime>
#include <vector>

namespace titin {
namespace {

double wall_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
const double program_start = wall_now();

struct Stopwatch {
  std::map<std::string, Timers::Phase> phases;
  std::vector<Timers::Phase*> open;  // innermost last; map nodes stay where they are
  double cpu = 0, wall = 0;          // when the innermost phase last began to count

  /// Books the time since the last call on the innermost phase.
  void book() {
    const double cpu_now = cpu_seconds(), now = wall_now();
    if (!open.empty()) {
      open.back()->cpu += cpu_now - cpu;
      open.back()->wall += now - wall;
    }
    cpu = cpu_now;
    wall = now;
  }
};

Stopwatch& stopwatch() {
  static Stopwatch s;
  return s;
}

}  // namespace

Timers::Scope::Scope(const std::string& name) {
  Stopwatch& s = stopwatch();
  s.book();
  Phase& phase = s.phases[name];
  ++phase.calls;
  s.open.push_back(&phase);
}

Timers::Scope::~Scope() {
  stopwatch().book();
  stopwatch().open.pop_back();
}

const std::map<std::string, Timers::Phase>& Timers::phases() { return stopwatch().phases; }

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() { return wall_now() - program_start; }

std::size_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in kilobytes
}

}  // namespace titin
