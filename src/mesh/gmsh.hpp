/// Gmsh 2.2 text files: the names that MFEM's reader drops, and what is wrong with a file, which it does not tell.
#pragma once

#include <istream>
#include <map>
#include <string>

namespace titin {

struct GmshFile {
  std::map<std::string, int> volumes, surfaces;  ///< physical names -> tags
  std::string problem, advice;                   ///< why it cannot be used, "line 12: ..."; empty when it can
};

/// Looks through the whole file: after this, MFEM can read it. All cells must be hexahedra, of any order.
GmshFile scan_gmsh(std::istream& in);

}  // namespace titin
