/// How well a run keeps its energy and its volume, over all states so far: near zero for a small enough step and a
/// nearly incompressible body.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solve/model.hpp"

namespace titin {

class Conservation {
 public:
  /// Takes in the quantities of the start, and then of every accepted state.
  void update(const std::vector<Quantity>& quantities) {
    for (const Quantity& q : quantities) {
      if (q.name == "energy_balance_error")
        balance_error_ = std::max(balance_error_, std::abs(q.value));
      else if (q.unit == "J")  // an energy or a work
        largest_energy_ = std::max(largest_energy_, std::abs(q.value));
      if (q.name != "volume") continue;
      if (!(volume_at_start_ > 0)) volume_at_start_ = q.value;
      volume_change_ = std::max(volume_change_, std::abs(q.value / volume_at_start_ - 1));
    }
  }

  void walk(StateWalk& walk);
  /// The largest so far: error of the energy balance over the largest energy or work, and change of the volume over the
  /// volume at the start.
  std::vector<Quantity> list() const {
    return {{"energy_balance_error", "", largest_energy_ > 0 ? balance_error_ / largest_energy_ : 0.0},
            {"volume_change", "", volume_change_}};
  }

 private:
  double balance_error_ = 0, largest_energy_ = 0;  // [J]
  double volume_at_start_ = 0;                     // [m^3]
  double volume_change_ = 0;
};

}  // namespace titin
