/// The nonlinear equations of one implicit step of the muscle formulation, assembled over this rank's cells.
///
///   R(u) = f(u) + (1 - w) / w f_n + int rho a / w . N dV = 0 at free dofs,
///   f(u) = int P(F) : Grad N dV - int rho g . N dV - surface loads,   a = inertia_factor (u - u_n) + known_inertia,
///
/// with the numbers of the time integration (solve/integrator.hpp); w is its force_weight.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/cell_blocks.hpp"
#include "fe/cell_matrices.hpp"
#include "fe/cell_tables.hpp"
#include "fe/energy_momentum.hpp"
#include "fe/links.hpp"
#include "fe/loads.hpp"
#include "fe/muscle_config.hpp"
#include "fe/tangent_action.hpp"
#include "fe/tangent_border.hpp"
#include "fe/three_field.hpp"
#include "mesh/history.hpp"
#include "solve/integrator.hpp"
#include "solve/newton.hpp"

namespace titin {

/// One time step's data. True-dof vectors.
struct StepState {
  double time = 0, dt = 0;  ///< end of the step and its length [s]
  mfem::Vector u_old;       ///< [m] at its beginning
  double inertia_factor = 0,
         inertia_weight = 1;   ///< [1/s^2]; part of the acceleration at the end in that of the balance
  mfem::Vector known_inertia;  ///< [m/s^2]
  // The velocity where loads act is velocity_factor (u - u_old) + known_velocity; empty: zero.
  double velocity_factor = 0;   ///< [1/s]
  mfem::Vector known_velocity;  ///< [m/s]
  double force_weight = 1;
  double work_weight = 1;  ///< of the forces at the end in the work of the step
  // The rate of fibres, where it is not that from u_old to u in dt: from rate_old in rate_dt to u, or to u_old.
  mfem::Vector rate_old;  ///< [m]
  double rate_dt = 0;     ///< [s]; 0: the step's own
  bool rate_known = false;
  bool conserving = false;  ///< forces are the discrete gradient between u_old and u, loads those of the middle

  StepState() = default;
  /// The step that was begun last.
  StepState(const Integrator& integrator, double time);
  /// One of backward Euler.
  StepState(double time, double dt, const mfem::Vector& u_old, const mfem::Vector& v_old);
  void walk(StateWalk& walk, const StateRows& dofs);
};

class MuscleSystem : public NonlinearSystem {
 public:
  MuscleSystem(const MuscleConfig& config, const NamedMesh& mesh, mfem::ParFiniteElementSpace& space);

  // NonlinearSystem
  int size() const override { return space_.GetTrueVSize(); }
  bool residual(const mfem::Vector& u, mfem::Vector& R) override;
  void tangent(const mfem::Vector& u, Mat) override { assemble(u, nullptr, nullptr); }
  bool has_cell_blocks() const override;
  const CellBlocks& cell_blocks(double gamma) override;
  const Border* border() override { return border_ ? &border_->border() : nullptr; }
  double force_scale() const override { return force_scale_; }
  std::string domain_error() const override { return domain_error_; }
  bool has_potential() const override;
  double potential(const mfem::Vector& u) override;

  /// Tangent at u, and R += K_free,constrained * lift: what a change `lift` of the prescribed values does to the free
  /// residuals.
  void tangent_with_lift(const mfem::Vector& u, const mfem::Vector& lift, mfem::Vector& R) { assemble(u, &lift, &R); }

  /// Made when first asked for, then the same for the whole run; symmetric if it says so. Collective
  Mat matrix() { return assembly().matrix(); }
  Assembly& assembly();
  /// The tangent without its matrix, for hexahedra; set_action() gives it values. It leaves out what following loads
  /// add. Null where there is no kernel for the order and quadrature. Collective.
  std::unique_ptr<TangentAction> make_action(Precision precision) const;
  void set_action(const mfem::Vector& u, TangentAction& action);  ///< tangent at u, of the present step
  StepState& step() { return step_; }
  const Constraints& constraints() const { return constraints_; }
  /// Forces at all dofs at the last residual(): reactions where they are constrained [N].
  const mfem::Vector& forces() const { return forces_; }
  /// Takes the pressures of walls at u for their multipliers where they give by more than they may. Returns false when
  /// none does. Collective.
  bool augment(const mfem::Vector& u);
  void reset_multipliers() { loads_.reset_multipliers(); }
  /// What the last accepted step has left: its data, what points remember, forces, multipliers. Collective.
  void walk(StateWalk& walk, const StateRows& cells, const StateRows& dofs);
  /// Displacement and velocity of cells at u, for supports: good while both live.
  FaceLoads::MotionOfCell motion_of(const std::vector<double>& u_cells, const std::vector<double>& v_cells) const;
  /// The forces of the last residual() become those of the beginning of the next step.
  void accept_forces();
  const mfem::Vector& body_forces() const { return body_forces_; }  ///< of the last residual() [N]
  const mfem::Vector& load_forces() const { return load_forces_; }  ///< of surface loads, the same
  const mfem::Vector& support_forces() const { return support_forces_; }

  /// Calls visit(cell, material, kernel) for each cell of this rank after deform() to u in the system's step.
  template <class Visit>
  void for_each_cell(const mfem::Vector& u, Visit visit) {
    const LocalVectors local(*this, u);
    for (int cell = 0; cell < space_.GetNE(); ++cell) {
      deform(cell, local);
      visit(cell, *materials_[cell], kernel_);
    }
  }
  const Material& material(int cell) const { return *materials_[cell]; }
  /// Values of a true-dof vector at the nodes of this rank's cells: [components][nodes] of a cell from first_value on.
  std::vector<double> cell_values(const mfem::Vector& v) const;
  int first_value(int cell) const { return first_value_[cell]; }
  /// Time, step and history of a cell's points; deform() fills in the rest.
  PointInput point_input(int cell) const;
  History& history() { return history_; }
  const FaceLoads& loads() const { return loads_; }
  const Links& links() const { return links_; }
  const CellTables& tables() const { return tables_; }
  mfem::ParFiniteElementSpace& space() { return space_; }
  const MuscleConfig& config() const { return config_; }

 private:
  struct LocalVectors {
    LocalVectors(MuscleSystem& system, const mfem::Vector& u);
    mfem::Vector u, u_old, rate_old, known_velocity;
  };
  struct LocalForces;
  bool moving() const { return config_.inertia == Inertia::dynamic && step_.dt > 0; }
  bool add_cell_forces(int cell, const LocalVectors& local, const mfem::Vector& acceleration, LocalForces& forces);
  const int* dofs(int cell) const { return &cell_dofs_[first_value_[cell]]; }
  bool deform(int cell, const LocalVectors& local);
  void gather(int cell, const mfem::Vector& local, double* values) const;
  void assemble(const mfem::Vector& u, const mfem::Vector* lift, mfem::Vector* R);
  bool symmetric_materials() const;
  std::vector<char> constrained_dofs() const;
  void balance(mfem::Vector& R);
  void update_links(const mfem::Vector& u);
  void end_border();
  /// When, and at which displacement of the cell, loads act in the step.
  double load_time() const { return step_.conserving ? step_.time - 0.5 * step_.dt : step_.time; }
  const double* load_position();
  SupportMotion support_motion(int cell, const LocalVectors& local);
  bool add_internal_forces(int cell, double* r);
  void add_internal_tangent(int cell, double* K);
  void add_load_tangent(int cell, const LocalVectors& local, double* K);
  void start_history();
  void add_inertia_and_body(int cell, const mfem::Vector& acceleration, double* inertia, double* body) const;
  void add_inertia_tangent(int cell, double* K) const;
  TangentPoints tangent_points(int cell, const LocalVectors& local);
  void form_cells(const LocalVectors& local, const std::function<void(int cell, double* K)>& take);
  void form_cells_singly(const LocalVectors& local, const std::function<void(int cell, double* K)>& take);
  double inertia(int cell) const {
    return moving() ? material(cell).density() * step_.inertia_factor / step_.force_weight : 0.0;
  }
  void add_lift(int cell, const double* K, const mfem::Vector* local_lift, mfem::Vector* local_R) const;
  void set_domain_error(int cell, int point);
  mfem::Vector to_true(const mfem::Vector& local) const;

  const MuscleConfig& config_;
  mfem::ParFiniteElementSpace& space_;
  CellTables tables_;
  Constraints constraints_;
  FaceLoads loads_;
  Links links_;
  ThreeField kernel_;
  EnergyMomentum conserving_;
  std::vector<const Material*> materials_;  // of each cell
  std::vector<int> cell_dofs_;              // [cell][component][node], local dofs
  std::vector<int> first_value_;            // of each cell in cell_dofs_
  mutable History history_;                 // written as stresses are evaluated
  StepState step_;
  std::unique_ptr<CellMatrices> matrices_;  // null where cells are formed singly
  std::unique_ptr<Assembly> assembly_;      // large: not there before the first step, so that checking a scene is cheap
  std::unique_ptr<TangentCells> cells_;     // once a linear solver asks for them
  std::unique_ptr<TangentBorder> border_;   // null without rails and links
  PlateForces plates_;
  std::vector<double> u_cell_, u_old_cell_, rate_old_cell_, middle_cell_, velocity_cell_;
  mfem::Vector forces_, body_forces_, load_forces_, support_forces_;
  // Internal less body and surface forces, and density times the acceleration in the balance: now and at the
  // beginning of the step.
  mfem::Vector static_forces_, inertial_forces_, static_forces_old_, inertial_forces_old_;
  double force_scale_ = 0, force_floor_ = 0;
  std::string domain_error_;
};

}  // namespace titin
