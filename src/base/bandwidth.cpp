#include "base/bandwidth.hpp"

#include <algorithm>
#include <vector>

#include "base/timers.hpp"

namespace titin {
namespace {

constexpr std::size_t numbers = 2'000'000;  // of each array: 16 MB
constexpr int passes = 5;                   // the first one also gets the memory

}  // namespace

double triad_bandwidth() {
  std::vector<double> a(numbers), b(numbers, 1), c(numbers, 2);
  double best = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const double begin = cpu_seconds(), s = 0.5 + pass;
    for (std::size_t i = 0; i < numbers; ++i) a[i] = b[i] + s * c[i];
    const double taken = cpu_seconds() - begin;
    std::swap(a, b);  // so that no pass can be left out
    if (taken > 0) best = std::max(best, 24.0 * numbers / taken);
  }
  return b[numbers / 2] > 0 ? best : 0;
}

}  // namespace titin
