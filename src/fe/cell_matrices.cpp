#include "fe/cell_matrices.hpp"

#include "fe/hexahedron_kernels.hpp"
#include "fe/hexahedron_matrices.hpp"

namespace titin {

std::unique_ptr<CellMatrices> CellMatrices::create(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                                                   bool symmetric) {
  return hexahedron_kernel<CellMatrices>(tables, [&]<int n, int q>() -> std::unique_ptr<CellMatrices> {
    if (symmetric) return std::make_unique<HexahedronMatrices<n, q, true>>(space, tables);
    return std::make_unique<HexahedronMatrices<n, q, false>>(space, tables);
  });
}

}  // namespace titin
