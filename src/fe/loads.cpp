#include "fe/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "fe/cell_tables.hpp"
#include "math/tensor.hpp"

namespace titin {

bool BoundaryConfig::loaded() const {
  const bool has_traction = traction != std::array<double, 3>{0, 0, 0};
  const bool has_pressure = !pressure.is_constant() || pressure(0) != 0;
  return has_traction || has_pressure || support.given();
}

void BoundaryConfig::bind(Section& s, const NamedMesh& mesh) {
  s.read("on", on, {.doc = "boundaries of the mesh (default: the one with this name)"});
  if (on.empty()) on = {name};
  if (!s.describing() && mesh.mesh)
    for (const auto& boundary : on)
      if (!mesh.boundaries.count(boundary))
        s.error(s.has("on") ? "on" : "", fmt::format("the mesh has no boundary {}", in_quotes(boundary)),
                "it has: " + names_of(mesh.boundaries));
  s.read("clamp", clamp, {.doc = "hold all components at zero displacement"});
  Section d = s.section("displacement", "prescribed components; a component that is not named is free");
  for (int i = 0; i < 3; ++i) {
    const char* component[] = {"x", "y", "z"};
    d.read(component[i], displacement[i], {.unit = "m", .doc = "displacement, constant or in time"});
    prescribed[i] = clamp || d.has(component[i]);
    if (clamp && d.has(component[i]))
      d.error(component[i], "a clamped boundary cannot be displaced", "drop clamp = true");
  }
  s.read("traction", traction, {.unit = "Pa", .doc = "dead traction: force per undeformed area, fixed direction"});
  s.read("traction_scale", traction_scale, {.doc = "factor of the traction, constant or in time"});
  s.read("pressure", pressure,
         {.unit = "Pa", .doc = "follower pressure on the deformed surface, positive when it pushes"});
  support.bind(s);
}

Constraints::Constraints(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh,
                         mfem::ParFiniteElementSpace& space) {
  std::map<int, const Table*> constrained;
  boundary_dofs_.resize(boundaries.size());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const auto marker = mesh.boundary_marker(boundaries[b].on);
    for (int i = 0; i < 3; ++i) {
      auto& dofs = boundary_dofs_[b][i];
      space.GetEssentialTrueDofs(marker, dofs, i);
      if (boundaries[b].prescribed[i])
        for (int dof : dofs) constrained[dof] = &boundaries[b].displacement[i];
    }
  }
  mfem::Vector marker(space.GetTrueVSize()), local_marker(space.GetVSize());
  marker = 0.0;
  for (const auto& [dof, table] : constrained) {
    dofs_.Append(dof);
    values_.push_back(table);
    marker(dof) = 1;
  }
  space.GetProlongationMatrix()->Mult(marker, local_marker);
  local_marker_.resize(space.GetVSize());
  std::transform(local_marker.begin(), local_marker.end(), local_marker_.begin(), [](double x) { return x > 0.5; });
}

void Constraints::set_values(double time, mfem::Vector& u) const {
  for (int i = 0; i < dofs_.Size(); ++i) u(dofs_[i]) = (*values_[i])(time);
}

FaceLoads::FaceLoads(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh, const CellTables& tables,
                     const mfem::ParFiniteElementSpace& space, int points)
    : nodes_(tables.nodes()), faces_of_cell_(space.GetNE()) {
  const auto& rule = mfem::IntRules.Get(mfem::Geometry::SQUARE, 2 * points - 1);
  for (const auto& boundary : boundaries) {
    if (!boundary.loaded()) continue;
    has_follower_ = has_follower_ || !boundary.pressure.is_constant() || boundary.pressure(0) != 0;
    const auto marker = mesh.boundary_marker(boundary.on);
    for (int i = 0; i < mesh.mesh->GetNBE(); ++i)
      if (marker[mesh.mesh->GetBdrAttribute(i) - 1]) add_face(i, boundary, rule, *mesh.mesh, *space.GetFE(0));
    set_areas(boundary);
  }
}

void FaceLoads::add_face(int boundary_face, const BoundaryConfig& load, const mfem::IntegrationRule& rule,
                         mfem::ParMesh& mesh, const mfem::FiniteElement& element) {
  auto* map = mesh.GetBdrFaceTransformations(boundary_face);
  if (!map) return;  // an inner surface: loads act on the outside only
  Face face{&load, 0, {}};
  mfem::Vector shape(nodes_), normal(3), X(3);
  mfem::DenseMatrix slope(nodes_, 3), gradient(nodes_, 3);
  for (int q = 0; q < rule.GetNPoints(); ++q) {
    map->SetAllIntPoints(&rule.IntPoint(q));
    const auto& in_cell = map->GetElement1IntPoint();
    element.CalcShape(in_cell, shape);
    element.CalcDShape(in_cell, slope);
    mfem::Mult(slope, map->Elem1->InverseJacobian(), gradient);
    mfem::CalcOrtho(map->Jacobian(), normal);  // outward of cell 1, as long as the area is large
    normal *= rule.IntPoint(q).weight;
    map->Elem1->Transform(in_cell, X);
    Point point{{shape.begin(), shape.end()},
                std::vector<double>(3 * nodes_),
                {normal(0), normal(1), normal(2)},
                {X(0), X(1), X(2)}};
    for (int J = 0; J < 3; ++J)
      for (int a = 0; a < nodes_; ++a) point.G[J * nodes_ + a] = gradient(a, J);
    face.points.push_back(std::move(point));
  }
  faces_of_cell_[map->Elem1No].push_back(std::move(face));
}

/// Collective.
void FaceLoads::set_areas(const BoundaryConfig& load) {
  const auto for_each_face = [&](auto visit) {
    for (auto& faces : faces_of_cell_)
      for (Face& face : faces)
        if (face.load == &load) visit(face);
  };
  double area = 0;
  for_each_face([&](Face& face) {
    for (const Point& point : face.points) area += norm(point.normal);
  });
  area = sum(area);
  for_each_face([&](Face& face) { face.whole_area = area; });
}

SupportPoint FaceLoads::support_point(const Face& face, const Point& point) const {
  const double area = norm(point.normal);
  return {point.N.data(), nodes_, area, area / face.whole_area, point.X};
}

SupportState FaceLoads::support_state(const BoundaryConfig& boundary, double time,
                                      const std::vector<double>& u_cells) const {
  SupportState state;
  state.gap = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < faces_of_cell_.size(); ++cell)
    for (const Face& face : faces_of_cell_[cell])
      for (const Point& point : face.points)
        if (face.load == &boundary)
          add_state(boundary.support, time, support_point(face, point), &u_cells[3 * nodes_ * cell], state);
  return state;
}

void FaceLoads::add(int cell, double time, const double* u, double* r, double* K) const {
  for (const Face& face : faces_of_cell_[cell]) {
    add_dead(face, time, r);
    for (const Point& point : face.points)
      if (face.load->support.given()) add_support(face.load->support, time, support_point(face, point), u, r, K);
    const double pressure = face.load->pressure(time);
    if (pressure == 0) continue;
    for (const Point& point : face.points) add_follower(point, pressure, u, r, K);
  }
}

void FaceLoads::add_dead(const Face& face, double time, double* r) const {
  const double scale = face.load->traction_scale(time);
  for (const Point& point : face.points) {
    const double area = norm(point.normal);
    for (int i = 0; i < 3; ++i) {
      const double force = scale * face.load->traction[i] * area;
      for (int a = 0; a < nodes_; ++a) r[i * nodes_ + a] -= force * point.N[a];
    }
  }
}

/// Force on the body: -p cof F N dA (Nanson).
void FaceLoads::add_follower(const Point& point, double pressure, const double* u, double* r, double* K) const {
  Mat3 F = identity;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int a = 0; a < nodes_; ++a) F[3 * i + J] += u[i * nodes_ + a] * point.G[J * nodes_ + a];
  const Mat3 cof = cofactor(F);
  const Vec3 n = multiply(cof, point.normal);
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < nodes_; ++a) r[i * nodes_ + a] += pressure * n[i] * point.N[a];
  if (!K) return;
  const double J = determinant(F);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int b = 0; b < nodes_; ++b) {
        double dn = 0;  // d (cof F N)_i / d u_kb
        for (int L = 0; L < 3; ++L) {
          double along = 0;
          for (int M = 0; M < 3; ++M)
            along += (cof[3 * i + M] * cof[3 * k + L] - cof[3 * i + L] * cof[3 * k + M]) * point.normal[M];
          dn += along / J * point.G[L * nodes_ + b];
        }
        for (int a = 0; a < nodes_; ++a)
          K[(i * nodes_ + a) * 3 * nodes_ + k * nodes_ + b] += pressure * dn * point.N[a];
      }
}

}  // namespace titin
