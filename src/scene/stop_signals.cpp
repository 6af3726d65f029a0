#include "scene/stop_signals.hpp"

#include <array>
#include <csignal>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr std::array signals = {SIGINT, SIGTERM, SIGUSR1};
constexpr std::array names = {"SIGINT", "SIGTERM", "SIGUSR1"};

volatile std::sig_atomic_t caught = 0;  // index + 1
std::array<struct sigaction, signals.size()> earlier;

extern "C" void remember(int signal) {
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (signals[i] == signal) caught = static_cast<std::sig_atomic_t>(i + 1);
}

}  // namespace

StopSignals::StopSignals() {
  caught = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    if (signals[i] == SIGINT) action.sa_flags |= SA_RESETHAND;  // a second Ctrl-C ends at once
    sigaction(signals[i], &action, &earlier[i]);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &earlier[i], nullptr);
}

std::string StopSignals::received() const {
  const int index = static_cast<int>(max(static_cast<double>(caught)));
  return index == 0 ? "" : names[index - 1];
}

}  // namespace titin
