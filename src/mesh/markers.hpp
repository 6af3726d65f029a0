/// Points of the undeformed body whose displacement is followed.
#pragma once

#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mesh/mesh.hpp"

namespace titin {

struct MarkerConfig {
  std::string name;
  std::array<double, 3> position{};  // [m] in the reference configuration
  int cell = -1;                     // of this rank that holds it; -1: another rank has it
  mfem::IntegrationPoint place;      // in that cell
};

/// Reads [markers] and finds them. Collective.
std::vector<MarkerConfig> read_markers(Section& root, const NamedMesh& mesh);

/// "the mesh lies between (...) and (...) m", for messages. Collective.
std::string bounds_of(mfem::ParMesh& mesh);

/// A coordinate that was not read: what is wrong already is not judged once more.
inline constexpr double unread = std::numeric_limits<double>::quiet_NaN();
bool was_read(const std::array<double, 3>& x);

}  // namespace titin
