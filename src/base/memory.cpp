#include "base/memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// A file that holds one number ("max" says none).
double number_in(const std::string& file) {
  double value;
  return std::ifstream(file) >> value ? value : unknown;
}

double of_kernel() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("MemAvailable:", 0) == 0) return 1024 * std::stod(line.substr(13));
  return unknown;
}

/// Of the control group that a container or a batch job sees as its own (version 2).
double of_control_group() {
  const double limit = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
  return limit < unknown && used < unknown ? std::max(0.0, limit - used) : unknown;
}

}  // namespace

double available_memory() { return sum(std::min(of_kernel(), of_control_group()) / ranks_on_node()); }

}  // namespace titin
