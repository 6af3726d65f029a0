#include "mesh/box_shape.hpp"

#include <cmath>
#include <numbers>

namespace titin {

void BoxShape::bind(Section& s) {
  s.read("origin", origin, {.unit = "m", .doc = "where the corner of least coordinates lies"});
  s.read(
      "inner_radius", inner_radius,
      {.unit = "m",
       .range = non_negative,
       .doc = "bends the box: x becomes the distance from the axis or the centre beyond this one, y (of a sphere also "
              "z) the length of the arc at this one; x- is then the inner side, y- lies in the plane y = 0"});
  s.choose("bend", bend, {{"cylinder", Bend::cylinder}, {"sphere", Bend::sphere}},
           {.doc = "about the z axis, or about the origin: y and z then run between planes through it"});
  s.read("skew", skew,
         {.unit = "m",
          .doc = "bends the planes of nodes across x: x grows by skew (1 - y / b) sin(pi x / a), a and b the edges of "
                 "the box (Saltzman's mesh)"});
  s.read("ripple", ripple,
         {.unit = "m",
          .doc = "half a wave on the plane of nodes at ripple_at: x grows by ripple cos(pi y / b), b the edge of the "
                 "box along y, linearly less towards both ends of the box"});
  s.read("ripple_at", ripple_at, {.unit = "m", .range = non_negative, .doc = "where along x the ripple is largest"});
}

void BoxShape::apply(mfem::ParMesh& mesh) const {
  mfem::Vector lower, upper;
  mesh.GetBoundingBox(lower, upper);
  for (int v = 0; v < mesh.GetNV(); ++v) {
    double* x = mesh.GetVertex(v);
    const double along_x = x[0], end = upper(0);
    x[0] += skew * (1 - x[1] / upper(1)) * std::sin(std::numbers::pi * along_x / end);
    if (ripple != 0) {
      const double part = along_x < ripple_at ? along_x / ripple_at : (end - along_x) / (end - ripple_at);
      x[0] += ripple * part * std::cos(std::numbers::pi * x[1] / upper(1));
    }
    if (inner_radius > 0) {
      const double radius = inner_radius + x[0], angle = x[1] / inner_radius;
      if (bend == Bend::sphere) {
        const bool plane = mesh.Dimension() == 2;
        const double y = std::tan(angle), z = plane ? 0 : std::tan(x[2] / inner_radius);
        const double along = radius / std::sqrt(1 + y * y + z * z);
        x[0] = along;
        x[1] = along * y;
        if (!plane) x[2] = along * z;
      } else {
        x[0] = radius * std::cos(angle);
        x[1] = radius * std::sin(angle);
      }
    }
    for (int i = 0; i < mesh.Dimension(); ++i) x[i] += origin[i];
  }
}

}  // namespace titin
