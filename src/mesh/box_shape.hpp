/// Where a box lies and how it is bent, for benchmarks that need no mesh file.
#pragma once

#include <array>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

enum class Bend { cylinder, sphere };

struct BoxShape {
  std::array<double, 3> origin{};  // [m] of the corner that is the smallest in all coordinates
  double inner_radius = 0;         // [m] 0: straight
  Bend bend = Bend::cylinder;      // what it becomes a part of
  double skew = 0;                 // [m]
  double ripple = 0;               // [m] amplitude
  double ripple_at = 0;            // [m] along x
  void bind(Section& s);
  /// Moves the nodes of a box that begins at 0. Skewed and rippled first, then bent, then moved. Collective.
  void apply(mfem::ParMesh& mesh) const;
};

}  // namespace titin
