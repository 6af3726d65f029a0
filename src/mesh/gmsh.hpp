/// Gmsh 2.2 text files: the names that MFEM's reader drops, and what is wrong with a file, which it does not tell.
#pragma once

#include <istream>
#include <map>
#include <string>

namespace titin {

struct GmshFile {
  std::map<std::string, int> volumes, surfaces;  ///< physical names of cells and boundaries -> tags
  std::string problem, advice;                   ///< why it cannot be used, "line 12: ..."; empty when it can
};

/// Looks through the whole file: after this, MFEM can read it. Cells are hexahedra, tetrahedra and wedges or,
/// of a plane body, quadrilaterals and triangles, of order 1 to 3.
GmshFile scan_gmsh(std::istream& in);

}  // namespace titin
