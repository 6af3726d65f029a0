/// Numbers that a muscle run is followed by: reactions, energies, momenta, volume, means, markers.
///
/// Work is summed over the steps. For backward Euler it is that of the forces at the end of each step. With the weak
/// form tested by the step's displacement this makes an identity, to solver tolerance,
///
///   work of boundary and body forces = sum over terms of int P_term : dF dV + int rho a . du dV,
///
/// and what the stored and kinetic energies fall short of it is the dissipation of the scheme: the balance error, of
/// first order in dt. Schemes of second order take the mean of the forces at both ends, and have an error of that
/// order.
#pragma once

#include <string>
#include <vector>

#include "fe/attachment_history.hpp"
#include "fe/momenta.hpp"
#include "fe/muscle_system.hpp"
#include "fe/reaction_torques.hpp"
#include "solve/model.hpp"

namespace titin {

class MuscleHistory {
 public:
  explicit MuscleHistory(MuscleSystem& system);

  /// Takes in an accepted step: the system's forces are those at u. With dt = 0 (the start) no work is done.
  void update(const mfem::Vector& u, const mfem::Vector& v, const StepState& step);
  /// Collective.
  std::vector<Quantity> quantities() const;
  void walk(StateWalk& walk, const StateRows& cells, const StateRows& dofs);
  const std::string& shown() const { return shown_; }

 private:
  /// A term of a material: what it stores now and has dissipated, or, for terms that store nothing, the work done on it
  /// (negative while active fibres shorten).
  struct TermAccount {
    std::string name;
    bool stored, dissipates;
    bool has_curves = false;  ///< stores energy that a change of its parameters brings
    double value = 0, dissipated = 0, from_curves = 0;
  };
  struct Mean {
    std::string name;
    bool fibres = true;
    double volume = 0, stretch = 0, pennation = 0, rate = 0;  // sums weighted with current volume; [m^3]
  };
  void add_cell(int cell, const Material& material, const ThreeField& kernel, const PointInput& in);
  void add_terms(int cell, const Material& material, const ThreeField& kernel, const PointInput& in);
  double energy_of_curves(int cell, int term, const Material& material, const ThreeField& kernel, PointInput in) const;
  void add_means(int cell, const Material& material, const ThreeField& kernel, const PointInput& in);
  void add_support_dissipation(const StepState& step);
  void add_boundary_work(const mfem::Vector& u, const StepState& step);
  double work(const Mat3& P, const Mat3& F, const Mat3& F_old);
  void take_means();
  void take_markers();
  double add_support_quantities(std::size_t boundary, std::vector<Quantity>& list) const;
  Quantity reaction(int boundary, int component) const;

  MuscleSystem& system_;
  AttachmentHistory attachments_;
  ReactionTorques torques_;
  Momenta momenta_;
  std::vector<TermAccount> terms_;
  std::vector<std::vector<int>> terms_of_region_;  // [attribute][term of the material] -> account
  std::vector<Mean> means_;
  std::vector<std::vector<int>> cell_means_;
  struct Marker {
    std::string name;
    int cell = -1;  // -1: on another rank
    mfem::Vector shape;
  };
  std::vector<Marker> markers_;
  mfem::Vector u_, v_, forces_;
  // What does work, at the end of the last step: forces at dofs, and stresses of terms that store nothing.
  mfem::Vector boundary_forces_old_, body_forces_old_;
  std::vector<Mat3> P_old_;      // [cell][term][point]
  std::size_t next_stress_ = 0;  // of these, while cells are visited
  double end_weight_ = 1;        // of the forces at the end of a step in its work; those at its beginning have the rest
  double volumetric_ = 0, volume_ = 0, work_boundary_ = 0, work_body_ = 0, kinetic_at_start_ = -1;
  double stored_at_start_ = 0;
  std::vector<double> dissipated_by_support_;  // [boundary]; this rank's part
  std::string shown_;
};

}  // namespace titin
