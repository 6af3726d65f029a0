#include "fv/node_exchange.hpp"

#include <algorithm>

namespace titin {

void NodeExchange::set_up(const mfem::ParMesh& mesh, const std::vector<int>& node_of) {
  topology_ = &mesh.gtopo;
  owned_.assign(node_of.size(), 1);
  for (int group = 1; group < mesh.GetNGroups(); ++group)
    for (int i = 0; i < mesh.GroupNVertices(group); ++i) {
      const int node = node_of[mesh.GroupVertex(group, i)];
      shared_.push_back(node);
      group_of_.push_back(group);
      owned_[node] = topology_->IAmMaster(group);
    }
}

NodeExchange::Channel& NodeExchange::channel(int words) {
  Channel& c = channels_[words];
  if (c.groups) return c;
  c.buffer.resize(shared_.size() * words);
  mfem::Array<int> groups(static_cast<int>(c.buffer.size()));
  for (int k = 0; k < groups.Size(); ++k) groups[k] = group_of_[k / words];
  c.groups = std::make_unique<mfem::GroupCommunicator>(*topology_);
  c.groups->Create(groups);
  return c;
}

void NodeExchange::reduce(double* values, int words, void (*operation)(mfem::GroupCommunicator::OpData<double>)) {
  if (topology_->MyRank() == 0 && topology_->NRanks() == 1) return;
  Channel& c = channel(words);
  for (std::size_t s = 0; s < shared_.size(); ++s)
    std::copy_n(values + static_cast<std::size_t>(shared_[s]) * words, words, &c.buffer[s * words]);
  c.groups->Reduce<double>(c.buffer.data(), operation);
  c.groups->Bcast<double>(c.buffer.data());
  for (std::size_t s = 0; s < shared_.size(); ++s)
    std::copy_n(&c.buffer[s * words], words, values + static_cast<std::size_t>(shared_[s]) * words);
}

}  // namespace titin
