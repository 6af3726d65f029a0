/// What a scene says of the Lagrangian formulation.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fv/boundary.hpp"
#include "fv/closure.hpp"
#include "fv/exact_flow.hpp"
#include "fv/fv_config.hpp"
#include "mesh/averages.hpp"
#include "mesh/exact_motion.hpp"
#include "mesh/markers.hpp"
#include "mesh/named_motion.hpp"
#include "mesh/torques.hpp"

namespace titin {

/// The boundary of the exact solution that a boundary of the mesh takes over.
enum class ExactBoundary { none, pressure, velocity };

struct FlowBoundaryConfig {
  std::string name;
  std::vector<std::string> on;  // boundaries of the mesh
  bool wall = false;
  std::array<bool, 3> prescribed{};
  std::array<Table, 3> velocity;  // of components [m/s]
  bool has_normal_velocity = false;
  Table normal_velocity;  // outwards [m/s]
  Table pressure;         // follower [Pa]
  bool has_pressure = false;
  std::array<double, 3> traction{};  // dead [Pa]
  Table traction_scale{1};
  ExactBoundary exact = ExactBoundary::none;
  bool has_obstacle = false;
  std::array<double, 3> obstacle_point{}, obstacle_normal{};
  Contact contact = Contact::slip;
  void bind(Section& s, const NamedMesh& mesh);

 private:
  void check(Section& s) const;
};

/// A start: everywhere, in regions, in a box or in a ball; a later one overrides those before it.
struct InitialConfig {
  std::string name;
  std::vector<int> regions;  // attributes of the mesh; none: all
  bool has_lower = false, has_upper = false, has_radius = false, has_point = false;
  std::array<double, 3> lower{}, upper{}, centre{}, point{};
  double radius = 0;                 // [m]
  double density = 0, pressure = 0;  // of fluids
  double energy = 0;                 // internal, shared out by volume; 0: that of the pressure [J], in the plane [J/m]
  std::array<double, 3> velocity{};  // [m/s]
  NamedMotion motion;                // added to it
  void bind(Section& s, const NamedMesh& mesh);
  /// In a cell of this region around x with these corners.
  bool holds(int region, const Vec3& x, const std::vector<Vec3>& corners) const;
  bool fills(int region) const;  ///< all of it?
  /// Reports a point where no node is. Collective.
  void check_point(Section& s, mfem::ParMesh& mesh) const;
  Vec3 velocity_at(const Vec3& x) const;
};

struct LagrangeConfig {
  FvConfig fv;
  std::map<std::string, std::unique_ptr<Closure>> closures;  // by material
  std::map<std::string, double> densities;                   // of solids [kg/m^3]
  std::map<int, std::string> material_of_region;             // by mesh attribute
  std::vector<FlowBoundaryConfig> boundaries;
  std::vector<InitialConfig> initial;
  std::vector<MarkerConfig> markers;
  std::vector<AverageConfig> averages;
  std::vector<TorqueConfig> torques;
  std::shared_ptr<const ExactFlow> exact;
  std::shared_ptr<const ExactMotion> exact_motion;  // of solids
  void bind(Section& root, const NamedMesh& mesh);
  /// Times at which a load or an activation has a kink [s].
  std::vector<double> kinks() const;

 private:
  void bind_materials(Section& root, const NamedMesh& mesh);
  void read_material(const std::string& name, Section s);
  void check_start(Section& root) const;
};

}  // namespace titin
