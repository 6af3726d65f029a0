#include "fv/lagrange_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "mesh/named_parts.hpp"

namespace titin {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

/// A corner is at a point when it is as near as this part of the cell's size: coordinates of files have a few digits.
constexpr double same_point = 1e-3;

bool only_simplices(mfem::ParMesh& mesh) {
  for (int e = 0; e < mesh.GetNE(); ++e) {
    const auto geometry = mesh.GetElementGeometry(e);
    if (geometry != mfem::Geometry::TRIANGLE && geometry != mfem::Geometry::TETRAHEDRON) return false;
  }
  return mesh.GetNodes() == nullptr;
}

}  // namespace

void FlowBoundaryConfig::bind(Section& s, const NamedMesh& mesh) {
  on = read_boundaries(s, name, mesh);
  s.read("wall", wall, {.doc = "no velocity across it, slip along it: a rigid wall or a plane of symmetry"});
  s.read("normal_velocity", normal_velocity,
         {.unit = "m/s", .doc = "velocity along the outward normal, slip along it: a piston"});
  has_normal_velocity = s.has("normal_velocity");
  Section v = s.section("velocity", "prescribed components; a component that is not named is free");
  for (int i = 0; i < 3; ++i) {
    v.read(axes[i], velocity[i], {.unit = "m/s", .doc = "velocity, constant or in time"});
    prescribed[i] = v.has(axes[i]);
  }
  s.read("traction", traction, {.unit = "Pa", .doc = "dead traction: force per undeformed area, fixed direction"});
  s.read("traction_scale", traction_scale, {.doc = "factor of the traction, constant or in time"});
  s.read("pressure", pressure,
         {.unit = "Pa", .doc = "follower pressure on the deformed surface, positive when it pushes"});
  has_pressure = s.has("pressure");
  s.choose(
      "exact", exact,
      {{"none", ExactBoundary::none}, {"pressure", ExactBoundary::pressure}, {"velocity", ExactBoundary::velocity}},
      {.doc = "takes over this of the exact solution"});
  Section o = s.section("obstacle", "a rigid half space that this boundary may meet and leave");
  o.read("point", obstacle_point, {.unit = "m", .doc = "a point of its surface"});
  o.read("normal", obstacle_normal, {.doc = "out of it, towards the body"});
  o.choose("contact", contact, {{"slip", Contact::slip}, {"stick", Contact::stick}},
           {.doc = "what nodes do that touch it"});
  has_obstacle = o.has("normal");
  check(s);
}

void FlowBoundaryConfig::check(Section& s) const {
  if (s.describing()) return;
  if (wall && has_normal_velocity) s.error("normal_velocity", "a wall has none", "drop wall = true");
  if (has_obstacle && !(norm(obstacle_normal) > 0))
    s.section("obstacle").error("normal", "a direction of length zero", "give the direction out of it, e.g. [0, 0, 1]");
}

void InitialConfig::bind(Section& s, const NamedMesh& mesh) {
  std::vector<std::string> names;
  s.read("regions", names, {.doc = "regions of the mesh it holds in (default: all)"});
  for (const std::string& region : names) {
    const auto found = mesh.regions.find(region);
    if (found != mesh.regions.end())
      regions.push_back(found->second);
    else if (mesh.mesh)
      s.error("regions", fmt::format("the mesh has no region {}", in_quotes(region)),
              "it has: " + names_of(mesh.regions));
  }
  s.read("lower", lower, {.unit = "m", .doc = "lower corner of the box it holds in (default: everywhere)"});
  s.read("upper", upper, {.unit = "m", .doc = "upper corner of the box"});
  s.read("centre", centre, {.unit = "m", .doc = "of the ball it holds in"});
  s.read("radius", radius, {.unit = "m", .range = positive, .doc = "of the ball"});
  s.read("point", point, {.unit = "m", .doc = "a node of the mesh: holds in the cells that share it"});
  has_point = s.has("point");
  has_lower = s.has("lower"), has_upper = s.has("upper"), has_radius = s.has("radius");
  s.read("density", density, {.unit = "kg/m^3", .range = positive, .doc = "of a fluid"});
  s.read("pressure", pressure, {.unit = "Pa", .doc = "of a fluid"});
  s.read("energy", energy,
         {.range = positive,
          .doc = "internal energy of a fluid there in J (in the plane J/m), shared out by volume, instead of the "
                 "pressure's"});
  if (s.has("energy") && !(density > 0)) s.error("energy", "needs a density", "give the density of this start too");
  s.read("velocity", velocity, {.unit = "m/s", .doc = "of all motions this part"});
  motion.bind(s);
}

void InitialConfig::check_point(Section& s, mfem::ParMesh& mesh) const {
  if (!has_point) return;
  long cells = 0;
  mfem::Vector middle;
  mfem::Array<int> nodes;
  const auto place = [&](const double* x) {
    Vec3 a{};
    std::copy_n(x, mesh.Dimension(), a.begin());
    return a;
  };
  for (int e = 0; e < mesh.GetNE(); ++e) {
    mesh.GetElementCenter(e, middle);
    mesh.GetElementVertices(e, nodes);
    std::vector<Vec3> corners;
    for (int node : nodes) corners.push_back(place(mesh.GetVertex(node)));
    InitialConfig here;
    here.has_point = true;
    here.point = point;
    cells += here.holds(mesh.GetAttribute(e), place(middle.GetData()), corners);
  }
  if (sum(cells) == 0)
    s.error("point", fmt::format("no node of the mesh lies at ({:g}, {:g}, {:g}) m", point[0], point[1], point[2]),
            "name a corner of cells, or give a ball by centre and radius");
}

bool InitialConfig::fills(int region) const {
  return !has_lower && !has_upper && !has_radius && !has_point &&
         (regions.empty() || std::count(regions.begin(), regions.end(), region) > 0);
}

bool InitialConfig::holds(int region, const Vec3& x, const std::vector<Vec3>& corners) const {
  if (!regions.empty() && std::count(regions.begin(), regions.end(), region) == 0) return false;
  for (int i = 0; i < 3; ++i)
    if ((has_lower && x[i] < lower[i]) || (has_upper && x[i] > upper[i])) return false;
  if (has_radius && norm(difference(x, centre)) >= radius) return false;
  return !has_point || std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
    return norm(difference(corner, point)) < same_point * norm(difference(corner, x));
  });
}

Vec3 InitialConfig::velocity_at(const Vec3& x) const {
  Vec3 v = motion.velocity_at(x);
  for (int i = 0; i < 3; ++i) v[i] += velocity[i];
  return v;
}

void LagrangeConfig::bind(Section& root, const NamedMesh& mesh) {
  Section scheme = root.section("fv", "the explicit Lagrangian finite volume scheme");
  fv.bind(scheme);
  if (mesh.mesh && !only_simplices(*mesh.mesh)) {
    Section(root.section("mesh"))
        .error("", "has cells that the Lagrangian formulation does not know",
               "take triangles or tetrahedra with straight edges, in a box mesh.kind = \"simplices\"");
  }
  bind_materials(root, mesh);
  root.each("boundary", "what happens at a boundary of the mesh; one that is not named is free",
            [&](const std::string& name, Section s) {
              FlowBoundaryConfig boundary;
              boundary.name = name;
              boundary.bind(s, mesh);
              boundaries.push_back(boundary);
            });
  exact = ExactFlow::read(root.section("exact", "a solution to start from and to compare with"),
                          mesh.mesh ? mesh.mesh->Dimension() : 3);
  exact_motion = ExactMotion::read(root.section("exact_motion", "of a solid: a solution to compare with"));
  for (const auto& boundary : boundaries)
    if (boundary.exact != ExactBoundary::none && !exact)
      root.section("boundary")
          .section(boundary.name)
          .error("exact", "there is no exact solution", "name one in exact.solution");
  root.each("initial", "how cells start", [&](const std::string& name, Section s) {
    InitialConfig start;
    start.name = name;
    start.bind(s, mesh);
    if (mesh.mesh) start.check_point(s, *mesh.mesh);
    initial.push_back(start);
  });
  markers = read_markers(root, mesh);
  averages = read_averages(root, mesh);
  std::vector<std::string> names;
  for (const FlowBoundaryConfig& boundary : boundaries) names.push_back(boundary.name);
  torques = read_torques(root, names, mesh);
  if (!root.describing() && mesh.mesh) check_start(root);
}

std::vector<double> LagrangeConfig::kinks() const {
  std::vector<double> all;
  const auto take = [&](const std::vector<double>& times) { all.insert(all.end(), times.begin(), times.end()); };
  for (const FlowBoundaryConfig& boundary : boundaries) {
    for (const Table& component : boundary.velocity) take(component.kinks());
    for (const Table* table : {&boundary.normal_velocity, &boundary.pressure, &boundary.traction_scale})
      take(table->kinks());
  }
  for (const auto& [name, closure] : closures) take(closure->kinks());
  return all;
}

void LagrangeConfig::read_material(const std::string& name, Section s) {
  if (s.describing() || s.has("fluid")) {
    const auto fluid = Fluid::read(s.section("fluid", "p(rho, e) of a fluid, instead of a solid's terms"));
    if (fluid) closures[name] = make_closure(fluid);
  }
  if (s.describing() || s.has("fluid")) return;  // keys of solids are described by the muscle formulation
  const auto solid = Material::read(s);
  if (!solid) return;
  if (solid->history_size() > 0)
    s.error("", "remembers its past, which the Lagrangian formulation does not carry yet",
            "take a law without viscosity and damage");
  if (!solid->fields().empty())
    s.error("", "varies in space, which the Lagrangian formulation does not carry yet", "give numbers, not fields");
  if (fv.patch_pressure && !solid->has_volumetric_law())
    s.error("", "has no volumetric law of its own, whose pressure fv.patch_pressure could average",
            "add volumetric, or leave fv.patch_pressure out");
  densities[name] = solid->density();
  closures[name] = make_closure(solid);
}

void LagrangeConfig::bind_materials(Section& root, const NamedMesh& mesh) {
  RegionMaterials regions;
  root.each("materials", "one material, of one or more regions", [&](const std::string& name, Section s) {
    regions.read(s, name, mesh);
    read_material(name, s);
  });
  regions.finish(root, mesh);
  material_of_region = regions.by_attribute();
}

/// Fluids have no density of their own.
void LagrangeConfig::check_start(Section& root) const {
  if (exact) return;
  for (const auto& [attribute, name] : material_of_region) {
    if (densities.count(name) || !closures.count(name)) continue;
    bool everywhere = false;
    for (const auto& start : initial) everywhere = everywhere || (start.density > 0 && start.fills(attribute));
    if (!everywhere) {
      root.error("initial", fmt::format("nothing says how dense the fluid {} is everywhere", in_quotes(name)),
                 "begin with a table [initial.NAME] with density and pressure and without a box or ball");
      return;
    }
  }
}

}  // namespace titin
