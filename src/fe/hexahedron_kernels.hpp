/// Picks the kernel that was compiled for an order and a number of points.
#pragma once

#include <memory>

#include "fe/cell_tables.hpp"

namespace titin {

/// make.operator()<n, q>() for the n nodes and q points a direction of `tables`, where there is a kernel for them: Q1,
/// Q2 and Q3 with as many points as nodes, Q2 with more points too. Null elsewhere, and where cells are no hexahedra of
/// three fields.
template <class Result, class Make>
std::unique_ptr<Result> hexahedron_kernel(const CellTables& tables, const Make& make) {
  std::unique_ptr<Result> kernel;
  if (tables.geometry() != mfem::Geometry::CUBE || tables.modes(0) == 0) return kernel;
  const auto try_one = [&]<int n, int q>() {
    if (tables.nodes(0) == n * n * n && tables.points(0) == q * q * q) kernel = make.template operator()<n, q>();
  };
  try_one.template operator()<2, 2>();
  try_one.template operator()<3, 3>();
  try_one.template operator()<3, 4>();
  try_one.template operator()<3, 5>();
  try_one.template operator()<4, 4>();
  return kernel;
}

}  // namespace titin
