/// A file of a run's output that cannot be written: nobody's mistake in the scene, nor one of the program.
#pragma once

#include <stdexcept>
#include <string>

namespace titin {

class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& what)
      : std::runtime_error(what + " cannot be written; look at the permissions and the free space") {}
};

}  // namespace titin
