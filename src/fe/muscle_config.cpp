#include "fe/muscle_config.hpp"

#include <fmt/format.h>

#include "base/log.hpp"
#include "base/words.hpp"
#include "mesh/named_parts.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {

namespace {

constexpr int max_order = 3;
constexpr int max_points = 8;

void bind_formulation(Section s, MuscleConfig& c, const NamedMesh& mesh) {
  s.choose("inertia", c.inertia, {{"dynamic", Inertia::dynamic}, {"quasi-static", Inertia::quasi_static}},
           {.doc = "quasi-static: no inertia, and the rate of the fibres is taken as zero"});
  s.choose("element", c.formulation,
           {{"three_field", Formulation::three_field}, {"displacement", Formulation::displacement}},
           {.doc = "displacement with discontinuous pressure and dilatation, or alone: cheaper, but it locks where the "
                   "volume hardly changes"});
  s.read("order", c.order,
         {.range = {.min = 1, .max = max_order},
          .doc = "k: the displacement's error falls as h^(k+1), the pressure's as h^k; simplices have k = 1, 2, wedges "
                 "2 (but of the accuracy of 1)"});
  s.read("quadrature", c.quadrature,
         {.range = {.min = 0, .max = max_points},
          .doc = "Gauss points per direction, of simplices a rule of degree 2 (n - 1) or what their element needs; 0 "
                 "takes order + 1, the least"});
  if (mesh.mesh && c.order >= 1 && c.order <= max_order) {
    c.elements = CellElements(c.formulation, c.order, *mesh.mesh);
    if (!c.elements.problem().empty()) s.error("order", c.elements.problem(), c.elements.advice());
  }
  if (c.quadrature > 0 && c.quadrature <= c.order)
    s.error("quadrature",
            fmt::format("{} a direction leave motions of order {} without force", count(c.quadrature, "Gauss point"),
                        c.order),
            fmt::format("take at least {}", c.order + 1));
  s.choose("fibre_rate", c.fibre_rate,
           {{"stretch_difference", FibreRate::stretch_difference}, {"velocity_gradient", FibreRate::velocity_gradient}},
           {.doc = "rate of the fibre's stretch in a step: from its two ends (symmetric tangent), or from the velocity "
                   "gradient"});
  s.read(
      "error_estimate", c.error_estimate,
      {.doc = "estimate after each step how far the stress is off because cells are not smaller: field stress_error, "
              "columns stress_error and stress_error_relative"});
  s.read("ellipticity", c.ellipticity,
         {.doc = "find the smallest Legendre-Hadamard value of each cell after every step, write it as a field and in "
                 "history.csv, and warn when it becomes negative"});
  s.read("pennation_axis", c.pennation_axis, {.doc = "direction that pennation angles are measured from"});
  if (!(norm(c.pennation_axis) > 0))
    s.error("pennation_axis", "a direction of length zero", "give the line of action, e.g. [1, 0, 0]");
}

}  // namespace

void MuscleConfig::bind(Section& root, const NamedMesh& mesh) {
  bind_formulation(root.section("muscle", "the implicit finite element formulation"), *this, mesh);
  bind_materials(root, mesh);
  root.each("boundary", "what happens at a boundary of the mesh; one that is not named is free",
            [&](const std::string& name, Section s) {
              BoundaryConfig boundary;
              boundary.name = name;
              boundary.bind(s, mesh);
              boundaries.push_back(boundary);
            });
  Section initial = root.section("initial", "the motion at the start: that of a rigid body");
  this->initial.bind(initial, mesh);
  Section time = root.section("time");
  integrator.bind(time);
  if (inertia == Inertia::quasi_static && time.has("scheme"))
    time.error("scheme", "nothing moves by inertia here", "drop it, or set muscle.inertia = \"dynamic\"");
  for (const BoundaryConfig& boundary : boundaries)
    if (integrator.scheme == Scheme::energy_momentum && boundary.support.wall.gap_tolerance > 0)
      time.error("scheme",
                 fmt::format("walls are met in the middle of its steps, not within gap_tolerance at their end ({})",
                             boundary.name),
                 "take another scheme, or drop gap_tolerance");
  Section body = root.section("body", "forces per mass on everything");
  read_vector(body, "acceleration", body_acceleration, {.unit = "m/s^2", .doc = "body force per mass, e.g. gravity"},
              mesh);
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
  RegionMaterials regions;
  root.each("materials", "one material, of one or more regions", [&](const std::string& name, Section s) {
    regions.read(s, name, mesh);
    materials[name] = Material::read(s);
    if (!s.describing() && !materials[name]->has_volumetric_law())
      logging::warning(
          fmt::format("{}: without a volumetric law the elements' pressure stays 0: displacements alone carry "
                      "the volume, and a material that is hard to compress locks",
                      s.path()));
  });
  regions.finish(root, mesh);
  material_of_region = regions.by_attribute();
  if (root.describing() || !mesh.mesh || !elements.problem().empty()) return;
  std::map<int, std::shared_ptr<const Material>> of_attribute;
  for (const auto& [region, attribute] : mesh.regions) {
    if (!material_of_region.count(attribute)) return;
    of_attribute[attribute] = materials.at(material_of_region.at(attribute));
  }
  point_fields = PointFields(*mesh.mesh, of_attribute, elements, points());
}

}  // namespace titin
