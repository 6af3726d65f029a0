#include "fe/muscle_config.hpp"

#include <fmt/format.h>

#include "base/log.hpp"
#include "base/words.hpp"
#include "fe/cell_tables.hpp"

namespace titin {

namespace {

constexpr int max_order = 3;
constexpr int max_points = 8;

void bind_formulation(Section s, MuscleConfig& c) {
  s.choose("inertia", c.inertia, {{"dynamic", Inertia::dynamic}, {"quasi-static", Inertia::quasi_static}},
           {.doc = "quasi-static: no inertia, and the rate of the fibres is taken as zero"});
  s.read("order", c.order,
         {.range = {.min = 1, .max = max_order},
          .doc = "k of Q_k displacement with P_(k-1) discontinuous pressure and dilatation"});
  s.read("quadrature", c.quadrature,
         {.range = {.min = 0, .max = max_points}, .doc = "Gauss points per direction; 0 takes order + 1, the least"});
  if (c.quadrature > 0 && c.quadrature <= c.order)
    s.error("quadrature",
            fmt::format("{} a direction leave motions of order {} without force", count(c.quadrature, "Gauss point"),
                        c.order),
            fmt::format("take at least {}", c.order + 1));
  s.choose("fibre_rate", c.fibre_rate,
           {{"stretch_difference", FibreRate::stretch_difference}, {"velocity_gradient", FibreRate::velocity_gradient}},
           {.doc = "rate of the fibre's stretch in a step: from its two ends (symmetric tangent), or from the velocity "
                   "gradient"});
  s.read("ellipticity", c.ellipticity,
         {.doc = "find the smallest Legendre-Hadamard value of each cell after every step, write it as a field and in "
                 "history.csv, and warn when it becomes negative"});
  s.read("pennation_axis", c.pennation_axis, {.doc = "direction that pennation angles are measured from"});
  if (!(norm(c.pennation_axis) > 0))
    s.error("pennation_axis", "a direction of length zero", "give the line of action, e.g. [1, 0, 0]");
}

}  // namespace

void MuscleConfig::bind(Section& root, const NamedMesh& mesh) {
  bind_formulation(root.section("muscle", "the implicit three-field finite element formulation"), *this);
  bind_materials(root, mesh);
  root.each("boundary", "what happens at a boundary of the mesh; one that is not named is free",
            [&](const std::string& name, Section s) {
              BoundaryConfig boundary;
              boundary.name = name;
              boundary.bind(s, mesh);
              boundaries.push_back(boundary);
            });
  Section body = root.section("body", "forces per mass on everything");
  body.read("acceleration", body_acceleration, {.unit = "m/s^2", .doc = "body force per mass, e.g. gravity"});
  body.read("scale", body_scale, {.doc = "factor of the acceleration, constant or in time"});
  markers = read_markers(root, mesh);
  averages = read_averages(root, mesh);
  for (const AverageConfig& average : averages)
    if (materials.count(average.name))
      root.section("averages").error(average.name, "a material has this name, and means under it", "choose another");
  Section solver = root.section("solver", "Newton's method and the linear solver");
  newton.bind(solver);
}

void MuscleConfig::bind_materials(Section& root, const NamedMesh& mesh) {
  bool regions_are_right = true;
  root.each("materials", "one material, of one or more regions", [&](const std::string& name, Section s) {
    std::vector<std::string> regions;
    s.read("regions", regions, {.doc = "regions of the mesh that are made of it (default: all)"});
    materials[name] = Material::read(s);
    if (!s.describing() && !materials[name]->has_volumetric_law())
      logging::warning(
          fmt::format("{}: without a volumetric law the elements' pressure stays 0: displacements alone carry "
                      "the volume, and a material that is hard to compress locks",
                      s.path()));
    if (!s.describing() && mesh.mesh) regions_are_right &= take_regions(name, regions, s, mesh);
  });
  if (root.describing() || !mesh.mesh || !regions_are_right) return;
  if (materials.empty()) root.error("materials", "no material", "add a table [materials.NAME]");
  for (const auto& [region, attribute] : mesh.regions)
    if (!materials.empty() && !material_of_region.count(attribute))
      root.error("materials", fmt::format("region {} has no material", in_quotes(region)),
                 "name it in the regions of one");
  std::map<int, std::shared_ptr<const Material>> of_attribute;
  for (const auto& [region, attribute] : mesh.regions) {
    if (!material_of_region.count(attribute)) return;
    of_attribute[attribute] = materials.at(material_of_region.at(attribute));
  }
  point_fields = PointFields(*mesh.mesh, of_attribute, cell_rule(points()));
}

/// Returns false when it reported one.
bool MuscleConfig::take_regions(const std::string& material, std::vector<std::string> regions, Section& s,
                                const NamedMesh& mesh) {
  bool right = true;
  const auto wrong = [&](const std::string& problem, const std::string& advice) {
    s.error(s.has("regions") ? "regions" : "", problem, advice);
    right = false;
  };
  if (regions.empty() && s.has("regions")) wrong("names no region", "the mesh has: " + names_of(mesh.regions));
  if (regions.empty() && right)
    for (const auto& [region, attribute] : mesh.regions) regions.push_back(region);
  for (const auto& region : regions) {
    const auto found = mesh.regions.find(region);
    if (found == mesh.regions.end())
      wrong(fmt::format("the mesh has no region {}", in_quotes(region)), "it has: " + names_of(mesh.regions));
    else if (const auto [made, is_new] = material_of_region.emplace(found->second, material); !is_new)
      wrong(fmt::format("region {} is made of {} already", in_quotes(region), in_quotes(made->second)),
            "give each material its own regions");
  }
  return right;
}

}  // namespace titin
