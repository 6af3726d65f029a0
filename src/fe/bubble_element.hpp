/// Simplices with bubbles: P1 or P2 and, for each face or cell that has one, the product of its barycentric
/// coordinates.
///
/// In barycentric coordinates l_i the space is spanned by the products of l_i over the corners of some of the
/// sub-simplices: its vertices give P1, its edges the rest of P2, its faces the cubic bubbles of a tetrahedron (or of a
/// triangle itself), its inside the quartic one. Nodes are the centres of those sub-simplices and the basis is nodal,
/// so a constant on a face is the same constant at all its nodes. Crouzeix, Raviart 1973, RAIRO 7:33; in three
/// dimensions Ern, Guermond 2004, Theory and Practice of Finite Elements, section 4.2.
///
/// MFEM 4.6 has no such elements.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <vector>

namespace titin {

/// Which sub-simplices carry a function, by their dimension: vertices always do.
struct BubbleSet {
  bool edges = false, faces = false, cells = false;
  bool has(int dimension) const { return dimension == 0 || (dimension == 1 ? edges : dimension == 2 ? faces : cells); }
};

class BubbleElement : public mfem::NodalFiniteElement {
 public:
  /// `geometry` is a segment, triangle or tetrahedron; faces and cells count by their dimension: 2 and 3.
  BubbleElement(mfem::Geometry::Type geometry, BubbleSet bubbles);
  void CalcShape(const mfem::IntegrationPoint& point, mfem::Vector& shape) const override;
  void CalcDShape(const mfem::IntegrationPoint& point, mfem::DenseMatrix& slope) const override;

 private:
  using Corners = std::vector<int>;
  static std::vector<Corners> functions(mfem::Geometry::Type geometry, BubbleSet bubbles);
  double product(const Corners& corners, const double* l, int without = -1) const;

  std::vector<Corners> functions_;  // of each: the corners whose barycentric coordinates it multiplies
  mfem::DenseMatrix to_nodal_;      // nodal basis = to_nodal_ * products
};

/// Continuous spaces of BubbleElements; other geometries take H1 elements of the order that fits at shared edges.
class BubbleCollection : public mfem::FiniteElementCollection {
 public:
  BubbleCollection(int dimension, BubbleSet bubbles);
  const mfem::FiniteElement* FiniteElementForGeometry(mfem::Geometry::Type geometry) const override;
  int DofForGeometry(mfem::Geometry::Type geometry) const override;
  const int* DofOrderForOrientation(mfem::Geometry::Type geometry, int orientation) const override;
  const char* Name() const override { return "Bubbles"; }
  int GetContType() const override { return CONTINUOUS; }

 private:
  BubbleSet bubbles_;
  mfem::H1_FECollection rest_;
  std::unique_ptr<BubbleElement> triangle_, tetrahedron_;
};

}  // namespace titin
