/// SIGINT (Ctrl-C), SIGTERM and SIGUSR1 (batch systems) ask a run to end after the present step.
#pragma once

#include <string>

namespace titin {

class StopSignals {
 public:
  StopSignals();
  ~StopSignals();  ///< puts back what was there
  StopSignals(const StopSignals&) = delete;
  /// Name of a signal that any rank got, or "". Collective: all ranks stop at the same step.
  std::string received() const;
};

}  // namespace titin
