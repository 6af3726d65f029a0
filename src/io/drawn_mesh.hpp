/// A rank's mesh and fields as VTK draws them: points, cells whose curved shape their points carry (Lagrange cells),
/// and numbers at both.
///
/// Points are shared between cells. A field that is constant in each cell becomes a number of the cell. What else may
/// jump between cells is written by one of three rules.
#pragma once

#include <cstdint>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "solve/model.hpp"

namespace titin {

enum class Jumps {
  nodes,  ///< at each node the mean of the cells of one region around it; regions do not share points
  means,  ///< in each cell its mean
  kept    ///< as they are: no point is shared, which takes up to eight times the space
};

/// Numbers at points or cells, `components` each: 1, 3, or 6 of a symmetric tensor (xx, yy, zz, xy, yz, xz).
struct DrawnArray {
  std::string name, unit;
  int components = 1;
  std::vector<double> values;
};

class DrawnMesh {
 public:
  /// Mesh and fields stay the caller's. Collective.
  DrawnMesh(mfem::ParMesh& mesh, const std::vector<Field>& fields, Jumps jumps);

  std::size_t points() const { return points_; }
  std::size_t cells() const { return types_.size(); }
  const std::vector<std::int64_t>& connectivity() const { return connectivity_; }
  const std::vector<std::int64_t>& offsets() const { return offsets_; }  ///< where each cell ends in it
  const std::vector<std::uint8_t>& types() const { return types_; }      ///< VTK's

  // As mesh and fields are now. Collective.
  std::vector<double> positions();  ///< [points][3]
  std::vector<DrawnArray> at_points();
  std::vector<DrawnArray> at_cells();  ///< besides the fields: the number of the region, and the rank

 private:
  struct Shape {  // by geometry
    std::vector<int> node_of_vtk;
    std::uint8_t type = 0;
  };
  const Shape& shape(int cell);
  void number_points();
  int point(int cell, int node) const { return point_of_[first_[cell] + node]; }
  int nodes(int cell) const { return first_[cell + 1] - first_[cell]; }
  bool is_constant(const Field& field) const;
  bool is_continuous(const Field& field) const;
  bool is_at_points(const Field& field) const;
  mfem::DenseMatrix node_values(const Field& field, int cell) const;  // [node][component]
  DrawnArray averaged(const Field& field);
  DrawnArray mean(const Field& field) const;

  mfem::ParMesh& mesh_;
  std::vector<Field> fields_;
  Jumps jumps_;
  mfem::H1_FECollection collection_;
  mfem::ParFiniteElementSpace space_;  // its dofs are the points, before regions part them
  std::vector<int> region_;            // [cell] 0, 1, ... if regions do not share points, else 0
  int regions_ = 1;
  std::vector<Shape> shapes_;
  std::vector<int> first_, point_of_;  // of a cell: where its nodes are in point_of_
  std::size_t points_ = 0;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::vector<std::uint8_t> types_;
};

}  // namespace titin
