/// Polynomials nearest to values at quadrature points, around each vertex of some cells, and their blend.
///
///   p_v = argmin sum over cells around v of int |p - P|^2 dV,   P*(X) = sum_v N_v(X) p_v(X)
///
/// All that cells give to a vertex are sums (moments of monomials about it), so that ranks add them up as they add
/// forces: no cell of another rank is asked for.
#pragma once

#include <array>
#include <mfem.hpp>
#include <vector>

#include "fe/cell_tables.hpp"
#include "math/tensor.hpp"

namespace titin {

/// Where the quadrature points and vertices of this rank's cells are, undeformed.
class CellPoints {
 public:
  CellPoints(mfem::ParMesh& mesh, const CellTables& tables);
  CellPoints(const CellPoints&) = delete;  // the space points to the collection

  const CellTables& tables() const { return tables_; }
  int count() const { return static_cast<int>(place_.size()); }
  int first(int cell) const { return first_[cell]; }  ///< of the cell's points
  double volume(int cell) const;                      ///< [m^3]
  int vertices() const { return space_.GetVSize(); }  ///< of this rank
  int corners(int cell) const { return space_.GetFE(cell)->GetDof(); }
  void vertices_of(int cell, mfem::Array<int>& vertices) const { space_.GetElementDofs(cell, vertices); }
  /// N_v of all corners at a point of the rule.
  void shape(int cell, int q, mfem::Vector& N) const;
  mfem::DenseMatrix gradients(int cell, int q) const;  ///< [corner][component]
  /// From corner to point [m].
  Vec3 offset(int cell, int q, int corner) const;
  /// Sums over the cells of all ranks from those of this one: [component][vertex]. Collective.
  void sum_over_ranks(std::vector<double>& values) const;

 private:
  const CellTables& tables_;
  mfem::H1_FECollection collection_;  // linear: its dofs are the vertices
  mutable mfem::ParFiniteElementSpace space_;
  std::vector<int> first_, first_corner_;
  std::vector<Vec3> place_, corner_;
};

class PatchFit {
 public:
  /// Around the vertices of these cells of this rank. Collective.
  PatchFit(const CellPoints& points, std::vector<int> cells, int degree);

  /// Of values at all points. Collective.
  void update(const std::vector<Mat3>& values);
  const std::vector<int>& cells() const { return cells_; }
  Mat3 at(int cell, int q) const;  ///< P*

 private:
  int terms() const { return static_cast<int>(monomial_.size()); }
  void factorise();
  void find_inner();
  void solve(int vertex, double* b, int stride) const;
  void take_monomials(const Vec3& X, double* m) const;
  /// visit(vertex, point, weight, monomials)
  template <class Visit>
  void for_each_pair(Visit visit) const;

  const CellPoints& points_;
  std::vector<int> cells_;
  std::vector<std::array<int, 3>> monomial_;
  std::vector<double> factor_;       // [vertex][row][column <= row]: L of Cholesky's decomposition, scaled
  std::vector<double> scale_;        // [vertex][row]
  std::vector<char> inner_;          // vertices around which there is nothing but these cells
  std::vector<double> polynomials_;  // [monomial][tensor component][vertex]
};

}  // namespace titin
