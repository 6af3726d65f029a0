#include "mesh/mesh_numbers.hpp"

#include <algorithm>
#include <limits>

#include "base/digest.hpp"
#include "base/parallel.hpp"

namespace titin {

MeshNumbers::MeshNumbers(mfem::Mesh& whole, const int* rank_of_cell) {
  Digest digest;
  mfem::Array<int> vertices;
  for (int e = 0; e < whole.GetNE(); ++e) {
    if (rank_of_cell[e] == rank()) cell.push_back(e);
    whole.GetElementVertices(e, vertices);
    digest.add(whole.GetAttribute(e));
    for (int v : vertices) digest.add(v);
  }
  for (int b = 0; b < whole.GetNBE(); ++b) {
    whole.GetBdrElementVertices(b, vertices);
    digest.add(whole.GetBdrAttribute(b));
    for (int v : vertices) digest.add(v);
  }
  for (int v = 0; v < whole.GetNV(); ++v)
    for (int d = 0; d < whole.SpaceDimension(); ++d) digest.add(whole.GetVertex(v)[d]);
  if (const mfem::GridFunction* nodes = whole.GetNodes())
    for (double x : *nodes) digest.add(x);
  identity = digest.value();
}

std::vector<long> true_dof_numbers(mfem::ParFiniteElementSpace& space, const std::vector<long>& cell_numbers) {
  mfem::Array<int> dofs;
  int most = 0;
  for (int e = 0; e < space.GetNE(); ++e) {
    space.GetElementVDofs(e, dofs);
    most = std::max(most, dofs.Size());
  }
  const double stride = max(static_cast<double>(most));
  std::vector<double> least(space.GetVSize(), std::numeric_limits<double>::infinity());  // exact up to 2^53
  for (int e = 0; e < space.GetNE(); ++e) {
    space.GetElementVDofs(e, dofs);
    for (int a = 0; a < dofs.Size(); ++a) {
      double& number = least[dofs[a]];
      number = std::min(number, static_cast<double>(cell_numbers[e]) * stride + a);
    }
  }
  space.GroupComm().Reduce<double>(least.data(), mfem::GroupCommunicator::Min<double>);
  std::vector<long> numbers(space.GetTrueVSize());
  for (int dof = 0; dof < space.GetVSize(); ++dof)
    if (const int t = space.GetLocalTDofNumber(dof); t >= 0) numbers[t] = static_cast<long>(least[dof]);
  return numbers;
}

}  // namespace titin
