/// Numbers that a rod is followed by: forces at its ends, stretches, energies, markers.
///
/// Work is summed over the steps as the scheme weighs the forces at both ends of each (StepRule::work_weight); what
/// stored and kinetic energies fall short of it is the dissipation of the scheme.
#pragma once

#include <string>
#include <vector>

#include "rod/rod_system.hpp"
#include "solve/model.hpp"

namespace titin {

class RodHistory {
 public:
  explicit RodHistory(RodSystem& system);

  /// Takes in an accepted step: the system's forces are those at u. `v` is the scheme's velocity, `seen` that of
  /// fibre rates.
  void update(const mfem::Vector& u, const mfem::Vector& v, const mfem::Vector& seen);
  void walk(StateWalk& walk);
  const std::vector<Quantity>& quantities() const { return list_; }
  const std::string& shown() const { return shown_; }

 private:
  /// What a term stores now, or the work done on it since the start.
  struct Account {
    std::string name;
    bool stored, dissipates;
    double value = 0, dissipated = 0;
    std::vector<double> stress_old;  // [points], of a term that stores nothing
  };
  void add_ends(const mfem::Vector& u);
  void add_energies(const mfem::Vector& u, const mfem::Vector& v);
  void add_term(Account& account, int term, const RodSystem::Part& part, const UniaxialPoints& points);
  void add_boundary_work(const mfem::Vector& u);
  void add_means(const mfem::Vector& u, const mfem::Vector& seen);
  void add_markers(const mfem::Vector& u, const mfem::Vector& seen);

  RodSystem& system_;
  std::vector<std::vector<Account>> accounts_;  // [part][term]
  std::vector<Quantity> list_;
  mfem::Vector end_forces_old_;
  double work_ = 0, energy_at_start_ = 0;
  bool started_ = false;
  std::string shown_;
};

}  // namespace titin
