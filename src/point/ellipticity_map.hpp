/// Where a material loses ellipticity: the smallest Legendre-Hadamard value over a box of stretch and activation
/// (materials/ellipticity.hpp), and the band of shear that it belongs to.
#pragma once

#include <array>

#include "base/config.hpp"
#include "point/experiment.hpp"

namespace titin {

struct PointText;

/// [point.map] of a scene.
struct MapConfig {
  std::array<double, 2> stretch{0.5, 1.7}, activation{0, 1};  ///< from, to
  std::array<int, 2> points{61, 41};
  void bind(Section& s);
};

/// The deformations are those that the loading has in an incompressible point (a pressure does not change the value);
/// the activation of every active term is that of the map, rates are left out. Columns: stretch, activation, value,
/// unit normal of the band in the reference configuration, unit direction of its motion, angle between normal and
/// fibre.
CurveTable ellipticity_map(const PointText& text);

}  // namespace titin
