/// What the point driver is asked to do: a material and a loading, from a scene file or from laws named on the command
/// line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "materials/material.hpp"
#include "point/ellipticity_map.hpp"
#include "point/loading.hpp"

namespace titin {

/// A scene's text with its overrides, before it is read.
struct PointText {
  std::string text, file;
  std::vector<std::string> overrides;
  Config config() const { return Config(text, file, overrides); }
};

/// The file FILE, whose tables [materials.NAME] are those of any scene and whose [point] says what is done.
/// Overrides whose first word is a key of [point] may leave "point." away.
PointText point_text_of_file(const std::string& file, const std::vector<std::string>& overrides);
/// A material called "material" with a term for each law. Overrides name a key of a law ("mu=10 kPa";
/// "hill_active.curve=..." where two laws share it), of the material ("fibre=[1, 0, 0]") or of [point]. Without a
/// volumetric law the point is incompressible.
PointText point_text_of_laws(const std::vector<std::string>& laws, const std::vector<std::string>& overrides);

/// A map needs no drive.
enum class PointTask { experiment, map };

struct PointScene {
  std::string material_name;
  std::shared_ptr<const Material> material;
  LoadingConfig loading;
  MapConfig map;
  std::vector<KeyRecord> keys;  ///< all that were asked for

  static PointScene read(const PointText& text, PointTask task = PointTask::experiment);
};

std::vector<KeyRecord> point_keys();

}  // namespace titin
