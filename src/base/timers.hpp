/// CPU and wall time by phase. Phases are exclusive: a phase opened inside another pauses the outer one.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace titin {

class Timers {
 public:
  struct Phase {
    double cpu = 0, wall = 0;  // [s], this rank
    long calls = 0;
  };
  /// Opens a phase until it goes out of scope.
  class Scope {
   public:
    explicit Scope(const std::string& name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
  };
  static const std::map<std::string, Phase>& phases();
};

double cpu_seconds();          ///< this process, all threads
double wall_seconds();         ///< since the program started
std::size_t peak_rss_bytes();  ///< this process

}  // namespace titin
