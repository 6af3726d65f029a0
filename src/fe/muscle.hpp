/// The muscle formulation as a Model: implicit steps of a total Lagrangian three-field finite element method.
#pragma once

#include <memory>

#include "fe/conservation.hpp"
#include "fe/ellipticity_watch.hpp"
#include "fe/muscle_fields.hpp"
#include "fe/muscle_history.hpp"
#include "fe/muscle_system.hpp"
#include "solve/model.hpp"

namespace titin {

class Muscle : public Model {
 public:
  /// The mesh must not be empty and the config free of errors.
  Muscle(NamedMesh mesh, MuscleConfig config);

  std::string name() const override { return "muscle"; }
  Step advance(double dt) override;
  void accept() override;
  void rewind() override { trial_ = u_; }
  double time() const override { return time_; }
  double largest_dt() const override;

  std::vector<Quantity> quantities() override { return quantities_; }
  std::vector<Quantity> conservation() override { return conservation_.list(); }
  std::string shown_quantity() const override { return history_.shown(); }
  void update_fields() override {
    fields_.update(u_, v_, system_.step().u_old);
    if (config_.ellipticity) fields_.set_ellipticity(watch_.smallest());
  }
  const std::vector<Field>& fields() const override { return fields_.fields(); }
  mfem::ParMesh& mesh() override { return *mesh_.mesh; }
  long unknowns() const override { return static_cast<long>(space_.GlobalTrueVSize()); }
  MuscleSystem& system() { return system_; }
  const mfem::Vector& displacement() const { return u_; }

 private:
  Newton& newton();
  void follow(const StepState& step);
  std::string predict(Step& step);
  double continued_part(const Step& step) const;
  std::string predict_from(const mfem::Vector& start, Step& step);

  NamedMesh mesh_;
  MuscleConfig config_;
  mfem::H1_FECollection collection_;
  mfem::ParFiniteElementSpace space_;
  MuscleSystem system_;
  std::unique_ptr<Newton> newton_;  // from the first step on
  MuscleHistory history_;
  EllipticityWatch watch_;
  Conservation conservation_;
  std::vector<Quantity> quantities_;  // of the accepted state
  MuscleFields fields_;
  double time_ = 0;
  bool remember_ = false;       // the history of the accepted step has still to become the past
  mfem::Vector u_, v_, trial_;  // true dofs: accepted displacement [m] and its rate [m/s]; the step being tried
};

}  // namespace titin
