/// Numbers of cells and nodes that do not depend on how many ranks share the mesh: what files of a run's state count
/// by.
///
/// A cell has its number in the whole mesh before it was shared out. A node has
///
///   min over the cells that hold it of (number of the cell * stride + place of the node in the cell),
///
/// stride being the most nodes that any cell has.
#pragma once

#include <cstdint>
#include <mfem.hpp>
#include <vector>

namespace titin {

struct MeshNumbers {
  std::vector<long> cell;      ///< of each cell of this rank
  std::uint64_t identity = 0;  ///< of the whole mesh: changes with any coordinate, attribute or connection

  MeshNumbers() = default;
  /// MFEM gives each rank its cells in the order of the whole mesh.
  MeshNumbers(mfem::Mesh& whole, const int* rank_of_cell);
};

/// Numbers of this rank's true dofs, each component of a vector on its own. Collective.
std::vector<long> true_dof_numbers(mfem::ParFiniteElementSpace& space, const std::vector<long>& cell_numbers);

}  // namespace titin
