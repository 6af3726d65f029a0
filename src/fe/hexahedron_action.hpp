/// The kernel of TangentAction for one order and number of points.
#pragma once

#include <algorithm>

#include "fe/hexahedron_batch.hpp"
#include "fe/node_halo.hpp"
#include "fe/tangent_action.hpp"

namespace titin {

/// n nodes and q points a direction.
template <class Real, int n, int q>
class HexahedronAction : public TangentAction {
 public:
  HexahedronAction(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                   const std::vector<char>& constrained);
  void set(const TangentOfCell& at) override;
  void multiply(const double* x, double* y) override;
  std::size_t bytes() const override;

 private:
  using Batch = HexahedronBatch<Real, n, q, true>;
  using V = typename Batch::V;
  static constexpr int lanes = Batch::lanes, nodes = Batch::nodes, points = Batch::points, modes = Batch::modes;
  /// Displacements [component][node], or slopes [component][direction][point].
  using AtNodes = V[3][nodes];
  using AtPoints = V[3][3][points];

  void order_cells(const mfem::ParFiniteElementSpace& space);
  void apply(std::size_t first, std::size_t last);
  void gather(std::size_t batch, AtNodes& u) const;
  void scatter(std::size_t batch, const AtNodes& f);
  static void multiply_points(const Batch& batch, AtPoints& g, V (&value)[3][points]);
  static void moduli_times(const V* A, const V* g, V* f);

  const CellTables& tables_;
  NodeHalo halo_;
  LineTables<Real, n, q> line_;
  std::vector<int> cells_;               // [batch][lane], -1: none
  std::vector<int> dofs_;                // [batch][node][lane]: first component, in x_ and y_
  std::size_t batches_ = 0, inner_ = 0;  // the first `inner_` batches see no node of another rank
  std::vector<Batch> data_;
  std::vector<int> constrained_;  // true dofs of this rank
  std::vector<Real> x_, y_;       // at halo nodes, then one node for the lanes without a cell
};

template <class Real, int n, int q>
HexahedronAction<Real, n, q>::HexahedronAction(const mfem::ParFiniteElementSpace& space, const CellTables& tables,
                                               const std::vector<char>& constrained)
    : tables_(tables), halo_(space), line_(line_tables<Real, n, q>(*space.GetFE(0), tables.rule(0))) {
  order_cells(space);
  for (int dof = 0; dof < space.GetVSize(); ++dof)
    if (constrained[dof] && space.GetLocalTDofNumber(dof) >= 0) constrained_.push_back(space.GetLocalTDofNumber(dof));
  x_.assign(3 * (halo_.nodes() + 1), 0);
  y_.assign(x_.size(), 0);
}

/// Cells that see no node of another rank come first; each kind fills whole batches.
template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::order_cells(const mfem::ParFiniteElementSpace& space) {
  const mfem::Table& cells = space.GetElementToDofTable();
  const auto& lexicographic = dynamic_cast<const mfem::NodalFiniteElement&>(*space.GetFE(0)).GetLexicographicOrdering();
  std::vector<int> kind[2];
  for (int cell = 0; cell < cells.Size(); ++cell) {
    bool sees_other = false;
    for (int a = 0; a < nodes; ++a) sees_other |= halo_.is_other(halo_.number(cells.GetRow(cell)[a]));
    kind[sees_other].push_back(cell);
  }
  inner_ = (kind[0].size() + lanes - 1) / lanes;
  batches_ = inner_ + (kind[1].size() + lanes - 1) / lanes;
  cells_.assign(batches_ * lanes, -1);
  dofs_.assign(batches_ * nodes * lanes, 3 * halo_.nodes());  // lanes without a cell see a node of their own
  for (int k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < kind[k].size(); ++i) {
      const int cell = kind[k][i];
      const std::size_t place = (k == 0 ? 0 : inner_ * lanes) + i;
      cells_[place] = cell;
      for (int a = 0; a < nodes; ++a)
        dofs_[(place / lanes * nodes + a) * lanes + place % lanes] =
            3 * halo_.number(cells.GetRow(cell)[lexicographic[a]]);
    }
  data_.resize(batches_);
}

template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::set(const TangentOfCell& at) {
  HexahedronFiller<Real, n, q, true> filler(tables_);
  for (std::size_t batch = 0; batch < batches_; ++batch) filler.fill(&cells_[batch * lanes], at, data_[batch]);
}

template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::gather(std::size_t batch, AtNodes& u) const {
  const int* dof = &dofs_[batch * nodes * lanes];
  for (int a = 0; a < nodes; ++a, dof += lanes)
    for (int i = 0; i < 3; ++i) u[i][a] = V([&](auto lane) { return x_[dof[lane] + i]; });
}

template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::scatter(std::size_t batch, const AtNodes& f) {
  const int* dof = &dofs_[batch * nodes * lanes];
  for (int a = 0; a < nodes; ++a, dof += lanes)
    for (int i = 0; i < 3; ++i)
      for (int lane = 0; lane < lanes; ++lane) y_[dof[lane] + i] += f[i][a][lane];
}

/// f = A g, A by the rows of its upper triangle.
template <class Real, int n, int q>
inline void HexahedronAction<Real, n, q>::moduli_times(const V* A, const V* g, V* f) {
  int entry = 0;
#pragma GCC unroll 9
  for (int r = 0; r < 9; ++r) {
    const V diagonal = A[entry++] * g[r];
    f[r] = r == 0 ? diagonal : f[r] + diagonal;
#pragma GCC unroll 9
    for (int c = r + 1; c < 9; ++c) {
      const V a = A[entry++];
      f[r] += a * g[c];
      f[c] = r == 0 ? a * g[r] : f[c] + a * g[r];
    }
  }
}

/// Slopes become stresses, displacements become inertia forces, in place.
template <class Real, int n, int q>
inline void HexahedronAction<Real, n, q>::multiply_points(const Batch& batch, AtPoints& g, V (&value)[3][points]) {
  V volume[modes], pressure[modes];
  for (int l = 0; l < modes; ++l) volume[l] = pressure[l] = V(0);
  for (int p = 0; p < points; ++p) {
    V change = V(0);
    for (int r = 0; r < 9; ++r) change += batch.point[p].c[r] * g[r / 3][r % 3][p];
    for (int l = 0; l < modes; ++l) volume[l] += batch.point[p].psi[l] * change;
  }
  for (int l = 0; l < modes; ++l)
    for (int m = 0; m < modes; ++m) pressure[l] += batch.S[l * modes + m] * volume[m];
  for (int p = 0; p < points; ++p) {
    const auto& point = batch.point[p];
    V slope[9], f[9], s = V(0);
    for (int r = 0; r < 9; ++r) slope[r] = g[r / 3][r % 3][p];
    moduli_times(point.A, slope, f);
    for (int l = 0; l < modes; ++l) s += point.psi[l] * pressure[l];
    for (int r = 0; r < 9; ++r) g[r / 3][r % 3][p] = f[r] + s * point.c[r];
    for (int i = 0; i < 3; ++i) value[i][p] *= point.inertia;
  }
}

template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::apply(std::size_t first, std::size_t last) {
  AtNodes u;
  AtPoints g;
  V value[3][points];
  for (std::size_t batch = first; batch < last; ++batch) {
    gather(batch, u);
    for (int i = 0; i < 3; ++i) {
      to_points<n, q>(line_, u[i], value[i]);
      slopes<q>(line_, value[i], g[i][0], g[i][1], g[i][2]);
    }
    multiply_points(data_[batch], g, value);
    for (int i = 0; i < 3; ++i) {
      add_slopes_transposed<q>(line_, g[i][0], g[i][1], g[i][2], value[i]);
      from_points<n, q>(line_, value[i], u[i]);
    }
    scatter(batch, u);
  }
}

/// Messages travel while cells work that need nothing of them.
template <class Real, int n, int q>
void HexahedronAction<Real, n, q>::multiply(const double* x, double* y) {
  const int own = 3 * halo_.owned();
  std::copy_n(x, own, x_.data());
  std::fill(y_.begin(), y_.end(), Real(0));
  for (int dof : constrained_) x_[dof] = 0;
  halo_.begin_fetch(x_.data());
  apply(0, inner_ / 2);
  halo_.end_fetch();
  apply(inner_, batches_);
  halo_.begin_sum(y_.data());
  apply(inner_ / 2, inner_);
  halo_.end_sum(y_.data());
  std::copy_n(y_.data(), own, y);
  for (int dof : constrained_) y[dof] = x[dof];
}

template <class Real, int n, int q>
std::size_t HexahedronAction<Real, n, q>::bytes() const {
  return data_.size() * sizeof(Batch) + dofs_.size() * sizeof(int) + 2 * x_.size() * sizeof(Real);
}

}  // namespace titin
