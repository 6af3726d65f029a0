/// Sums and extremes over ranks of numbers at nodes that several of them share.
///
/// Every sharing rank gets the same bits, so that nodes move alike everywhere. The message is one to each neighbour and
/// the storage is set up once for each number of words, not in a step.
#pragma once

#include <map>
#include <memory>
#include <mfem.hpp>
#include <vector>

#include "fv/simplex_mesh.hpp"

namespace titin {

class NodeExchange {
 public:
  template <int D>
  NodeExchange(const mfem::ParMesh& mesh, const SimplexMesh<D>& cells) {
    std::vector<int> node_of(mesh.GetNV());
    for (int p = 0; p < cells.nodes(); ++p) node_of[cells.vertex_of[p]] = p;
    set_up(mesh, node_of);
  }

  /// In place; `values` is [node][words]. Collective.
  void sum(double* values, int words) { reduce(values, words, mfem::GroupCommunicator::Sum<double>); }
  void max(double* values, int words) { reduce(values, words, mfem::GroupCommunicator::Max<double>); }

  /// Does this rank speak for the node in sums over nodes?
  bool owns(int node) const { return owned_[node] != 0; }
  const std::vector<int>& shared() const { return shared_; }  ///< nodes, in an order that all ranks agree on

 private:
  struct Channel {
    std::unique_ptr<mfem::GroupCommunicator> groups;
    std::vector<double> buffer;  // [shared][words]
  };
  void set_up(const mfem::ParMesh& mesh, const std::vector<int>& node_of);
  Channel& channel(int words);
  void reduce(double* values, int words, void (*operation)(mfem::GroupCommunicator::OpData<double>));

  const mfem::GroupTopology* topology_ = nullptr;
  std::vector<int> shared_, group_of_;  // alike
  std::vector<char> owned_;
  std::map<int, Channel> channels_;
};

}  // namespace titin
