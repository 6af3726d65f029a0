/// What happens at named boundaries: pressures and tractions on faces, prescribed velocities and walls at nodes.
///
/// Nodes whose velocity is prescribed along k orthonormal directions N move as v = N w + T y, T spanning the rest, with
/// (T^T M T) y = T^T (b - M N w): no penalty, and the reaction R = M v - b lies in the span of N. Faces give each of
/// their D nodes the D-th part of their force: a pressure follows the face as it is at the middle of the step, a
/// traction acts on its area at rest.
///
/// An obstacle is a rigid half space: a node that would end inside it ends on its surface instead, as long as the
/// reaction pushes; along the surface it slips or sticks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "fv/directions.hpp"
#include "fv/node_exchange.hpp"

namespace titin {

enum class Contact { slip, stick };

/// One condition and the boundary attributes it holds on. Units SI.
template <int D>
struct BoundaryCondition {
  std::string name;
  std::vector<int> attributes;                                     // MFEM's
  std::array<const Table*, D> velocity{};                          // of components [m/s]; null: free
  const Table* normal_velocity = nullptr;                          // outwards [m/s]; a wall has 0
  bool mirrors = false;                                            // a wall: where it is plane, a plane of symmetry
  const Table* pressure = nullptr;                                 // pushes against the outward normal [Pa]
  Vector<D> traction{};                                            // per area at rest [Pa]
  const Table* traction_scale = nullptr;                           // of the traction, in time; null: none
  std::function<double(const Vector<D>&, double)> pressure_at;     // of place [m] and time [s], instead of `pressure`
  std::function<Vector<D>(const Vector<D>&, double)> velocity_at;  // of all components, instead of `velocity`
  struct Obstacle {
    Vector<D> point{}, normal{};  // of its surface; the unit normal points to where the body may be
    Contact contact = Contact::slip;
  };
  bool has_obstacle = false;
  Obstacle obstacle;
};

/// Planes of symmetry at a node, by their unit normals.
template <int D>
struct Mirrors {
  int node = 0, count = 0;
  std::array<Vector<D>, D> normal;
};

template <int D>
class Boundary {
 public:
  /// Collective.
  Boundary(const SimplexMesh<D>& mesh, NodeExchange& exchange, std::vector<BoundaryCondition<D>> conditions);

  /// Evaluates all loads at time t for a step of length dt: faces as they are with nodes at x.
  void prepare(double t, double dt, const std::vector<Vector<D>>& x);
  /// Place among boundary nodes, or -1.
  int place(int node) const { return place_[node]; }
  /// This rank's part of the external force on a boundary node [N].
  const Vector<D>& load(int place) const { return load_[place]; }
  /// The node's velocity from M v = b under its conditions; x is where it was at the start of the step.
  Vector<D> velocity(int place, const Symmetric<D>& M, const Vector<D>& b, const Vector<D>& x);

  struct Force {
    Vector<D> force{};  // on the body [N]
    double power = 0;   // [W]
  };
  /// Of each condition over the step just taken: mean force and power; v are the nodes' velocities, M and b those that
  /// gave them. This rank's part: sum over ranks.
  void add_forces(const std::vector<Vector<D>>& v, std::vector<Force>& of_condition) const;
  /// Moment of a condition's forces about a point [N m], with nodes at x; this rank's part. About z alone in the plane.
  Vector<3> moment(int condition, const Vector<3>& point, const std::vector<Vector<D>>& x) const;

  const std::vector<BoundaryCondition<D>>& conditions() const { return conditions_; }
  const std::vector<Mirrors<D>>& mirrors() const { return mirrors_; }

 private:
  struct NodeRules {
    int node = 0;
    std::vector<std::pair<int, Vector<D>>> walls;  // condition, outward unit normal
    std::vector<int> moving, obstacles;            // conditions
    bool constrained() const { return !walls.empty() || !moving.empty() || !obstacles.empty(); }
    Vector<D> reaction{};                               // of the step
    std::array<std::pair<int, Vector<D>>, D> shares{};  // of it, by condition
    int share_count = 0;
  };
  struct LoadedFace {
    int face, condition;
    Vector<D> at_rest, share;  // area vector; force on each node
  };
  void take_faces();
  void take_rules();
  int take_place(int node);
  void take_mirror(int node, const Vector<D>& normal);
  Directions<D> directions(const NodeRules& rules, const Vector<D>& x) const;
  Vector<D> meet_obstacles(const NodeRules& rules, Directions<D>& given, const Symmetric<D>& M, const Vector<D>& b,
                           const Vector<D>& x) const;
  Vector<D> face_force(const LoadedFace& loaded, double t, const std::vector<Vector<D>>& x) const;

  const SimplexMesh<D>& mesh_;
  NodeExchange& exchange_;
  std::vector<BoundaryCondition<D>> conditions_;
  std::vector<LoadedFace> faces_;
  std::vector<int> place_;           // [node]
  std::vector<NodeRules> rules_;     // [place]
  std::vector<Vector<D>> load_;      // [place]
  std::vector<Mirrors<D>> mirrors_;  // by node
  double time_ = 0, dt_ = 0;         // of the loads; of the step
};

extern template class Boundary<2>;
extern template class Boundary<3>;

}  // namespace titin
