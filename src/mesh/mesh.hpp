/// A partitioned mesh with named regions and boundaries.
#pragma once

#include <map>
#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh_numbers.hpp"

namespace titin {

enum class BoxCells { tensor, simplices, wedges };
enum class BoxCuts { same, alternating, crossed };  // of a box into simplices

struct MeshConfig {
  std::vector<double> box;           // edge lengths [m] of [0,a]x[0,b](x[0,c]); none: no box
  std::vector<int> cells;            // of the box; none: one in each direction
  BoxCells kind = BoxCells::tensor;  // of the box's cells
  BoxCuts cuts = BoxCuts::alternating;
  std::vector<double> interfaces;  // planes across x between regions of the box [m]
  std::string file;                // Gmsh 2.2
  double unit = 1;                 // length of 1 in the file [m]
  double thickness = 1;            // of a plane body [m]
  int refine = 0;                  // uniform refinements after loading
  void bind(Section& s);
};

struct NamedMesh {
  std::unique_ptr<mfem::ParMesh> mesh;
  double thickness = 1;                            ///< of a plane body [m]
  std::map<std::string, int> regions, boundaries;  ///< name -> MFEM attribute
  MeshNumbers numbers;                             ///< set by read

  /// Loads or makes the mesh, refines it, and gives each rank its part. Collective. Errors (a file that is not a mesh,
  /// pyramids in it, fewer cells than ranks) are reported to the section, and the mesh is then empty.
  static NamedMesh read(const MeshConfig& config, Section section);

  /// Marker array for MFEM of these boundary names, which must exist.
  mfem::Array<int> boundary_marker(const std::vector<std::string>& names) const;
};

/// "Names we have: a, b, c", for messages.
std::string names_of(const std::map<std::string, int>& names);

}  // namespace titin
