/// The muscle formulation as a Model: implicit steps of a total Lagrangian three-field finite element method.
#pragma once

#include <memory>

#include "fe/conservation.hpp"
#include "fe/ellipticity_watch.hpp"
#include "fe/muscle_fields.hpp"
#include "fe/muscle_history.hpp"
#include "fe/muscle_system.hpp"
#include "fe/rigid_turn.hpp"
#include "fe/stress_recovery.hpp"
#include "solve/model.hpp"

namespace titin {

class Muscle : public Model {
 public:
  /// The mesh must not be empty and the config free of errors.
  Muscle(NamedMesh mesh, MuscleConfig config);

  std::string name() const override { return "muscle"; }
  Step advance(double dt) override;
  void accept() override;
  void rewind() override { trial_ = displacement(); }
  double time() const override { return time_; }
  double largest_dt() const override;
  std::vector<double> kinks() const override;

  std::vector<Quantity> quantities() override { return quantities_; }
  std::vector<Quantity> conservation() override { return conservation_.list(); }
  std::vector<Quantity> errors() override;
  std::string shown_quantity() const override { return history_.shown(); }
  void update_fields() override;
  const std::vector<Field>& fields() const override { return fields_.fields(); }
  mfem::ParMesh& mesh() override { return *mesh_.mesh; }
  long unknowns() const override { return static_cast<long>(space_.GlobalTrueVSize()); }
  void walk_state(StateWalk& walk) override;
  void forget() override;
  MuscleSystem& system() { return system_; }
  const mfem::Vector& displacement() const { return integrator_.u(); }
  const Integrator& motion() const { return integrator_; }

 private:
  void start();
  Newton& newton();
  void follow(const StepState& step);
  void solve(Step& step);
  void estimate_error(Step& step);
  std::string predict(Step& step);
  double continued_part(const Step& step) const;
  std::string predict_from(const mfem::Vector& start, Step& step);

  NamedMesh mesh_;
  MuscleConfig config_;
  std::unique_ptr<mfem::FiniteElementCollection> collection_;
  mfem::ParFiniteElementSpace space_;
  MuscleSystem system_;
  Integrator integrator_;           // the accepted state, and the numbers of the step being tried
  std::unique_ptr<Newton> newton_;  // from the first step on
  MuscleHistory history_;
  EllipticityWatch watch_;
  Conservation conservation_;
  std::vector<Quantity> quantities_;  // of the accepted state
  MuscleFields fields_;
  std::unique_ptr<RigidTurn> turn_;           // null unless the body is free
  std::unique_ptr<StressRecovery> recovery_;  // null unless asked for
  double time_ = 0;
  bool remember_ = false;                      // the history of the accepted step has still to become the past
  double size_ = 0, largest_change_ = 0;       // [m] of the body; of the displacement so far, root mean square
  mfem::Vector trial_;                         // true dofs: displacement [m] of the step being tried
  mfem::Vector prescribed_, prescribed_rate_;  // at its end, where they are given
};

}  // namespace titin
