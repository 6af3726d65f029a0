/// Keys by which tables of a scene name parts of the mesh: `on` of [boundary.NAME], `regions` of [materials.NAME].
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

/// Reads `on`: the boundaries of the mesh that the table [boundary.name] is about. Unknown ones are reported.
std::vector<std::string> read_boundaries(Section& s, const std::string& name, const NamedMesh& mesh);

/// Which material each region of the mesh is made of.
class RegionMaterials {
 public:
  /// Reads `regions` of a material: all when the scene names none. Unknown ones and those that are taken are reported.
  void read(Section& s, const std::string& material, const NamedMesh& mesh);
  /// After all materials: reports regions that are made of nothing, unless something else was wrong.
  void finish(Section& root, const NamedMesh& mesh) const;
  const std::map<int, std::string>& by_attribute() const { return of_; }  ///< MFEM's attribute -> material

 private:
  std::map<int, std::string> of_;
  bool right_ = true, any_ = false;
};

}  // namespace titin
