/// The nonlinear equations of one implicit step of the muscle formulation, assembled over this rank's cells.
///
///   R(u) = int P(F) : Grad N dV + int rho (a - g) . N dV - surface loads = 0 at free dofs,
///   backward Euler: v = (u - u_n) / dt, a = (v - v_n) / dt.
#pragma once

#include <memory>
#include <mfem.hpp>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/cell_matrices.hpp"
#include "fe/cell_tables.hpp"
#include "fe/loads.hpp"
#include "fe/muscle_config.hpp"
#include "fe/tangent_action.hpp"
#include "fe/three_field.hpp"
#include "mesh/history.hpp"
#include "solve/newton.hpp"

namespace titin {

/// One time step's data. True-dof vectors.
struct StepState {
  double time = 0, dt = 0;    ///< end of the step and its length [s]
  mfem::Vector u_old, v_old;  ///< [m], [m/s] at its beginning
};

class MuscleSystem : public NonlinearSystem {
 public:
  MuscleSystem(const MuscleConfig& config, const NamedMesh& mesh, mfem::ParFiniteElementSpace& space);

  // NonlinearSystem
  int size() const override { return space_.GetTrueVSize(); }
  bool residual(const mfem::Vector& u, mfem::Vector& R) override;
  void tangent(const mfem::Vector& u, Mat) override { assemble(u, nullptr, nullptr); }
  double force_scale() const override { return force_scale_; }
  std::string domain_error() const override { return domain_error_; }

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
  const mfem::Vector& body_forces() const { return body_forces_; }  ///< of the last residual() [N]
  const mfem::Vector& load_forces() const { return load_forces_; }  ///< of surface loads, the same

  /// Calls visit(cell, material, kernel) for each cell of this rank after deform() between u_old and u.
  template <class Visit>
  void for_each_cell(const mfem::Vector& u, const mfem::Vector& u_old, Visit visit) {
    const LocalVectors local(*this, u, u_old);
    for (int cell = 0; cell < space_.GetNE(); ++cell) {
      gather(cell, local);
      kernel_.deform(cell, *materials_[cell], u_cell_.data(), u_old_cell_.data());
      visit(cell, *materials_[cell], kernel_);
    }
  }
  const Material& material(int cell) const { return *materials_[cell]; }
  /// Values of a true-dof vector at the nodes of this rank's cells, [3][nodes] a cell.
  std::vector<double> cell_values(const mfem::Vector& v) const;
  /// Time, step and history of a cell's points; deform() fills in the rest.
  PointInput point_input(int cell) const;
  History& history() { return history_; }
  const FaceLoads& loads() const { return loads_; }
  const CellTables& tables() const { return tables_; }
  mfem::ParFiniteElementSpace& space() { return space_; }
  const MuscleConfig& config() const { return config_; }

 private:
  struct LocalVectors {
    LocalVectors(MuscleSystem& system, const mfem::Vector& u, const mfem::Vector& u_old);
    mfem::Vector u, u_old;
  };
  struct LocalForces;
  bool moving() const { return config_.inertia == Inertia::dynamic && step_.dt > 0; }
  bool add_cell_forces(int cell, const LocalVectors& local, const mfem::Vector& acceleration, LocalForces& forces);
  void gather(int cell, const LocalVectors& local);
  void gather(int cell, const mfem::Vector& local, double* values) const;
  void assemble(const mfem::Vector& u, const mfem::Vector* lift, mfem::Vector* R);
  bool symmetric_materials() const;
  std::vector<char> constrained_dofs() const;
  void start_history();
  void add_inertia_and_body(int cell, const mfem::Vector& acceleration, double* inertia, double* body) const;
  void add_inertia_tangent(int cell, double* K) const;
  TangentPoints tangent_points(int cell, const LocalVectors& local);
  void form_cells(const LocalVectors& local, const std::function<void(int cell, double* K)>& take);
  void form_cells_singly(const LocalVectors& local, const std::function<void(int cell, double* K)>& take);
  double inertia(int cell) const { return moving() ? material(cell).density() / (step_.dt * step_.dt) : 0.0; }
  void add_lift(int cell, const double* K, const mfem::Vector* local_lift, mfem::Vector* local_R) const;
  void set_domain_error(int cell, int point);
  mfem::Vector to_true(const mfem::Vector& local) const;

  const MuscleConfig& config_;
  mfem::ParFiniteElementSpace& space_;
  CellTables tables_;
  Constraints constraints_;
  FaceLoads loads_;
  ThreeField kernel_;
  std::vector<const Material*> materials_;  // of each cell
  std::vector<int> cell_dofs_;              // [cell][3][nodes], local dofs
  mutable History history_{{}, 0};          // written as stresses are evaluated
  StepState step_;
  std::unique_ptr<CellMatrices> matrices_;  // null where cells are formed singly
  std::unique_ptr<Assembly> assembly_;      // large: not there before the first step, so that checking a scene is cheap
  std::vector<double> u_cell_, u_old_cell_;
  mfem::Vector forces_, body_forces_, load_forces_;
  double force_scale_ = 0, force_floor_ = 0;
  std::string domain_error_;
};

}  // namespace titin
