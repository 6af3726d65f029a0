#include "point/ellipticity_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/ellipticity.hpp"
#include "point/point_scene.hpp"

namespace titin {
namespace {

double at(const std::array<double, 2>& range, int k, int points) {
  return points == 1 ? range[1] : range[0] + (range[1] - range[0]) * k / (points - 1);
}

Mat3 diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

/// det F = 1, driven to x.
Mat3 deformation(const LoadingConfig& loading, double x) {
  if (loading.loading == Loading::equibiaxial) return diagonal(x, x, 1 / (x * x));
  if (loading.loading == Loading::planar) return diagonal(x, 1, 1 / x);
  if (loading.loading == Loading::biaxial) {
    const double y = 1 + loading.ratio * (x - 1);
    return diagonal(x, y, 1 / (x * y));
  }
  if (loading.loading != Loading::simple_shear) return diagonal(x, 1 / std::sqrt(x), 1 / std::sqrt(x));
  Mat3 F = identity;
  F[loading.plane] = x;
  return F;
}

/// The same text, its active terms as active as the time in seconds says.
PointText activated_by_time(PointText text, const std::vector<KeyRecord>& keys, const std::string& material) {
  for (const KeyRecord& key : keys)
    if (key.path.starts_with(fmt::format("materials.{}.", material)) && key.path.ends_with(".activation"))
      text.overrides.push_back(key.path + "={ time = \"0, 1 s\", value = [0, 1] }");
  return text;
}

std::vector<double> row_of(const Material& material, const Mat3& F, double stretch, double activation) {
  PointInput in;
  in.n = 1;
  in.F = in.F_old = &F;
  in.time = activation;
  AcousticValue found;
  legendre_hadamard(material, in, &found);
  if (dot(found.normal, material.fibre()) < 0)  // either sign is the same band
    for (int i = 0; i < 3; ++i) found.normal[i] *= -1, found.motion[i] *= -1;
  std::vector<double> row{stretch, activation, found.value};
  row.insert(row.end(), found.normal.begin(), found.normal.end());
  row.insert(row.end(), found.motion.begin(), found.motion.end());
  const double cosine = std::min(1.0, dot(found.normal, material.fibre()));
  if (material.has_fibres()) row.push_back(std::acos(cosine) * 180 / std::numbers::pi);
  return row;
}

}  // namespace

void MapConfig::bind(Section& s) {
  const auto range = [&](const char* name, std::array<double, 2>& ends, Range allowed, const char* doc) {
    std::vector<double> list(ends.begin(), ends.end());
    s.read(name, list, {.range = allowed, .doc = doc, .size = 2});
    std::copy_n(list.begin(), 2, ends.begin());
  };
  range("stretch", stretch, any, "from and to, of what the loading drives");
  range("activation", activation, fraction, "from and to");
  s.read("stretch_points", points[0], {.range = {.min = 1}, .doc = "columns of the map"});
  s.read("activation_points", points[1], {.range = {.min = 1}, .doc = "rows of the map"});
}

CurveTable ellipticity_map(const PointText& text) {
  const PointScene given = PointScene::read(text, PointTask::map);
  const PointText by_time = activated_by_time(text, given.keys, given.material_name);
  const PointScene scene = PointScene::read(by_time, PointTask::map);
  const bool active = by_time.overrides.size() > text.overrides.size();
  CurveTable table;
  table.columns = {"stretch",  "activation", "legendre_hadamard [Pa]", "normal_x", "normal_y", "normal_z", "motion_x",
                   "motion_y", "motion_z"};
  if (scene.material->has_fibres()) table.columns.push_back("angle [degree]");
  const MapConfig& map = scene.map;
  const int rows = active ? map.points[1] : 1;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < map.points[0]; ++c) {
      const double stretch = at(map.stretch, c, map.points[0]), activation = active ? at(map.activation, r, rows) : 0;
      table.rows.push_back(row_of(*scene.material, deformation(scene.loading, stretch), stretch, activation));
    }
  return table;
}

}  // namespace titin
