/// What a scene says of a rod.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "materials/material.hpp"
#include "mesh/mesh.hpp"
#include "solve/integrator.hpp"

namespace titin {

enum class RodKind {
  continuum,  ///< finite elements
  chain,      ///< point masses joined by elements without mass
  massless,   ///< one element
};

/// Where the masses of a chain are: in the middle of equal parts of it, or at equal distances from end to end.
enum class Spacing { centred, even };

enum class RodInertia { dynamic, quasi_static };

struct RodEndConfig {
  std::string name;
  bool at_far_end = false;
  bool prescribed = false;
  Table displacement;  // [m]
  Table force;         // [N] along x
  double mass = 0;     // [kg] fixed to the end
  void bind(Section& s, const NamedMesh& mesh);
};

struct RodMarkerConfig {
  std::string name;
  double position;  // [m], undeformed
};

/// In series with the muscle, at the far end, without mass.
struct TendonConfig {
  double length = 0, area = 0;  // [m], [m^2]; 0: none
  bool given() const { return length > 0 && area > 0; }
};

/// How the rod is at the start: stretched evenly, and out of place and in motion as a standing wave is.
struct RodStart {
  double stretch = 1;                     // of the muscle
  double displacement = 0, velocity = 0;  // largest ones of the wave [m], [m/s]
  int mode = 1;                           // half waves between the ends
};

struct RodConfig {
  RodKind kind = RodKind::continuum;
  double length = 0, area = 0;  // [m], [m^2] of the muscle, along the line and across the fibres
  int cells = 16, order = 1;
  int masses = 16;
  Spacing spacing = Spacing::centred;
  double pennation = 0;  // [rad]
  double scale = 1;      // of lengths; areas and forces have its square, masses its cube
  RodInertia inertia = RodInertia::dynamic;
  bool stability = false;
  TendonConfig tendon;
  RodStart start;
  std::vector<RodEndConfig> ends;
  std::vector<RodMarkerConfig> markers;
  std::shared_ptr<const Material> muscle, tendon_material;
  std::string muscle_name, tendon_name;
  IntegratorConfig integrator;
  double tolerance = 1e-8;  // of Newton's method
  int max_iterations = 25;
  std::function<double(double X, double t)> body;  // [N/m^3]; from tests, not from scenes

  /// Reads everything and makes the mesh that fields are drawn on. Collective.
  NamedMesh bind(Section& root);
  int elements() const;                  ///< of the muscle
  int element_order() const;             ///< polynomials of degree 1 or 2
  std::vector<double> vertices() const;  ///< [m] ends of the elements, the tendon's last
  double line_area() const;              ///< [m^2] across the line
  const RodEndConfig* end(bool far) const;
  bool has_mass() const { return inertia == RodInertia::dynamic; }
  FibreRate rate() const { return has_mass() ? FibreRate::stretch_difference : FibreRate::none; }

 private:
  void bind_shape(Section& s);
  void check_shape(Section& s) const;
  void bind_materials(Section& root, const NamedMesh& mesh);
  void bind_ends(Section& root, const NamedMesh& mesh);
  void bind_markers(Section& root);
  void check_held(Section& root) const;
  NamedMesh make_mesh() const;
};

}  // namespace titin
