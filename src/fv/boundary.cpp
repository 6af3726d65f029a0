#include "fv/boundary.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/words.hpp"

namespace titin {
namespace {

/// Faces lie in one plane when the size of the sum of their area vectors is this part of the sum of their areas.
constexpr double plane = 1 - 1e-9;
/// Less than this: faces of a corner (of more than 74 degrees, where two meet), and not of a curved wall.
constexpr double corner = 0.8;

}  // namespace

template <int D>
Boundary<D>::Boundary(const SimplexMesh<D>& mesh, NodeExchange& exchange, std::vector<BoundaryCondition<D>> conditions)
    : mesh_(mesh), exchange_(exchange), conditions_(std::move(conditions)), place_(mesh.nodes(), -1) {
  take_faces();
  take_rules();
  load_.resize(rules_.size());
}

template <int D>
int Boundary<D>::take_place(int node) {
  if (place_[node] < 0) {
    place_[node] = static_cast<int>(rules_.size());
    rules_.emplace_back().node = node;
  }
  return place_[node];
}

template <int D>
void Boundary<D>::take_faces() {
  for (std::size_t f = 0; f < mesh_.boundary.size(); ++f) {
    const auto& face = mesh_.boundary[f];
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      const auto& condition = conditions_[c];
      const bool here = std::count(condition.attributes.begin(), condition.attributes.end(), face.attribute) > 0;
      if (!here || !(condition.pressure || condition.traction_scale || condition.pressure_at)) continue;
      faces_.push_back({static_cast<int>(f), static_cast<int>(c), area_vector<D>(mesh_.corners_of(face, mesh_.x)), {}});
      for (int node : face.nodes) take_place(node);
    }
  }
}

/// A node obeys a condition when any rank has a face of it there: that rank tells the others. The normal is the mean of
/// the boundary's faces at the node, of each attribute by itself.
template <int D>
void Boundary<D>::take_rules() {
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const auto& condition = conditions_[c];
    const bool moves = condition.velocity_at ||
                       std::any_of(condition.velocity.begin(), condition.velocity.end(), [](auto* t) { return t; });
    if (!condition.normal_velocity && !moves && !condition.has_obstacle) continue;
    bool has_corner = false;
    for (int attribute : condition.attributes) {
      std::vector<std::array<double, D + 1>> area(mesh_.nodes());  // sum of the area vectors, and of the areas
      for (const auto& face : mesh_.boundary) {
        if (face.attribute != attribute) continue;
        const Vector<D> N = area_vector<D>(mesh_.corners_of(face, mesh_.x));
        for (int node : face.nodes) {
          for (int i = 0; i < D; ++i) area[node][i] += N[i];
          area[node][D] += norm(N);
        }
      }
      exchange_.sum(&area[0][0], D + 1);
      for (int p = 0; p < mesh_.nodes(); ++p) {
        if (area[p][D] == 0) continue;
        NodeRules& rules = rules_[take_place(p)];
        if (condition.normal_velocity) {
          Vector<D> n;
          std::copy_n(area[p].begin(), D, n.begin());
          const double size = norm(n);
          has_corner = has_corner || size < corner * area[p][D];
          for (double& component : n) component /= size;
          rules.walls.emplace_back(static_cast<int>(c), n);
          if (condition.mirrors && size > plane * area[p][D]) take_mirror(p, n);
        }
        if (moves) rules.moving.push_back(static_cast<int>(c));
        if (condition.has_obstacle) rules.obstacles.push_back(static_cast<int>(c));
      }
    }
    if (any_of(has_corner))
      logging::warning("boundary " + in_quotes(condition.name) +
                       ": faces of one name meet at a corner, whose nodes move as if it were rounded; give its sides "
                       "names of their own");
  }
}

template <int D>
void Boundary<D>::take_mirror(int node, const Vector<D>& normal) {
  auto here = std::find_if(mirrors_.begin(), mirrors_.end(), [&](const auto& m) { return m.node == node; });
  if (here == mirrors_.end()) here = mirrors_.insert(here, Mirrors<D>{node, 0, {}});
  for (int k = 0; k < here->count; ++k)
    if (std::abs(dot(here->normal[k], normal)) > plane) return;
  if (here->count < D) here->normal[here->count++] = normal;
}

template <int D>
Vector<D> Boundary<D>::face_force(const LoadedFace& loaded, double t, const std::vector<Vector<D>>& x) const {
  const auto& condition = conditions_[loaded.condition];
  Vector<D> force{};
  if (condition.traction_scale)
    accumulate(force, (*condition.traction_scale)(t)*norm(loaded.at_rest), condition.traction);
  if (!condition.pressure && !condition.pressure_at) return force;
  const auto corner = mesh_.corners_of(mesh_.boundary[loaded.face], x);
  double pressure = condition.pressure ? (*condition.pressure)(t) : 0;
  if (condition.pressure_at) {
    Vector<D> centre{};
    for (const auto& p : corner) accumulate(centre, 1.0 / D, p);
    pressure += condition.pressure_at(centre, t);
  }
  accumulate(force, -pressure, area_vector<D>(corner));
  return force;
}

template <int D>
void Boundary<D>::prepare(double t, double dt, const std::vector<Vector<D>>& x) {
  time_ = t;
  dt_ = dt;
  std::fill(load_.begin(), load_.end(), Vector<D>{});
  for (LoadedFace& loaded : faces_) {
    loaded.share = face_force(loaded, t, x);
    for (double& component : loaded.share) component /= D;
    for (int node : mesh_.boundary[loaded.face].nodes) accumulate(load_[place_[node]], 1, loaded.share);
  }
}

template <int D>
Directions<D> Boundary<D>::directions(const NodeRules& rules, const Vector<D>& x) const {
  Directions<D> given;
  for (const auto& [c, n] : rules.walls) given.add(n, (*conditions_[c].normal_velocity)(time_), c);
  for (int c : rules.moving) {
    const auto& condition = conditions_[c];
    const Vector<D> at = condition.velocity_at ? condition.velocity_at(x, time_) : Vector<D>{};
    for (int i = 0; i < D; ++i) {
      if (!condition.velocity_at && !condition.velocity[i]) continue;
      Vector<D> axis{};
      axis[i] = 1;
      given.add(axis, condition.velocity_at ? at[i] : (*condition.velocity[i])(time_), c);
    }
  }
  return given;
}

template <int D>
Vector<D> Boundary<D>::meet_obstacles(const NodeRules& rules, Directions<D>& given, const Symmetric<D>& M,
                                      const Vector<D>& b, const Vector<D>& x) const {
  Vector<D> v = given.solve(M, b);
  for (int c : rules.obstacles) {
    const auto& obstacle = conditions_[c].obstacle;
    const double gap = dot(obstacle.normal, difference(x, obstacle.point));
    if (dt_ == 0 || gap + dt_ * dot(obstacle.normal, v) >= 0) continue;
    const auto stop = [&](Contact contact) {  // false: the obstacle would have to pull
      Directions<D> met = given;
      met.add(obstacle.normal, -gap / dt_, c);
      for (int i = 0; i < D && contact == Contact::stick; ++i) {
        Vector<D> axis{};
        axis[i] = 1;
        met.add(axis, -gap / dt_ * obstacle.normal[i], c);
      }
      const Vector<D> stopped = met.solve(M, b);
      if (dot(obstacle.normal, difference(product<D>(M, stopped), b)) < 0) return false;
      given = met;
      v = stopped;
      return true;
    };
    // To hold a node along the surface may take a pull away from it, to stop it at the surface never does: it slips.
    if (!stop(obstacle.contact) && obstacle.contact == Contact::stick) stop(Contact::slip);
  }
  return v;
}

template <int D>
Vector<D> Boundary<D>::velocity(int place, const Symmetric<D>& M, const Vector<D>& b, const Vector<D>& x) {
  NodeRules& rules = rules_[place];
  rules.share_count = 0;
  rules.reaction = {};
  if (!rules.constrained()) return Directions<D>{}.solve(M, b);
  Directions<D> given = directions(rules, x);
  const Vector<D> v = meet_obstacles(rules, given, M, b, x);
  if (!exchange_.owns(rules.node)) return v;
  const Vector<D> R = difference(product<D>(M, v), b);
  for (int k = 0; k < given.count; ++k) {
    Vector<D> share{};
    accumulate(share, dot(R, given.normal[k]), given.normal[k]);
    accumulate(rules.reaction, 1, share);
    rules.shares[rules.share_count++] = {given.condition[k], share};
  }
  return v;
}

template <int D>
void Boundary<D>::add_forces(const std::vector<Vector<D>>& v, std::vector<Force>& of_condition) const {
  for (const LoadedFace& loaded : faces_)
    for (int node : mesh_.boundary[loaded.face].nodes) {
      accumulate(of_condition[loaded.condition].force, 1, loaded.share);
      of_condition[loaded.condition].power += dot(loaded.share, v[node]);
    }
  for (const NodeRules& rules : rules_)
    for (int k = 0; k < rules.share_count; ++k) {
      const auto& [condition, share] = rules.shares[k];
      accumulate(of_condition[condition].force, 1, share);
      of_condition[condition].power += dot(share, v[rules.node]);
    }
}

template <int D>
Vector<3> Boundary<D>::moment(int condition, const Vector<3>& point, const std::vector<Vector<D>>& x) const {
  Vector<3> sum{};
  const auto add = [&](int node, const Vector<D>& at_node) {
    Vector<3> arm{}, force{};
    std::copy(at_node.begin(), at_node.end(), force.begin());
    for (int i = 0; i < D; ++i) arm[i] = x[node][i] - point[i];
    accumulate(sum, 1, cross(arm, force));
  };
  for (const LoadedFace& loaded : faces_)
    for (int node : mesh_.boundary[loaded.face].nodes)
      if (loaded.condition == condition) add(node, loaded.share);
  for (const NodeRules& rules : rules_)
    for (int k = 0; k < rules.share_count; ++k)
      if (rules.shares[k].first == condition) add(rules.node, rules.shares[k].second);
  return sum;
}

template class Boundary<2>;
template class Boundary<3>;

}  // namespace titin
