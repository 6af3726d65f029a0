/// Numbers that what is attached to a muscle is followed by: plates on rails with their loads, links between
/// boundaries.
///
/// They are part of the system whose energy is balanced: what drives a plate does work on it, loads have kinetic
/// energy, springs store and dampers dissipate.
#pragma once

#include <vector>

#include "fe/muscle_system.hpp"
#include "solve/model.hpp"

namespace titin {

class AttachmentHistory {
 public:
  explicit AttachmentHistory(MuscleSystem& system);

  /// Takes in an accepted step; the same u, v, step and weight of its end as MuscleHistory. Collective.
  void update(const mfem::Vector& u, const mfem::Vector& v, const StepState& step, double end_weight);
  void walk(StateWalk& walk);
  void list(std::vector<Quantity>& quantities) const;
  double work() const;      ///< of the forces on plates, so far [J]
  double in_loads() const;  ///< what their loads have got since the start [J]
  double in_links() const;  ///< what links hold and have dissipated [J]

 private:
  struct Plate {
    double travel = 0, speed = 0, kinetic = 0, kinetic_at_start = -1, work = 0, force_old = 0;
  };
  struct Joint {
    double elongation = 0, dissipated = 0;
  };
  void update_plates(const mfem::Vector& u, const mfem::Vector& v, const StepState& step, double end_weight);
  void list_links(std::vector<Quantity>& quantities) const;

  MuscleSystem& system_;
  std::vector<Plate> plates_;  // as in Rails::list()
  std::vector<Joint> joints_;  // as in Links::list()
};

}  // namespace titin
