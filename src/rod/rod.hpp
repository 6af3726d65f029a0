/// The rod formulation as a Model: muscle in one dimension, as a continuum, a chain of masses or one Hill element.
///
/// Every rank holds the whole rod and computes the same numbers: there is nothing to exchange.
#pragma once

#include <memory>

#include "rod/rod_fields.hpp"
#include "rod/rod_history.hpp"
#include "rod/rod_system.hpp"
#include "solve/model.hpp"

namespace titin {

class Rod : public Model {
 public:
  /// `mesh` is what RodConfig::bind made; the config must be free of errors.
  Rod(NamedMesh mesh, RodConfig config);

  std::string name() const override { return "rod"; }
  Step advance(double dt) override;
  void accept() override;
  void rewind() override { trial_ = displacement(); }
  double time() const override { return time_; }
  double largest_dt() const override;
  std::vector<double> kinks() const override;

  std::vector<Quantity> quantities() override { return quantities_; }
  std::string shown_quantity() const override { return history_.shown(); }
  void update_fields() override { fields_.update(displacement(), integrator_.seen_velocity()); }
  const std::vector<Field>& fields() const override { return fields_.fields(); }
  mfem::ParMesh& mesh() override { return *mesh_.mesh; }
  long unknowns() const override { return system_.lattice().nodes(); }
  void walk_state(StateWalk& walk) override;
  RodSystem& system() { return system_; }
  const mfem::Vector& displacement() const { return integrator_.u(); }
  const Integrator& motion() const { return integrator_; }

 private:
  void start();
  void follow();
  void estimate_error(Step& step);
  mfem::Vector continued(double dt) const;

  NamedMesh mesh_;
  RodConfig config_;
  RodSystem system_;
  Integrator integrator_;
  RodHistory history_;
  RodFields fields_;
  std::vector<Quantity> quantities_;
  double time_ = 0, largest_change_ = 0;
  bool remember_ = false;  // the history of the accepted step has still to become the past
  mfem::Vector trial_, prescribed_, prescribed_rate_;
};

}  // namespace titin
