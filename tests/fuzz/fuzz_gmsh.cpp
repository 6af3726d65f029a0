#include <sstream>

#include "fuzz/targets.hpp"
#include "mesh/gmsh.hpp"

namespace titin {

void fuzz_gmsh(const std::string& bytes) {
  std::istringstream in(bytes);
  scan_gmsh(in);
}

}  // namespace titin
