/// How much a scene wants to be modelled: as it is written, or the least that keeps a quantity within a tolerance.
#pragma once

#include <string>
#include <vector>

#include "base/config.hpp"
#include "solve/model.hpp"

namespace titin {

enum class Fidelity { as_written, automatic };

struct FidelityConfig {
  Fidelity fidelity = Fidelity::as_written;
  std::string quantity = "";  ///< "": the one that a run shows
  double tolerance = 0.02;    ///< of the largest value of the quantity

  /// Keys at the top of a scene.
  void bind(Section root);
  /// Reports a quantity that the run does not follow.
  void match(const std::vector<Quantity>& followed, Section root) const;
};

/// What makes a scene one that is run as it is, after this was chosen for it: overrides.
std::vector<std::string> as_chosen(std::vector<std::string> proposal, const std::string& quantity);

}  // namespace titin
