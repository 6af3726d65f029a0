/// Numbers that a Lagrangian run is followed by: what it keeps, what boundaries bring, energies, orders, markers.
///
/// In the plane all are per metre of thickness. Heat is the internal energy that is not stored elastically: in solids
/// the entropy that the scheme has made.
#pragma once

#include "fv/lagrange_config.hpp"
#include "fv/scheme.hpp"
#include "solve/model.hpp"

namespace titin {

template <int D>
class LagrangeHistory {
 public:
  /// Collective.
  LagrangeHistory(const FlowScheme<D>& scheme, const std::vector<MarkerConfig>& markers,
                  const std::vector<TorqueConfig>& torques);

  /// Takes in the step that was just accepted. Collective.
  void follow(double dt);
  void walk(StateWalk& walk);
  /// Of the accepted state. Collective.
  std::vector<Quantity> quantities(double time) const;
  /// The largest over all states: what momentum and total energy miss beside what boundaries brought, over the largest
  /// of their kind. Collective.
  std::vector<Quantity> conservation() const;

 private:
  struct Kept {
    double mass = 0, energy = 0, kinetic = 0;
    Vector<D> momentum{};
    Vec3 angular{};
  };
  struct Marker {
    std::string name;
    int cell = -1;                      // -1: another rank's
    std::array<double, D + 1> share{};  // of the cell's nodes
  };
  struct Torque {
    TorqueConfig config;
    Vec3 moment{};  // of the last step, all ranks [N m]
  };
  Kept kept() const;
  void follow_torques(double dt);
  void take_marker(const MarkerConfig& config);
  void add_energies(double time, std::vector<Quantity>& list) const;
  void add_boundaries(std::vector<Quantity>& list) const;
  void add_cells(std::vector<Quantity>& list) const;
  void add_extent(std::vector<Quantity>& list) const;
  void add_markers(std::vector<Quantity>& list) const;

  const FlowScheme<D>& scheme_;
  std::vector<Marker> markers_;
  std::vector<Torque> torques_;
  std::vector<typename Boundary<D>::Force> forces_;  // of the last step, by condition, all ranks
  Kept start_, now_;
  Vector<D> impulse_{};  // of all boundaries since the start [N s]
  double work_ = 0;      // [J]
  double momentum_error_ = 0, energy_error_ = 0, momentum_scale_ = 0, energy_scale_ = 0;
};

extern template class LagrangeHistory<2>;
extern template class LagrangeHistory<3>;

}  // namespace titin
