/// A posteriori choice of the order of each cell (MOOD): linear, linear with the limiter, constant.
///
/// A candidate step with linear cells everywhere is judged afterwards. A cell in trouble - values that are no numbers,
/// a volume or state without meaning, a fluid's shock inside it, or, where the flow is not smooth, a density (of fluids
/// also a mean stress or velocity) outside of the range of its neighbours at the start of the step - and it alone loses
/// an order; only nodes of such cells, and the cells around those nodes, are computed again. Clain, Diot, Loubere
/// (2011), J. Comput. Phys. 230:4028; Boscheri, Loubere, Maire (2022), J. Comput. Phys. 449:110779.
#pragma once

#include <cstdint>
#include <vector>

#include "fv/fv_config.hpp"
#include "fv/node_exchange.hpp"

namespace titin {

/// Order of a cell: what its slopes are.
enum class CellOrder : std::int8_t { constant = 0, limited = 1, linear = 2 };

template <int D>
class Mood {
 public:
  Mood(const SimplexMesh<D>& mesh, NodeExchange& exchange, Cascade cascade);

  void start(CellOrder order);
  CellOrder order(int cell) const { return order_[cell]; }
  void set_order(int cell, CellOrder order) { order_[cell] = order; }  ///< of an accepted step that is read back
  /// Lowers the cells in trouble. Collective: false when no rank has any.
  bool lower(const std::vector<int>& troubled);
  /// After lower: nodes that move anew, cells whose corners change, cells that those nodes belong to.
  const std::vector<int>& nodes() const { return nodes_; }
  const std::vector<int>& lowered() const { return lowered_; }
  const std::vector<int>& touched() const { return touched_; }

 private:
  const SimplexMesh<D>& mesh_;
  NodeExchange& exchange_;
  Cascade cascade_;
  std::vector<CellOrder> order_;
  std::vector<double> node_mark_;
  std::vector<char> cell_mark_;
  std::vector<int> nodes_, lowered_, touched_;
};

extern template class Mood<2>;
extern template class Mood<3>;

}  // namespace titin
