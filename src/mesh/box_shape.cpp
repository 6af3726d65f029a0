#include "mesh/box_shape.hpp"

#include <cmath>
#include <numbers>

namespace titin {

void BoxShape::bind(Section& s) {
  s.read("origin", origin, {.unit = "m", .doc = "where the corner of least coordinates lies"});
  s.read("inner_radius", inner_radius,
         {.unit = "m",
          .range = non_negative,
          .doc = "bends the box about the z axis: x becomes the distance from it beyond this one, y the length of the "
                 "arc at this one; x- is then the inner side, y- lies in the plane y = 0"});
  s.read("skew", skew,
         {.unit = "m",
          .doc = "bends the planes of nodes across x: x grows by skew (1 - y / b) sin(pi x / a), a and b the edges of "
                 "the box (Saltzman's mesh)"});
}

void BoxShape::apply(mfem::ParMesh& mesh) const {
  mfem::Vector lower, upper;
  mesh.GetBoundingBox(lower, upper);
  for (int v = 0; v < mesh.GetNV(); ++v) {
    double* x = mesh.GetVertex(v);
    x[0] += skew * (1 - x[1] / upper(1)) * std::sin(std::numbers::pi * x[0] / upper(0));
    if (inner_radius > 0) {
      const double radius = inner_radius + x[0], angle = x[1] / inner_radius;
      x[0] = radius * std::cos(angle);
      x[1] = radius * std::sin(angle);
    }
    for (int i = 0; i < mesh.Dimension(); ++i) x[i] += origin[i];
  }
}

}  // namespace titin
