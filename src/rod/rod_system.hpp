/// The equations of one implicit step of a rod, over all of its nodes: each rank holds them all, as there are few.
///
///   R(u) = f(u) + (1 - w) / w f_n + M a / w = 0 at free nodes,   f(u) = int A N(m, m') dN/dX dX - loads,
///   a = inertia_factor (u - u_n) + known_inertia,   m = 1 + du/dX,
///
/// with the numbers of the time integration (rod/rod_step.hpp) and the stress N of rod/uniaxial.hpp.
#pragma once

#include <string>
#include <vector>

#include "mesh/history.hpp"
#include "rod/lattice.hpp"
#include "rod/rod_step.hpp"
#include "rod/uniaxial.hpp"

namespace titin {

class RodSystem {
 public:
  explicit RodSystem(const RodConfig& config);

  /// R(u), zero at nodes whose displacement is given. Returns false when an element is turned inside out.
  bool residual(const mfem::Vector& u, mfem::Vector& R);
  /// dR/du at u, unit rows at nodes whose displacement is given.
  BandMatrix tangent(const mfem::Vector& u);
  double force_scale() const { return force_scale_; }  ///< [N] at the last residual()
  const std::string& domain_error() const { return domain_error_; }

  RodStep& step() { return step_; }
  const mfem::Array<int>& given() const { return given_; }
  void set_given(double time, mfem::Vector& u) const;        ///< values at given() nodes
  void set_given_rates(double time, mfem::Vector& v) const;  ///< from before
  /// The forces of the last residual() become those of the beginning of the next step.
  void accept_forces();
  void commit_history();
  void walk(StateWalk& walk);  ///< what the accepted step left to the next
  /// M a = -R where nodes are free and have mass; 0 elsewhere.
  mfem::Vector initial_acceleration(const mfem::Vector& R) const;

  const mfem::Vector& forces() const { return forces_; }            ///< reactions where given [N]
  const mfem::Vector& load_forces() const { return load_forces_; }  ///< [N]
  const Lattice& lattice() const { return lattice_; }
  const RodConfig& config() const { return config_; }

  /// The points of the muscle, or of the tendon, at u in the system's step; good until the next call.
  struct Part {
    std::string name;
    Uniaxial law;
    int first, count;  // of the lattice's points
  };
  const std::vector<Part>& parts() const { return parts_; }
  UniaxialPoints points_at(const Part& part, const mfem::Vector& u);
  double* history(const Part& part) { return history_.old(static_cast<int>(&part - parts_.data())); }

 private:
  bool moving() const { return config_.has_mass() && step_.dt > 0; }
  bool stretch(const mfem::Vector& u);
  void stress(double* N, double* dN);
  UniaxialPoints points_of(const Part& part);
  mfem::Vector loads() const;
  void balance(mfem::Vector& R);
  void start_history();

  const RodConfig& config_;
  Lattice lattice_;
  std::vector<Part> parts_;
  History history_;
  RodStep step_;
  mfem::Array<int> given_;
  std::vector<const Table*> given_values_;
  std::vector<double> stretch_, stretch_old_, rate_old_;  // at points
  mfem::Vector forces_, load_forces_, static_forces_, inertial_forces_, static_forces_old_, inertial_forces_old_;
  double force_scale_ = 0;
  std::string domain_error_;
};

}  // namespace titin
