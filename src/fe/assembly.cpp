#include "fe/assembly.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"

namespace titin {

namespace {

constexpr auto absent = std::numeric_limits<std::int16_t>::min();  // no row is so long

void sort_unique(std::vector<PetscInt>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

/// Rows of sorted global column nodes.
struct Assembly::Graph {
  std::vector<std::size_t> start{0};
  std::vector<PetscInt> columns;

  void add_row(std::vector<PetscInt>& row) {
    sort_unique(row);
    columns.insert(columns.end(), row.begin(), row.end());
    start.push_back(columns.size());
    row.clear();
  }
  const PetscInt* begin(std::size_t row) const { return columns.data() + start[row]; }
  const PetscInt* end(std::size_t row) const { return columns.data() + start[row + 1]; }
  std::size_t length(std::size_t row) const { return start[row + 1] - start[row]; }
};

Assembly::Assembly(const mfem::ParFiniteElementSpace& space, std::vector<char> constrained)
    : space_(space), components_(space.GetVDim()), constrained_(std::move(constrained)) {
  number_nodes();
  check(MatCreate(PETSC_COMM_WORLD, &K_));
  check(MatSetSizes(K_, space.GetTrueVSize(), space.GetTrueVSize(), PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(K_, components_));
  check(MatSetType(K_, MATAIJ));
  const Graph local = local_graph(), graph = agreed_graph(local);
  create_matrix(graph);
  set_slots(graph, local);
}

Assembly::~Assembly() { MatDestroy(&K_); }

/// The components of a node have consecutive numbers: byVDIM.
void Assembly::number_nodes() {
  first_ = static_cast<PetscInt>(space_.GetMyTDofOffset() / components_);
  owned_ = space_.GetTrueVSize() / components_;
  local_node_.resize(owned_);
  for (int node = 0; node < space_.GetNDofs(); ++node) {
    const int dof = components_ * node, own = space_.GetLocalTDofNumber(dof);
    own_.push_back(own < 0 ? -1 : own / components_);
    global_.push_back(static_cast<PetscInt>(space_.GetGlobalTDofNumber(dof) / components_));
    if (own >= 0) local_node_[own_.back()] = node;
  }
}

bool Assembly::is_fixed(int node) const {
  const char* marker = &constrained_[components_ * node];
  return std::all_of(marker, marker + components_, [](char is) { return is != 0; });
}

/// What this rank's cells couple: a row for each local node, also of other ranks.
Assembly::Graph Assembly::local_graph() const {
  const mfem::Table& nodes_of_cell = space_.GetElementToDofTable();
  mfem::Table cells_of_node;
  mfem::Transpose(nodes_of_cell, cells_of_node, space_.GetNDofs());
  Graph graph;
  std::vector<PetscInt> row;
  for (int node = 0; node < space_.GetNDofs(); ++node) {
    row.push_back(global_[node]);
    for (int i = 0; i < cells_of_node.RowSize(node) && !is_fixed(node); ++i) {
      const int cell = cells_of_node.GetRow(node)[i];
      const int* other = nodes_of_cell.GetRow(cell);
      for (int b = 0; b < nodes_of_cell.RowSize(cell); ++b)
        if (!is_fixed(other[b])) row.push_back(global_[other[b]]);
    }
    graph.add_row(row);
  }
  return graph;
}

/// The rows of other ranks one after the other, by rank and number; the parts to send.
std::vector<Exchange::Part> Assembly::order_stash(const Graph& local) {
  for (int node = 0; node < space_.GetNDofs(); ++node)
    if (!is_owned(node)) stash_order_.push_back(node);
  std::sort(stash_order_.begin(), stash_order_.end(), [&](int a, int b) { return global_[a] < global_[b]; });
  stash_start_.resize(own_.size());
  PetscLayout layout;
  check(MatGetLayouts(K_, &layout, nullptr));
  check(PetscLayoutSetUp(layout));
  std::vector<Exchange::Part> parts;
  std::size_t blocks = 0;
  for (int node : stash_order_) {
    PetscMPIInt owner;
    check(PetscLayoutFindOwner(layout, components_ * global_[node], &owner));
    if (parts.empty() || parts.back().rank != owner) parts.push_back({owner, 0});
    stash_start_[node] = blocks;
    parts.back().count += local.length(node);
    blocks += local.length(node);
  }
  return parts;
}

/// The rows of this rank's nodes, as the cells of all ranks couple them. Collective.
Assembly::Graph Assembly::agreed_graph(const Graph& local) {
  exchange_ = std::make_unique<Exchange>(order_stash(local));
  std::vector<PetscInt> send;  // row, column
  for (int node : stash_order_)
    for (const PetscInt* column = local.begin(node); column != local.end(node); ++column)
      send.insert(send.end(), {global_[node], *column});
  std::vector<PetscInt> received(2 * exchange_->received());
  exchange_->begin(send.data(), received.data(), 2);
  exchange_->end();
  std::vector<std::vector<PetscInt>> more(owned_);
  for (std::size_t i = 0; i < received.size(); i += 2) more[received[i] - first_].push_back(received[i + 1]);
  Graph graph;
  std::vector<PetscInt> row;
  for (PetscInt node = 0; node < owned_; ++node) {
    row.assign(local.begin(local_node_[node]), local.end(local_node_[node]));
    row.insert(row.end(), more[node].begin(), more[node].end());
    graph.add_row(row);
  }
  for (std::size_t i = 0; i < received.size(); i += 2) {
    const auto node = static_cast<int>(received[i] - first_);
    received_targets_.push_back({node, slot(graph, node, received[i + 1])});
  }
  stash_.resize(std::size_t(components_) * components_ * exchange_->sent());
  received_.resize(std::size_t(components_) * components_ * exchange_->received());
  return graph;
}

/// Preallocates K and writes its pattern, a row of blocks at a time.
void Assembly::create_matrix(const Graph& graph) {
  const int c = components_;
  own_start_.assign(1, 0);
  other_start_.assign(1, 0);
  std::vector<PetscInt> own, other, rows(c), columns;
  for (PetscInt node = 0; node < owned_; ++node) {
    const auto inside = static_cast<PetscInt>(std::lower_bound(graph.begin(node), graph.end(node), first_ + owned_) -
                                              std::lower_bound(graph.begin(node), graph.end(node), first_));
    own.push_back(inside);
    other.push_back(static_cast<PetscInt>(graph.length(node)) - inside);
    own_start_.push_back(own_start_.back() + own.back());
    other_start_.push_back(other_start_.back() + other.back());
  }
  check(MatXAIJSetPreallocation(K_, c, own.data(), other.data(), nullptr, nullptr));
  check(MatSetOption(K_, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  std::vector<PetscScalar> zeros;
  for (PetscInt node = 0; node < owned_; ++node) {
    columns.clear();
    for (const PetscInt* column = graph.begin(node); column != graph.end(node); ++column)
      for (int k = 0; k < c; ++k) columns.push_back(c * *column + k);
    zeros.resize(c * columns.size(), 0.0);
    for (int i = 0; i < c; ++i) rows[i] = c * (first_ + node) + i;
    check(MatSetValues(K_, c, rows.data(), static_cast<PetscInt>(columns.size()), columns.data(), zeros.data(),
                       INSERT_VALUES));
  }
  check(MatAssemblyBegin(K_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(K_, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(K_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  own_part_ = K_;
  if (ranks() > 1) check(MatMPIAIJGetSeqAIJ(K_, &own_part_, &other_part_, nullptr));
}

/// Where the block of a column lies in the row of one of this rank's nodes, which has it.
Assembly::Slot Assembly::slot(const Graph& graph, int node, PetscInt column) const {
  const PetscInt *begin = graph.begin(node), *end = graph.end(node);
  const PetscInt* own = std::lower_bound(begin, end, first_);
  const PetscInt* own_end = std::lower_bound(own, end, first_ + owned_);
  const PetscInt* found = std::lower_bound(begin, end, column);
  if (found >= own && found < own_end) return static_cast<Slot>(found - own);
  return static_cast<Slot>(-1 - (found - begin - (found < own ? 0 : own_end - own)));
}

void Assembly::set_slots(const Graph& graph, const Graph& local) {
  for (PetscInt own = 0; own < owned_; ++own) diagonal_.push_back(slot(graph, own, first_ + own));
  const mfem::Table& cells = space_.GetElementToDofTable();
  cell_start_.assign(1, 0);
  for (int cell = 0; cell < cells.Size(); ++cell)
    cell_start_.push_back(cell_start_.back() + std::size_t(cells.RowSize(cell)) * cells.RowSize(cell));
  slots_.reserve(cell_start_.back());
  for (int cell = 0; cell < cells.Size(); ++cell) {
    const int n = cells.RowSize(cell);
    const int* nodes = cells.GetRow(cell);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const int row = nodes[a], column = nodes[b];
        if (is_fixed(row) || is_fixed(column))
          slots_.push_back(absent);
        else if (is_owned(row))
          slots_.push_back(slot(graph, own_[row], global_[column]));
        else
          slots_.push_back(static_cast<Slot>(std::lower_bound(local.begin(row), local.end(row), global_[column]) -
                                             local.begin(row)));
      }
  }
}

void Assembly::begin() {
  PetscScalar* values;
  check(MatZeroEntries(K_));
  check(MatSeqAIJGetArray(own_part_, &values));
  own_values_ = values;
  if (other_part_) {
    check(MatSeqAIJGetArray(other_part_, &values));
    other_values_ = values;
  }
  std::fill(stash_.begin(), stash_.end(), 0.0);
}

/// The cell matrix, or a copy of it with zeros in the rows and columns of constrained dofs.
const double* Assembly::without_constrained(const int* nodes, int count, const double* K) {
  const int c = components_, n = c * count;
  const auto constrained = [&](int dof) { return constrained_[c * nodes[dof % count] + dof / count] != 0; };
  bool any = false;
  for (int dof = 0; dof < n && !any; ++dof) any = constrained(dof);
  if (!any) return K;
  scratch_.assign(K, K + std::size_t(n) * n);
  for (int dof = 0; dof < n; ++dof) {
    if (!constrained(dof)) continue;
    for (int other = 0; other < n; ++other) scratch_[dof * n + other] = scratch_[other * n + dof] = 0;
  }
  return scratch_.data();
}

/// Where the row of a local node begins: in the matrix, or in the stash.
Assembly::Row Assembly::row_of(int node) {
  const int c = components_, block = c * c;
  if (!is_owned(node)) return {&stash_[block * stash_start_[node]], nullptr, c, 0, block};
  const PetscInt own = own_[node];
  return {own_values_ + std::size_t(block) * own_start_[own], other_values_ + std::size_t(block) * other_start_[own],
          c * (own_start_[own + 1] - own_start_[own]), c * (other_start_[own + 1] - other_start_[own]), c};
}

void Assembly::add(int cell, const double* K) {
  const mfem::Table& cells = space_.GetElementToDofTable();
  const int count = cells.RowSize(cell), c = components_;
  const double* values = without_constrained(cells.GetRow(cell), count, K);
  for (int a = 0; a < count; ++a) {
    const Row row = row_of(cells.GetRow(cell)[a]);
    const Slot* slots = &slots_[cell_start_[cell] + std::size_t(a) * count];
    for (int i = 0; i < c; ++i) {
      const double* from = values + std::size_t(i * count + a) * c * count;
      for (int b = 0; b < count; ++b) {
        if (slots[b] == absent) continue;
        double* to = row.block(slots[b], i);
        for (int k = 0; k < c; ++k) to[k] += from[k * count + b];
      }
    }
  }
}

/// Adds what other ranks' cells gave to this rank's rows.
void Assembly::add_received() {
  const int c = components_;
  for (std::size_t r = 0; r < received_targets_.size(); ++r) {
    const Target& target = received_targets_[r];
    const Row row = row_of(local_node_[target.node]);
    for (int i = 0; i < c; ++i) {
      double* to = row.block(target.slot, i);
      for (int k = 0; k < c; ++k) to[k] += received_[(r * c + i) * c + k];
    }
  }
}

/// Unit rows of constrained dofs.
void Assembly::set_unit_rows() {
  for (PetscInt own = 0; own < owned_; ++own) {
    const int node = local_node_[own];
    for (int i = 0; i < components_; ++i)
      if (constrained_[components_ * node + i]) row_of(node).block(diagonal_[own], i)[i] = 1;
  }
}

void Assembly::end() {
  exchange_->begin(stash_.data(), received_.data(), components_ * components_);
  exchange_->end();
  add_received();
  set_unit_rows();
  check(MatSeqAIJRestoreArray(own_part_, &own_values_));
  if (other_part_) check(MatSeqAIJRestoreArray(other_part_, &other_values_));
  check(MatAssemblyBegin(K_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(K_, MAT_FINAL_ASSEMBLY));
}

std::size_t Assembly::bytes() const {
  const auto size = [](const auto&... list) { return ((list.capacity() * sizeof(list[0])) + ...); };
  return size(constrained_, own_, global_, local_node_, cell_start_, slots_, diagonal_, own_start_, other_start_,
              stash_order_, stash_start_, received_targets_, stash_, received_, scratch_);
}

}  // namespace titin
