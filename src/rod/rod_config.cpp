#include "rod/rod_config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "mesh/named_parts.hpp"

namespace titin {
namespace {

constexpr double most_elements = 1e5;
constexpr int most_nodes_of_eigenvalues = 400;  // dense matrices of twice the size, at every step
constexpr int muscle_region = 1, tendon_region = 2;

Table scaled(const Table& table, double factor) {
  std::vector<double> value = table.value();
  for (double& x : value) x *= factor;
  return {table.time(), std::move(value)};
}

/// Where the parts of a chain or of a continuum end, over its length.
std::vector<double> places(const RodConfig& c) {
  std::vector<double> list = {0};
  const bool centred = c.kind == RodKind::chain && c.spacing == Spacing::centred;
  const int n = c.elements();
  for (int i = 1; i < n; ++i) list.push_back(centred ? (i - 0.5) / (n - 1) : double(i) / n);
  list.push_back(1);
  return list;
}

}  // namespace

void RodEndConfig::bind(Section& s, const NamedMesh& mesh) {
  const std::vector<std::string> on = read_boundaries(s, name, mesh);
  at_far_end = !on.empty() && on.front() == "x+";
  if (on.size() > 1) s.error("on", "a rod's ends are not moved together", "make a table for each");
  Section d = s.section("displacement");
  d.read("x", displacement, {.unit = "m", .doc = "displacement, constant or in time"});
  prescribed = d.has("x");
  s.read("force", force, {.unit = "N", .doc = "of a rod: along x, constant or in time"});
  s.read("mass", mass, {.unit = "kg", .range = non_negative, .doc = "of a rod: of a point mass fixed to this end"});
  if (prescribed && s.has("force")) s.error("force", "the displacement of this end is given", "drop one of the two");
}

int RodConfig::elements() const { return kind == RodKind::massless ? 1 : kind == RodKind::chain ? masses + 1 : cells; }

int RodConfig::element_order() const { return kind == RodKind::continuum ? order : 1; }

std::vector<double> RodConfig::vertices() const {
  std::vector<double> X;
  for (double part : places(*this)) X.push_back(part * length);
  if (tendon.given()) X.push_back(length + tendon.length);
  return X;
}

double RodConfig::line_area() const { return area / std::cos(pennation); }

const RodEndConfig* RodConfig::end(bool far) const {
  for (const RodEndConfig& end : ends)
    if (end.at_far_end == far) return &end;
  return nullptr;
}

void RodConfig::bind_shape(Section& s) {
  s.choose("kind", kind,
           {{"continuum", RodKind::continuum}, {"chain", RodKind::chain}, {"massless", RodKind::massless}},
           {.doc = "finite elements; point masses joined by elements without mass; or one element without mass"});
  s.read("length", length, {.unit = "m", .range = positive, .required = true, .doc = "of the muscle along x"});
  s.read("area", area, {.unit = "m^2", .range = positive, .required = true, .doc = "across its fibres"});
  s.read("cells", cells, {.range = {.min = 1, .max = most_elements}, .doc = "elements of a continuum"});
  s.read("order", order, {.range = {.min = 1, .max = 2}, .doc = "k of a continuum: the error falls as h^(k+1)"});
  s.read("masses", masses, {.range = {.min = 1, .max = 1e4}, .doc = "of a chain, which share the mass of the muscle"});
  s.choose("spacing", spacing, {{"centred", Spacing::centred}, {"even", Spacing::even}},
           {.doc = "masses of a chain: in the middle of equal parts (error as 1/masses^2), or at equal distances from "
                   "end to end (as 1/masses)"});
  s.read("pennation", pennation,
         {.unit = "rad",
          .range = {.min = 0, .max = 80 * std::numbers::pi / 180},
          .doc = "angle of the undeformed fibres to x; their distance stays as it is"});
  s.read("scale", scale,
         {.range = positive,
          .doc = "makes all lengths so many times longer, areas and forces by its square, masses by "
                 "its cube"});
  s.choose("inertia", inertia, {{"dynamic", RodInertia::dynamic}, {"quasi-static", RodInertia::quasi_static}},
           {.doc = "quasi-static: no inertia, and the rate of the fibres is taken as zero"});
  s.read("stability", stability,
         {.doc = "column growth_rate: that of the fastest small motion about the present state, taken as at rest"});
  Section t = s.section("tendon", "in series, without mass, at x+: region tendon");
  t.read("length", tendon.length, {.unit = "m", .range = positive, .doc = "when it bears no force"});
  t.read("area", tendon.area, {.unit = "m^2", .range = positive, .doc = "across it"});
  Section b = s.section("start", "the motion at the start");
  b.read("stretch", start.stretch, {.range = positive, .doc = "of the whole muscle"});
  b.read("displacement", start.displacement, {.unit = "m", .doc = "largest, of a standing wave between still ends"});
  b.read("velocity", start.velocity, {.unit = "m/s", .doc = "largest, of the same wave"});
  b.read("mode", start.mode, {.range = {.min = 1, .max = 1e4}, .doc = "half waves of it"});
  check_shape(s);
}

void RodConfig::check_shape(Section& s) const {
  if (s.describing()) return;
  const char* const of_kind[] = {"continuum", "chain", "massless"};
  const auto only = [&](const char* key, RodKind wanted) {
    if (s.has(key) && kind != wanted)
      s.error(key, fmt::format("belongs to kind = \"{}\"", of_kind[static_cast<int>(wanted)]), "drop it");
  };
  for (const char* key : {"cells", "order"}) only(key, RodKind::continuum);
  for (const char* key : {"masses", "spacing"}) only(key, RodKind::chain);
  if ((tendon.length > 0) != (tendon.area > 0)) s.error("tendon", "a tendon has a length and an area", "give both");
  if (stability && elements() * element_order() + 1 > most_nodes_of_eigenvalues)
    s.error("stability", fmt::format("eigenvalues of {} nodes at every step take long", elements() * element_order()),
            fmt::format("take at most {}", most_nodes_of_eigenvalues));
}

void RodConfig::bind_materials(Section& root, const NamedMesh& mesh) {
  RegionMaterials regions;
  std::map<std::string, std::shared_ptr<const Material>> materials;
  root.each("materials", "one material, of one or more regions", [&](const std::string& name, Section s) {
    regions.read(s, name, mesh);
    const auto material = materials[name] = Material::read(s);
    if (s.describing() || !material) return;
    const Vec3 fibre = material->fibre();
    if (material->has_fibres() && (std::abs(fibre[1]) > 0 || std::abs(fibre[2]) > 0))
      s.error("fibre", "a rod's fibres lie along x", "give [1, 0, 0], and their angle as rod.pennation");
    if (!material->fields().empty()) s.error("", "has numbers that vary in space", "a rod is the same all along");
  });
  regions.finish(root, mesh);
  for (const auto& [region, name] : regions.by_attribute()) {
    (region == tendon_region ? tendon_material : muscle) = materials[name];
    (region == tendon_region ? tendon_name : muscle_name) = name;
  }
}

void RodConfig::bind_ends(Section& root, const NamedMesh& mesh) {
  root.each("boundary", "what happens at a boundary of the mesh; one that is not named is free",
            [&](const std::string& name, Section s) {
              RodEndConfig end;
              end.name = name;
              end.bind(s, mesh);
              if (!s.describing() && this->end(end.at_far_end))
                s.error("", "is the second table of this end", "make one of both");
              ends.push_back(end);
            });
}

void RodConfig::bind_markers(Section& root) {
  Section points = root.section("markers");
  const double reach = length + tendon.length;
  for (const std::string& name : points.names()) {
    RodMarkerConfig marker{name, 0};
    points.read(name, marker.position, {.unit = "m", .doc = "of a rod: position along x in the undeformed body"});
    marker.position *= scale;
    if (length > 0 && (marker.position < 0 || marker.position > reach))
      points.error(name, "lies beyond the rod", fmt::format("its ends are at 0 and {:.4g} m", reach / scale));
    markers.push_back(marker);
  }
}

/// What has no mass must be held: nothing else says where it is.
void RodConfig::check_held(Section& root) const {
  if (root.describing()) return;
  bool held = false, heavy = kind != RodKind::massless;
  for (const RodEndConfig& end : ends) held = held || end.prescribed, heavy = heavy || end.mass > 0;
  if (!held && !(heavy && has_mass()))
    root.error("boundary", "nothing holds the rod, which has no inertia",
               "give the displacement.x of one of its ends x- and x+");
}

NamedMesh RodConfig::make_mesh() const {
  NamedMesh named;
  const std::vector<double> X = vertices();
  const int count = static_cast<int>(X.size()) - 1;
  mfem::Mesh serial(1, count + 1, count, 2, 1);
  for (double x : X) serial.AddVertex(&x);
  for (int e = 0; e < count; ++e)
    serial.AddSegment(e, e + 1, tendon.given() && e + 1 == count ? tendon_region : muscle_region);
  serial.AddBdrPoint(0, 1);
  serial.AddBdrPoint(count, 2);
  serial.FinalizeMesh();
  std::vector<int> partition(count);
  for (int e = 0; e < count; ++e) partition[e] = static_cast<int>(static_cast<long>(e) * ranks() / count);
  named.numbers = MeshNumbers(serial, partition.data());
  named.mesh = std::make_unique<mfem::ParMesh>(MPI_COMM_WORLD, serial, partition.data());
  named.regions["muscle"] = muscle_region;
  if (tendon.given()) named.regions["tendon"] = tendon_region;
  named.boundaries = {{"x-", 1}, {"x+", 2}};
  return named;
}

NamedMesh RodConfig::bind(Section& root) {
  Section shape = root.section("rod", "a muscle as a line");
  bind_shape(shape);
  for (double* x : {&length, &tendon.length}) *x *= scale;
  for (double* x : {&area, &tendon.area}) *x *= scale * scale;
  NamedMesh mesh;
  const bool has_shape = length > 0 && area > 0 && elements() >= 1 && elements() <= most_elements;
  if (!root.describing() && has_shape) mesh = make_mesh();
  bind_materials(root, mesh);
  bind_ends(root, mesh);
  bind_markers(root);
  check_held(root);
  Section time = root.section("time");
  integrator.bind(time);
  Section solver = root.section("solver", "Newton's method");
  solver.read(
      "tolerance", tolerance,
      {.range = {.min = 1e-14, .max = 1e-1}, .doc = "residual force over the sum of the absolute nodal forces"});
  solver.read("max_iterations", max_iterations,
              {.range = {.min = 1, .max = 1000}, .doc = "of Newton's method in a step"});
  for (RodEndConfig& end : ends) {
    end.displacement = scaled(end.displacement, scale);
    end.force = scaled(end.force, scale * scale);
    end.mass *= scale * scale * scale;
  }
  return mesh;
}

}  // namespace titin
