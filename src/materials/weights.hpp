/// Lists of numbers that training leaves: keys of the scene, or of a JSON file that the scene names with `file`,
///
///     { "amplitude": "1, 0.7 kPa", "weight_1": [0.9, 0.3], "weight_2": [0.1, 0.25], "bias": [-0.4, 0.1] }
///
/// whose values are written as scenes write them and are judged alike.
#pragma once

#include <string>
#include <vector>

#include "base/config.hpp"

namespace titin {

class Weights {
 public:
  /// Reads `file`. Collective when there is one.
  explicit Weights(Section& s);
  /// Sets `value` from the file if there is one, else from the scene.
  void read(const char* name, std::vector<double>& value, const Key& key);

 private:
  void read_from_file(const char* name, std::vector<double>& value, const Key& key);

  Section& section_;
  std::string file_, text_;  // path as said and content; "" without
};

}  // namespace titin
