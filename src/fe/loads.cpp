#include "fe/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "fe/cell_element.hpp"
#include "math/tensor.hpp"
#include "mesh/named_parts.hpp"
#include "mesh/plane_vector.hpp"

namespace titin {

bool BoundaryConfig::loaded() const {
  const bool has_traction = traction != std::array<double, 3>{0, 0, 0};
  const bool has_pressure = !pressure.is_constant() || pressure(0) != 0;
  return has_traction || has_pressure || support.given();
}

void BoundaryConfig::bind(Section& s, const NamedMesh& mesh) {
  on = read_boundaries(s, name, mesh);
  s.read("clamp", clamp, {.doc = "hold all components at zero displacement"});
  Section d = s.section("displacement", "prescribed components; a component that is not named is free");
  const char* component[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    d.read(component[i], displacement[i], {.unit = "m", .doc = "displacement, constant or in time"});
    prescribed[i] = clamp || d.has(component[i]);
    if (d.has(component[i]) && mesh.mesh && i >= mesh.mesh->Dimension())
      d.error(component[i], "the body is plane", "drop it: nothing moves in z");
    if (clamp && d.has(component[i]))
      d.error(component[i], "a clamped boundary cannot be displaced", "drop clamp = true");
  }
  read_vector(s, "traction", traction,
              {.unit = "Pa", .doc = "dead traction: force per undeformed area, fixed direction"}, mesh);
  s.read("traction_scale", traction_scale, {.doc = "factor of the traction, constant or in time"});
  s.read("pressure", pressure,
         {.unit = "Pa", .doc = "follower pressure on the deformed surface, positive when it pushes"});
  support.bind(s);
  rail.bind(s, mesh.mesh ? mesh.mesh->Dimension() : 0);
  if (rail.given() && prescribed[rail.axis])
    s.error("rail", fmt::format("the displacement along {} is given too", component[rail.axis]),
            clamp ? "hold the other components by displacement, not by clamp" : "drop one of them");
}

Constraints::Constraints(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh,
                         mfem::ParFiniteElementSpace& space) {
  std::map<int, const Table*> constrained;
  boundary_dofs_.resize(boundaries.size());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const auto marker = mesh.boundary_marker(boundaries[b].on);
    for (int i = 0; i < mesh.mesh->Dimension(); ++i) {
      auto& dofs = boundary_dofs_[b][i];
      space.GetEssentialTrueDofs(marker, dofs, i);
      if (boundaries[b].prescribed[i])
        for (int dof : dofs) constrained[dof] = &boundaries[b].displacement[i];
    }
    const RailConfig& rail = boundaries[b].rail;
    if (rail.given()) rails_.add(rail, static_cast<int>(b), boundary_dofs_[b][rail.axis]);
  }
  rails_.finish(space);
  mfem::Vector marker(space.GetTrueVSize()), local_marker(space.GetVSize());
  marker = 0.0;
  for (const auto& [dof, table] : constrained) {
    dofs_.Append(dof);
    values_.push_back(table);
    marker(dof) = 1;
  }
  for (const Rails::Rail& rail : rails_.list())
    for (int dof : rail.dofs) marker(dof) = 1;
  space.GetProlongationMatrix()->Mult(marker, local_marker);
  local_marker_.resize(space.GetVSize());
  std::transform(local_marker.begin(), local_marker.end(), local_marker_.begin(), [](double x) { return x > 0.5; });
}

bool Constraints::any() const { return any_of(dofs_.Size() > 0) || rails_.any(); }

void Constraints::set_zero(mfem::Vector& v) const {
  for (int dof : dofs_) v(dof) = 0;
  for (const Rails::Rail& rail : rails_.list())
    for (int dof : rail.dofs) v(dof) = 0;
}

void Constraints::condense(mfem::Vector& R) const {
  for (int dof : dofs_) R(dof) = 0;
  rails_.gather(R);
}

void Constraints::set_values(double time, mfem::Vector& u) const {
  for (int i = 0; i < dofs_.Size(); ++i) u(dofs_[i]) = (*values_[i])(time);
}

void Constraints::set_rates(double time, mfem::Vector& v) const {
  for (int i = 0; i < dofs_.Size(); ++i) v(dofs_[i]) = values_[i]->slope_before(time);
}

FaceLoads::FaceLoads(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh, const CellElements& elements,
                     const mfem::ParFiniteElementSpace& space, int points)
    : dimension_(mesh.mesh->Dimension()), faces_of_cell_(space.GetNE()) {
  for (const auto& boundary : boundaries) {
    if (!boundary.loaded()) continue;
    has_follower_ = has_follower_ || !boundary.pressure.is_constant() || boundary.pressure(0) != 0;
    has_supports_ = has_supports_ || boundary.support.given();
    const auto marker = mesh.boundary_marker(boundary.on);
    for (int i = 0; i < mesh.mesh->GetNBE(); ++i) {
      if (!marker[mesh.mesh->GetBdrAttribute(i) - 1]) continue;
      auto* map = mesh.mesh->GetBdrFaceTransformations(i);
      if (!map) continue;  // an inner surface: loads act on the outside only
      const auto& rule =
          elements.face_rule(map->GetGeometryType(), mesh.mesh->GetElementGeometry(map->Elem1No), points);
      add_face(*map, boundary, rule, *space.GetFE(map->Elem1No), mesh.thickness);
    }
    set_area(boundary);
  }
}

void FaceLoads::add_face(mfem::FaceElementTransformations& map, const BoundaryConfig& load,
                         const mfem::IntegrationRule& rule, const mfem::FiniteElement& element, double thickness) {
  const int nodes = element.GetDof();
  Face face{&load, 0, {}};
  mfem::Vector shape(nodes), normal(dimension_);
  mfem::DenseMatrix slope(nodes, dimension_), gradient(nodes, dimension_);
  for (int q = 0; q < rule.GetNPoints(); ++q) {
    map.SetAllIntPoints(&rule.IntPoint(q));
    const auto& in_cell = map.GetElement1IntPoint();
    element.CalcShape(in_cell, shape);
    element.CalcDShape(in_cell, slope);
    mfem::Mult(slope, map.Elem1->InverseJacobian(), gradient);
    mfem::CalcOrtho(map.Jacobian(), normal);  // outward of cell 1, as long as the area is large
    Point point{{shape.begin(), shape.end()}, std::vector<double>(3 * nodes), {}, {}, 0, 0};
    mfem::Vector X(point.X.data(), dimension_);
    map.Elem1->Transform(in_cell, X);
    for (int J = 0; J < dimension_; ++J) {
      point.normal[J] = rule.IntPoint(q).weight * thickness * normal(J);
      for (int a = 0; a < nodes; ++a) point.G[J * nodes + a] = gradient(a, J);
    }
    face.points.push_back(std::move(point));
  }
  faces_of_cell_[map.Elem1No].push_back(std::move(face));
}

/// Collective.
void FaceLoads::set_area(const BoundaryConfig& load) {
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
  return {point.N.data(),  static_cast<int>(point.N.size()), dimension_, area, area / face.whole_area, point.X,
          point.multiplier};
}

void FaceLoads::add_supports(int cell, double time, const SupportMotion& motion, double* r, double* K) const {
  for (const Face& face : faces_of_cell_[cell])
    for (const Point& point : face.points)
      if (face.load->support.given()) add_support(face.load->support, time, support_point(face, point), motion, r, K);
}

/// Calls visit(cell, face, point) where a wall is augmented.
template <class Visit>
void FaceLoads::for_each_wall_point(Visit visit) {
  for (std::size_t cell = 0; cell < faces_of_cell_.size(); ++cell)
    for (Face& face : faces_of_cell_[cell])
      for (Point& point : face.points)
        if (face.load->support.wall.gap_tolerance > 0) visit(static_cast<int>(cell), face, point);
}

double FaceLoads::augmentation_error(double time, const MotionOfCell& motion) {
  double largest = 0;
  for_each_wall_point([&](int cell, const Face& face, const Point& point) {
    const WallConfig& wall = face.load->support.wall;
    const double change = wall_pressure(wall, time, support_point(face, point), motion(cell).u) - point.multiplier;
    largest = std::max(largest, std::abs(change) / (wall.penalty * wall.gap_tolerance));
  });
  return largest;
}

void FaceLoads::augment(double time, const MotionOfCell& motion) {
  for_each_wall_point([&](int cell, const Face& face, Point& point) {
    point.multiplier = wall_pressure(face.load->support.wall, time, support_point(face, point), motion(cell).u);
  });
}

void FaceLoads::accept_multipliers() {
  for_each_wall_point([](int, const Face&, Point& point) { point.multiplier_old = point.multiplier; });
}

void FaceLoads::reset_multipliers() {
  for_each_wall_point([](int, const Face&, Point& point) { point.multiplier = point.multiplier_old; });
}

/// Multipliers of walls, as accepted last.
void FaceLoads::walk(StateWalk& walk, const StateRows& cells) {
  std::vector<int> sizes(faces_of_cell_.size());
  std::vector<double> multipliers;
  for_each_wall_point([&](int cell, const Face&, const Point& point) {
    ++sizes[cell];
    multipliers.push_back(point.multiplier_old);
  });
  walk.ragged("wall_multipliers", cells, sizes, multipliers.data());
  auto next = multipliers.begin();
  for_each_wall_point([&](int, const Face&, Point& point) { point.multiplier = point.multiplier_old = *next++; });
}

SupportState FaceLoads::support_state(const BoundaryConfig& boundary, double time, const MotionOfCell& motion) const {
  SupportState state;
  state.gap = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < faces_of_cell_.size(); ++cell)
    for (const Face& face : faces_of_cell_[cell])
      for (const Point& point : face.points)
        if (face.load == &boundary)
          add_state(boundary.support, time, support_point(face, point), motion(static_cast<int>(cell)), state);
  return state;
}

void FaceLoads::add(int cell, double time, const double* u, double* r, double* K) const {
  for (const Face& face : faces_of_cell_[cell]) {
    add_dead(face, time, r);
    const double pressure = face.load->pressure(time);
    if (pressure == 0) continue;
    for (const Point& point : face.points) add_follower(point, pressure, u, r, K);
  }
}

void FaceLoads::add_dead(const Face& face, double time, double* r) const {
  const double scale = face.load->traction_scale(time);
  for (const Point& point : face.points) {
    const double area = norm(point.normal);
    const int nodes = static_cast<int>(point.N.size());
    for (int i = 0; i < dimension_; ++i) {
      const double force = scale * face.load->traction[i] * area;
      for (int a = 0; a < nodes; ++a) r[i * nodes + a] -= force * point.N[a];
    }
  }
}

/// Force on the body: -p cof F N dA (Nanson).
void FaceLoads::add_follower(const Point& point, double pressure, const double* u, double* r, double* K) const {
  const int nodes = static_cast<int>(point.N.size());
  Mat3 F = identity;
  for (int i = 0; i < dimension_; ++i)
    for (int J = 0; J < 3; ++J)
      for (int a = 0; a < nodes; ++a) F[3 * i + J] += u[i * nodes + a] * point.G[J * nodes + a];
  const Mat3 cof = cofactor(F);
  const Vec3 n = multiply(cof, point.normal);
  for (int i = 0; i < dimension_; ++i)
    for (int a = 0; a < nodes; ++a) r[i * nodes + a] += pressure * n[i] * point.N[a];
  if (!K) return;
  const double J = determinant(F);
  for (int i = 0; i < dimension_; ++i)
    for (int k = 0; k < dimension_; ++k)
      for (int b = 0; b < nodes; ++b) {
        double dn = 0;  // d (cof F N)_i / d u_kb
        for (int L = 0; L < 3; ++L) {
          double along = 0;
          for (int M = 0; M < 3; ++M)
            along += (cof[3 * i + M] * cof[3 * k + L] - cof[3 * i + L] * cof[3 * k + M]) * point.normal[M];
          dn += along / J * point.G[L * nodes + b];
        }
        for (int a = 0; a < nodes; ++a)
          K[(i * nodes + a) * dimension_ * nodes + k * nodes + b] += pressure * dn * point.N[a];
      }
}

}  // namespace titin
