/// The matrix of a run, assembled from cell matrices straight into PETSc's arrays.
///
/// An AIJ matrix whose rows hold one block (components x components) for each pair of nodes that share a cell. The
/// pattern is made once. For every pair of nodes of a cell it is known where their block lies in its row, so that
/// adding a cell matrix is additions to known places: no search, no copy of the cell matrices. Rows of other ranks
/// gather in a stash, whose blocks travel in an order agreed on once.
///
/// Constrained dofs have a unit row and column. A node of which all components are constrained has its diagonal block
/// only; the others keep whole blocks with zeros, so that the matrix stays one of blocks.
///
/// Memory besides the matrix: two bytes for each pair of nodes of each cell (Q2 hexahedra: 1.5 kB a cell, where the
/// cell matrix has 52 kB), and the stash.
#pragma once

#include <cstdint>
#include <memory>
#include <mfem.hpp>
#include <vector>

#include "base/exchange.hpp"
#include "solve/petsc.hpp"

namespace titin {

class Assembly {
 public:
  /// `space` byVDIM, conforming; `constrained` marks local (not true) dofs, on every rank that sees them. Collective.
  Assembly(const mfem::ParFiniteElementSpace& space, std::vector<char> constrained);
  ~Assembly();
  Assembly(const Assembly&) = delete;

  Mat matrix() const { return K_; }  ///< the same object, with the same pattern, for the whole run

  /// Sets the matrix to zero. Then add() each cell of this rank, then end(). Collective, as end() is.
  void begin();
  /// K [components][nodes] x [components][nodes] of the cell, row-major, dofs in MFEM's order.
  void add(int cell, const double* K);
  void end();

  /// What this object keeps on this rank [bytes], without the matrix.
  std::size_t bytes() const;

 private:
  struct Graph;
  /// A block in its row: i of the part with own columns, -1 - i of the other; or absent.
  using Slot = std::int16_t;
  /// Where the first component's row of a node begins. The next component's is `stride` numbers on; in the stash, of
  /// which whole blocks travel, blocks are `step` numbers apart.
  struct Row {
    double *own, *other;
    PetscInt own_stride, other_stride, step;
    double* block(Slot slot, int i) const {
      return slot >= 0 ? own + i * own_stride + step * slot : other + i * other_stride - step * (slot + 1);
    }
  };
  struct Target {
    int node;  // of this rank
    Slot slot;
  };

  void number_nodes();
  Graph local_graph() const;
  std::vector<Exchange::Part> order_stash(const Graph& local);
  Graph agreed_graph(const Graph& local);
  void create_matrix(const Graph& graph);
  void set_slots(const Graph& graph, const Graph& local);
  Slot slot(const Graph& graph, int node, PetscInt column) const;
  const double* without_constrained(const int* nodes, int count, const double* K);
  Row row_of(int node);
  void add_received();
  void set_unit_rows();
  bool is_fixed(int node) const;
  bool is_owned(int node) const { return own_[node] >= 0; }

  const mfem::ParFiniteElementSpace& space_;
  int components_;
  std::vector<char> constrained_;       // [local dof]
  std::vector<PetscInt> own_, global_;  // [local node]: its number among those of this rank, or -1; among all
  std::vector<int> local_node_;         // [node of this rank]
  PetscInt first_ = 0, owned_ = 0;      // nodes of this rank: global numbers first_ ... first_ + owned_ - 1
  std::vector<std::size_t> cell_start_;
  std::vector<Slot> slots_;                        // [cell][node a][node b]
  std::vector<Slot> diagonal_;                     // [node of this rank]
  std::vector<PetscInt> own_start_, other_start_;  // [node of this rank + 1]: blocks before its row in the two parts
  std::vector<int> stash_order_;                   // nodes of other ranks, by rank and number
  std::vector<std::size_t> stash_start_;           // [local node]: blocks before its row in the stash
  std::vector<Target> received_targets_;
  std::unique_ptr<Exchange> exchange_;
  std::vector<double> stash_, received_, scratch_;
  Mat K_ = nullptr, own_part_ = nullptr, other_part_ = nullptr;  // the parts belong to K_
  PetscScalar *own_values_ = nullptr, *other_values_ = nullptr;  // between begin and end
};

}  // namespace titin
