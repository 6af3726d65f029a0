/// Which spaces a cell has by its geometry: displacement, pressure and dilatation, and the quadrature they need.
///
/// Three fields: pairs that are stable in the sense of Babuska and Brezzi but for Q1/P0 and (where cells are tensor
/// products) the well-known ones of high order; tests/stability/test_inf_sup.cpp measures them.
///
///   quadrilaterals, hexahedra   Q_k / P_(k-1), k = 1..3
///   triangles                   k = 1: P2 / P0,  k = 2: P2 + bubble / P1               (Crouzeix, Raviart 1973)
///   tetrahedra                  k = 1: P1 + face bubbles / P0,  k = 2: P2 + face and cell bubbles / P1
///   wedges                      k = 2: P2 x P2 / P0, of the accuracy of k = 1
///
/// Displacement alone: Q_k or P_k on all of them, k = 1..3, for compressible bodies.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/bubble_element.hpp"

namespace titin {

enum class Formulation { three_field, displacement };

struct CellElement {
  mfem::Geometry::Type geometry = mfem::Geometry::INVALID;
  int order = 1;             ///< k: errors of the displacement fall as h^(k+1), of the pressure as h^k
  int nodal_order = 1;       ///< of the H1 element without its bubbles: what is drawn
  int pressure_degree = -1;  ///< of the complete polynomials; -1: none
  BubbleSet bubbles;         ///< faces, cells
  int least_degree = 0;      ///< of quadrature that leaves no motion without stiffness, and none without mass
  bool has_bubbles() const { return bubbles.faces || bubbles.cells; }
};

/// The first rule of MFEM at this degree or above without negative weights, which would lose definiteness.
const mfem::IntegrationRule& positive_rule(mfem::Geometry::Type geometry, int degree);

class CellElements {
 public:
  /// Elements for all geometries of the mesh; where there are none problem() says so. Collective.
  CellElements(Formulation formulation, int order, const mfem::ParMesh& mesh);
  explicit CellElements(std::vector<CellElement> list) : list_(std::move(list)) {}
  CellElements() = default;

  const std::string& problem() const { return problem_; }  ///< "tetrahedra of order 3"; empty when all is well
  const std::string& advice() const { return advice_; }
  const CellElement& of(mfem::Geometry::Type geometry) const;
  const std::vector<CellElement>& list() const { return list_; }
  /// Continuous space of the displacement's components.
  std::unique_ptr<mfem::FiniteElementCollection> collection(int dimension) const;
  /// `points` per direction on tensor products; simplices and wedges take a rule exact to degree 2 (points - 1), or
  /// what their element needs.
  const mfem::IntegrationRule& rule(mfem::Geometry::Type geometry, int points) const;
  /// The same on a face of a cell.
  const mfem::IntegrationRule& face_rule(mfem::Geometry::Type face, mfem::Geometry::Type cell, int points) const;

 private:
  void check_that_they_fit();
  std::vector<CellElement> list_;
  std::string problem_, advice_;
};

}  // namespace titin
