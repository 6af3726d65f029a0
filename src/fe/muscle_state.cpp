// What a muscle run keeps between its steps, in a walk (solve/state_walk.hpp).
#include "base/parallel.hpp"
#include "fe/muscle.hpp"

namespace titin {

void StepState::walk(StateWalk& walk, const StateRows& dofs) {
  walk.number("step_time", time);
  walk.number("step_dt", dt);
  walk.number("step_inertia_factor", inertia_factor);
  walk.number("step_inertia_weight", inertia_weight);
  walk.number("step_velocity_factor", velocity_factor);
  walk.number("step_force_weight", force_weight);
  walk.number("step_work_weight", work_weight);
  walk.number("step_rate_dt", rate_dt);
  walk.number("step_rate_known", rate_known);
  walk.number("step_conserving", conserving);
  walk.vector("step_u_old", dofs, u_old);
  walk.vector("step_known_inertia", dofs, known_inertia);
  walk.vector("step_known_velocity", dofs, known_velocity);
  if (rate_dt > 0) walk.vector("step_rate_old", dofs, rate_old);
}

void MuscleSystem::walk(StateWalk& walk, const StateRows& cells, const StateRows& dofs) {
  step_.walk(walk, dofs);
  std::vector<int> sizes;
  for (int cell = 0; cell < space_.GetNE(); ++cell)
    sizes.push_back(tables_.points(cell) * static_cast<int>(material(cell).history_size()));
  walk.ragged("history_old", cells, sizes, history_.all_old().data());
  walk.ragged("history_now", cells, sizes, history_.all_now().data());
  loads_.walk(walk, cells);
  plates_.walk(walk);
  walk.vector("static_forces", dofs, static_forces_old_);
  walk.vector("inertial_forces", dofs, inertial_forces_old_);
  static_forces_ = static_forces_old_;
  inertial_forces_ = inertial_forces_old_;
}

void MuscleHistory::walk(StateWalk& walk, const StateRows& cells, const StateRows& dofs) {
  attachments_.walk(walk);
  std::vector<double> sums = {work_boundary_, work_body_, kinetic_at_start_, stored_at_start_};
  for (const TermAccount& term : terms_) sums.insert(sums.end(), {term.value, term.dissipated, term.from_curves});
  sums.insert(sums.end(), dissipated_by_support_.begin(), dissipated_by_support_.end());
  walk.parts("accounts", sums);
  auto next = sums.begin();
  for (double* sum : {&work_boundary_, &work_body_, &kinetic_at_start_, &stored_at_start_}) *sum = *next++;
  for (TermAccount& term : terms_) term.value = *next++, term.dissipated = *next++, term.from_curves = *next++;
  for (double& dissipated : dissipated_by_support_) dissipated = *next++;
  walk.vector("boundary_forces", dofs, boundary_forces_old_);
  walk.vector("body_forces", dofs, body_forces_old_);
  std::vector<int> sizes;
  for (int cell = 0; cell < system_.space().GetNE(); ++cell) {
    int terms = 0;
    for (int account : terms_of_region_[system_.space().GetParMesh()->GetAttribute(cell)])
      terms += !terms_[account].stored;
    sizes.push_back(9 * terms * system_.tables().points(cell));
  }
  walk.ragged("stress_of_terms", cells, sizes, P_old_.empty() ? nullptr : P_old_.front().data());
}

void AttachmentHistory::walk(StateWalk& walk) {
  std::vector<double*> all;
  for (Plate& p : plates_)
    all.insert(all.end(), {&p.travel, &p.speed, &p.kinetic, &p.kinetic_at_start, &p.work, &p.force_old});
  for (Joint& joint : joints_) all.insert(all.end(), {&joint.elongation, &joint.dissipated});
  std::vector<double> values;
  for (const double* x : all) values.push_back(*x);
  walk.common("attachments", values);
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = values.at(k);
}

void Conservation::walk(StateWalk& walk) {
  walk.number("conservation_balance_error", balance_error_);
  walk.number("conservation_largest_energy", largest_energy_);
  walk.number("conservation_volume_at_start", volume_at_start_);
  walk.number("conservation_volume_change", volume_change_);
}

void Muscle::walk_state(StateWalk& walk) {
  const StateRows cells{"cells", mesh_.numbers.cell}, dofs{"dofs", true_dof_numbers(space_, mesh_.numbers.cell)};
  integrator_.walk(walk, dofs);
  system_.walk(walk, cells, dofs);
  history_.walk(walk, cells, dofs);
  conservation_.walk(walk);
  watch_.walk(walk);
  walk.number("time", time_);
  walk.number("remember", remember_);
  walk.number("largest_change", largest_change_);
  std::vector<double> values;
  for (const Quantity& q : quantities_) values.push_back(q.value);
  walk.common("quantities", values);
  if (!walk.reading()) return;
  for (std::size_t k = 0; k < quantities_.size(); ++k) quantities_[k].value = values.at(k);
  trial_ = displacement();
  if (recovery_) recovery_->update(displacement());
  if (config_.ellipticity) watch_.update(displacement(), system_.step());
}

void Muscle::forget() {
  if (newton_) newton_->linear().forget();
}

}  // namespace titin
