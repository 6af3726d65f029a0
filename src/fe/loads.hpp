/// What happens at named boundaries: prescribed displacements, dead tractions, follower pressures.
#pragma once

#include <functional>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "fe/rails.hpp"
#include "fe/supports.hpp"
#include "mesh/mesh.hpp"
#include "solve/state_walk.hpp"

namespace titin {

class CellElements;

struct BoundaryConfig {
  std::string name;
  std::vector<std::string> on;  // boundaries of the mesh
  bool clamp = false;
  std::array<bool, 3> prescribed{};
  std::array<Table, 3> displacement;  // [m]
  std::array<double, 3> traction{};   // dead [Pa], force per reference area
  Table traction_scale{1};
  Table pressure;  // follower [Pa], pushes against the outward normal of the deformed surface
  SupportConfig support;
  RailConfig rail;
  bool constrained() const { return clamp || prescribed[0] || prescribed[1] || prescribed[2] || rail.given(); }
  bool loaded() const;
  void bind(Section& s, const NamedMesh& mesh);
};

/// Prescribed components of true dofs, and those that share a value on rails: the one place where either is applied.
class Constraints {
 public:
  Constraints(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh, mfem::ParFiniteElementSpace& space);

  const mfem::Array<int>& dofs() const { return dofs_; }  ///< prescribed true dofs, this rank, increasing
  const Rails& rails() const { return rails_; }
  bool any() const;  ///< of either, on any rank. Collective
  /// Prescribed or on a rail: unit rows and columns in matrices.
  bool is_constrained_local(int local_dof) const { return local_marker_[local_dof] != 0; }
  void set_zero(mfem::Vector& v) const;  ///< at all of these
  /// Nodal forces to residuals: zero where values are prescribed, on rails their sum at its carrier. Collective.
  void condense(mfem::Vector& R) const;
  void set_values(double time, mfem::Vector& u) const;  ///< u_i = g_i(t) at dofs()
  void set_rates(double time, mfem::Vector& v) const;   ///< v_i = g_i'(t), from before t
  /// True dofs of all components on a boundary: [component] -> dofs; its reaction is the sum of their residuals.
  const std::array<mfem::Array<int>, 3>& boundary_dofs(int boundary) const { return boundary_dofs_[boundary]; }

 private:
  mfem::Array<int> dofs_;
  std::vector<const Table*> values_;
  std::vector<char> local_marker_;
  std::vector<std::array<mfem::Array<int>, 3>> boundary_dofs_;
  Rails rails_;
};

/// Surface loads as integrals over cell faces in the reference configuration.
class FaceLoads {
 public:
  FaceLoads(const std::vector<BoundaryConfig>& boundaries, const NamedMesh& mesh, const CellElements& elements,
            const mfem::ParFiniteElementSpace& space, int points);

  bool on_cell(int cell) const { return !faces_of_cell_[cell].empty(); }
  bool has_follower() const { return has_follower_; }
  bool has_supports() const { return has_supports_; }
  /// Adds minus the load's nodal forces to r [components][nodes]; with K != nullptr also their derivative.
  void add(int cell, double time, const double* u, double* r, double* K) const;
  /// The same of supports, which have a potential.
  void add_supports(int cell, double time, const SupportMotion& motion, double* r, double* K) const;
  using MotionOfCell = std::function<SupportMotion(int cell)>;
  /// What the supports of a boundary do to this rank's part of it.
  SupportState support_state(const BoundaryConfig& boundary, double time, const MotionOfCell& motion) const;
  /// By how much multipliers of walls are off at this motion, over their gap_tolerance: 1 is good enough. This rank's.
  double augmentation_error(double time, const MotionOfCell& motion);
  void augment(double time, const MotionOfCell& motion);  ///< takes the pressures for multipliers
  void accept_multipliers();
  void reset_multipliers();  ///< to those accepted last
  void walk(StateWalk& walk, const StateRows& cells);

 private:
  struct Point {
    std::vector<double> N, G;                   // shapes [nodes], reference gradients [J][nodes]
    std::array<double, 3> normal;               // outward, times reference area [m^2]
    std::array<double, 3> X;                    // [m]
    double multiplier = 0, multiplier_old = 0;  // of a wall [Pa]: of this step, of the last
  };
  struct Face {
    const BoundaryConfig* load;
    double whole_area;  // of the boundary, all ranks [m^2]
    std::vector<Point> points;
  };
  void add_face(mfem::FaceElementTransformations& map, const BoundaryConfig& load, const mfem::IntegrationRule& rule,
                const mfem::FiniteElement& element, double thickness);
  template <class Visit>
  void for_each_wall_point(Visit visit);
  void set_area(const BoundaryConfig& load);
  SupportPoint support_point(const Face& face, const Point& point) const;
  void add_dead(const Face& face, double time, double* r) const;
  void add_follower(const Point& point, double pressure, const double* u, double* r, double* K) const;

  int dimension_;
  bool has_follower_ = false, has_supports_ = false;
  std::vector<std::vector<Face>> faces_of_cell_;
};

}  // namespace titin
