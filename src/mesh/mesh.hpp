/// A partitioned mesh with named regions and boundaries.
#pragma once

#include <map>
#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"

namespace titin {

struct MeshConfig {
  std::array<double, 3> box{0, 0, 0};  // edge lengths [m] of [0,a]x[0,b]x[0,c]; zeros: no box
  std::array<int, 3> cells{1, 1, 1};   // of the box
  std::string file;                    // Gmsh 2.2
  double unit = 1;                     // length of 1 in the file [m]
  int refine = 0;                      // uniform refinements after loading
  void bind(Section& s);
};

struct NamedMesh {
  std::unique_ptr<mfem::ParMesh> mesh;
  std::map<std::string, int> regions, boundaries;  ///< name -> MFEM attribute

  /// Loads or makes the mesh, refines it, and gives each rank its part. Collective. Errors (a file that is not a mesh,
  /// cells that are not hexahedra, fewer cells than ranks) are reported to the section, and the mesh is then empty.
  static NamedMesh read(const MeshConfig& config, Section section);

  /// Marker array for MFEM of these boundary names, which must exist.
  mfem::Array<int> boundary_marker(const std::vector<std::string>& names) const;
};

/// "Names we have: a, b, c", for messages.
std::string names_of(const std::map<std::string, int>& names);

}  // namespace titin
