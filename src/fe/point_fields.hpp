/// What of the materials varies in space, at the quadrature points of this rank's cells: parameters of laws, directions
/// of fibres. Evaluated once, when the scene is read: points keep their place in the undeformed body.
#pragma once

#include <map>
#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/cell_element.hpp"
#include "materials/material.hpp"

namespace titin {

class PointFields {
 public:
  PointFields() = default;
  /// `materials` by mesh attribute; quadrature as CellElements::rule has it. A field that does not reach a point, or
  /// has no allowed value there, is reported where the scene names it. Collective.
  PointFields(mfem::ParMesh& mesh, const std::map<int, std::shared_ptr<const Material>>& materials,
              const CellElements& elements, int points);

  /// Sets what varies at the cell's points; the rest stays as it is.
  void set(int cell, PointInput& in) const;

 private:
  struct Cell {
    std::vector<double> numbers;  // [points][fields]
    std::vector<Vec3> fibre, second_fibre;
  };
  struct Filling;
  std::vector<int> index_;  // [cell]: in cells_, or -1
  std::vector<Cell> cells_;
};

}  // namespace titin
