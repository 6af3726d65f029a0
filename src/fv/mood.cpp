#include "fv/mood.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace titin {

template <int D>
Mood<D>::Mood(const SimplexMesh<D>& mesh, NodeExchange& exchange, Cascade cascade)
    : mesh_(mesh),
      exchange_(exchange),
      cascade_(cascade),
      order_(mesh.cells()),
      node_mark_(mesh.nodes()),
      cell_mark_(mesh.cells()) {
  nodes_.reserve(mesh.nodes());
  lowered_.reserve(mesh.cells());
  touched_.reserve(mesh.cells());
}

template <int D>
void Mood<D>::start(CellOrder order) {
  std::fill(order_.begin(), order_.end(), order);
}

template <int D>
bool Mood<D>::lower(const std::vector<int>& troubled) {
  if (!any_of(!troubled.empty())) return false;
  nodes_.clear();
  touched_.clear();
  lowered_ = troubled;
  std::fill(node_mark_.begin(), node_mark_.end(), 0.0);
  for (int c : troubled) {
    const bool limited = order_[c] == CellOrder::linear && cascade_ == Cascade::limited;
    order_[c] = limited ? CellOrder::limited : CellOrder::constant;
    for (int p : mesh_.nodes_of[c]) node_mark_[p] = 1;
  }
  exchange_.max(node_mark_.data(), 1);
  for (int p = 0; p < mesh_.nodes(); ++p) {
    if (node_mark_[p] == 0) continue;
    nodes_.push_back(p);
    for (int k = mesh_.first_corner[p]; k < mesh_.first_corner[p + 1]; ++k) {
      const int c = mesh_.corners[k] / (D + 1);
      if (!cell_mark_[c]) touched_.push_back(c);
      cell_mark_[c] = 1;
    }
  }
  std::sort(touched_.begin(), touched_.end());
  for (int c : touched_) cell_mark_[c] = 0;
  return true;
}

template class Mood<2>;
template class Mood<3>;

}  // namespace titin
