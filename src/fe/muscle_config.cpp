#include "fe/muscle_config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/log.hpp"
#include "base/parallel.hpp"
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
           {{"stretch_difference", FibreRate::stretch_difference},
            {"velocity_gradient", FibreRate::velocity_gradient},
            {"velocity_gradient_symmetric", FibreRate::velocity_gradient_symmetric}},
           {.doc = "rate of the fibre's stretch in a step: from its two ends (symmetric tangent), or from the velocity "
                   "gradient, with the exact tangent or the symmetric one of the Flexodeal codes, which takes more "
                   "iterations"});
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

/// The component that a rail of one of the two and something in the other decide on; -1: none.
int shared_axis(const BoundaryConfig& a, const BoundaryConfig& b) {
  for (const auto& [one, other] : {std::pair{&a, &b}, {&b, &a}})
    if (const int axis = one->rail.axis; axis >= 0 && (other->prescribed[axis] || other->rail.axis == axis))
      return axis;
  return -1;
}

/// Collective.
bool share_vertices(const BoundaryConfig& a, const BoundaryConfig& b, const NamedMesh& mesh) {
  for (const BoundaryConfig* boundary : {&a, &b})
    for (const std::string& name : boundary->on)
      if (!mesh.boundaries.count(name)) return false;
  const mfem::H1_FECollection order_1(1, mesh.mesh->Dimension());
  mfem::ParFiniteElementSpace vertices(mesh.mesh.get(), &order_1);
  mfem::Array<int> of_a, of_b;
  vertices.GetEssentialTrueDofs(mesh.boundary_marker(a.on), of_a);
  vertices.GetEssentialTrueDofs(mesh.boundary_marker(b.on), of_b);
  return any_of(std::any_of(of_a.begin(), of_a.end(), [&](int dof) { return of_b.Find(dof) >= 0; }));
}

}  // namespace

void MuscleConfig::bind(Section& root, const NamedMesh& mesh) {
  bind_formulation(root.section("muscle", "the implicit finite element formulation"), *this, mesh);
  bind_materials(root, mesh);
  bind_boundaries(root, mesh);
  Section initial = root.section("initial", "the motion at the start: that of a rigid body, and a named one");
  this->initial.bind(initial, mesh);
  for (const BoundaryConfig& boundary : boundaries)
    if (boundary.rail.given() && this->initial.spin != std::array<double, 3>{0, 0, 0})
      initial.error("spin", fmt::format("the plate at {} does not turn", boundary.name), "drop one of them");
  exact_motion = ExactMotion::read(root.section("exact_motion", "a solution to compare with"));
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
  bind_torques(root, mesh);
  for (const AverageConfig& average : averages)
    if (materials.count(average.name))
      root.section("averages").error(average.name, "a material has this name, and means under it", "choose another");
  Section solver = root.section("solver", "Newton's method and the linear solver");
  newton.bind(solver);
  const LinearMethod method = newton.linear.method;
  const std::string problem = block_solver_problem();
  if ((method == LinearMethod::block || method == LinearMethod::condensed) && !problem.empty())
    solver.error("linear", "no multigrid " + problem, "take \"direct\"");
}

std::string MuscleConfig::block_solver_problem() const {
  if (elements.list().size() > 1) return "for cells of several kinds";
  if (!elements.list().empty() && elements.list()[0].pressure_degree < 0)
    return "for elements without pressure and dilatation";
  if (integrator.scheme == Scheme::energy_momentum) return "for the tangent of scheme \"energy_momentum\"";
  return "";
}

void MuscleConfig::bind_boundaries(Section& root, const NamedMesh& mesh) {
  root.each("boundary", "what happens at a boundary of the mesh; one that is not named is free",
            [&](const std::string& name, Section s) {
              BoundaryConfig boundary;
              boundary.name = name;
              boundary.bind(s, mesh);
              for (const BoundaryConfig& other : boundaries) {
                const int axis = shared_axis(boundary, other);
                if (axis >= 0 && mesh.mesh && share_vertices(boundary, other, mesh))
                  s.error("",
                          fmt::format("{} gives the displacement along {} of nodes on its edge too: a plate on a "
                                      "rail must have all of its nodes for itself",
                                      other.name, "xyz"[axis]),
                          "give one of the two another direction, or boundaries that do not touch");
              }
              boundaries.push_back(boundary);
            });
  root.each("link", "springs and dampers between two boundaries", [&](const std::string& name, Section s) {
    LinkConfig link;
    link.name = name;
    link.bind(s, mesh);
    links.push_back(link);
  });
}

/// Moments are those of reactions: somewhere something has to be prescribed.
void MuscleConfig::bind_torques(Section& root, const NamedMesh& mesh) {
  std::vector<std::string> names;
  for (const BoundaryConfig& boundary : boundaries) names.push_back(boundary.name);
  torques = read_torques(root, names, mesh);
  for (const TorqueConfig& torque : torques)
    if (torque.index >= 0 && !boundaries[torque.index].constrained())
      root.section("torques").error(torque.boundary, "no displacement is prescribed there, so that nothing reacts",
                                    "drop it, or name a boundary with clamp, displacement or rail");
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
