/// The Lagrangian formulation as a Model: explicit steps of the finite volume scheme, its history, fields and errors.
#pragma once

#include <memory>

#include "fv/lagrange_config.hpp"
#include "fv/lagrange_fields.hpp"
#include "fv/lagrange_history.hpp"
#include "fv/lagrange_means.hpp"
#include "solve/model.hpp"

namespace titin {

template <int D>
class Lagrange final : public Model {
 public:
  /// The mesh must hold simplices of dimension D and the config must be free of errors. Collective.
  Lagrange(NamedMesh mesh, LagrangeConfig config);

  std::string name() const override { return "lagrange"; }
  Step advance(double dt) override;
  void accept() override;
  void rewind() override {}  // the accepted state is never written to
  double time() const override { return time_; }
  double largest_dt() const override { return scheme_.largest_dt(); }

  std::vector<double> kinks() const override { return config_.kinks(); }
  std::vector<Quantity> quantities() override;
  std::vector<Quantity> conservation() override { return history_.conservation(); }
  std::vector<Quantity> errors() override;
  std::string shown_quantity() const override { return "energy_kinetic"; }
  void update_fields() override { fields_.update(time_); }
  const std::vector<Field>& fields() const override { return fields_.fields(); }
  mfem::ParMesh& mesh() override { return *mesh_.mesh; }
  long unknowns() const override;
  double bytes_per_step() const override;
  void walk_state(StateWalk& walk) override;
  const FlowScheme<D>& scheme() const { return scheme_; }

 private:
  std::vector<BoundaryCondition<D>> conditions() const;
  std::vector<CellStart> start() const;
  std::pair<FlowPoint, int> start_of(int cell) const;
  bool has_collapsed() const { return scheme_.largest_dt() < config_.fv.collapse * longest_dt_; }
  std::string collapse() const;
  void add_surface_errors(std::vector<Quantity>& list) const;

  NamedMesh mesh_;
  LagrangeConfig config_;
  SimplexMesh<D> cells_;
  NodeExchange exchange_;
  FlowScheme<D> scheme_;
  LagrangeHistory<D> history_;
  LagrangeMeans<D> means_;
  LagrangeFields<D> fields_;
  double time_ = 0, dt_ = 0;  // of the accepted state; of the step being tried
  double longest_dt_ = 0;     // that cells have allowed so far [s]
};

/// In the dimension of the mesh. Collective.
std::unique_ptr<Model> make_lagrange(NamedMesh mesh, LagrangeConfig config);

}  // namespace titin
