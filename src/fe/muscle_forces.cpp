/// The forces of MuscleSystem: the residual, cell by cell, kept apart for the accounts of work, and the potential that
/// it is the gradient of where there is one.
#include <limits>

#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "fe/muscle_system.hpp"

namespace titin {

/// Local-dof vectors of a residual, kept apart for the accounts of work.
struct MuscleSystem::LocalForces {
  explicit LocalForces(int size)
      : internal(size), inertia(size), body(size), load(size), support(size), absolute(size) {
    for (auto* v : {&internal, &inertia, &body, &load, &support, &absolute}) *v = 0.0;
  }
  mfem::Vector internal, inertia, body, load, support, absolute;
};

bool MuscleSystem::residual(const mfem::Vector& u, mfem::Vector& R) {
  Timers::Scope timer("residual");
  mfem::Vector a_true(size()), a(space_.GetVSize());
  for (int i = 0; i < size(); ++i)
    a_true(i) = moving() ? step_.inertia_factor * (u(i) - step_.u_old(i)) + step_.known_inertia(i) : 0.0;
  space_.GetProlongationMatrix()->Mult(a_true, a);
  const LocalVectors local(*this, u);
  LocalForces local_forces(space_.GetVSize());
  int bad_cell = -1;
  for (int cell = 0; cell < space_.GetNE() && bad_cell < 0; ++cell)
    if (!add_cell_forces(cell, local, a, local_forces)) bad_cell = cell;
  if (any_of(bad_cell >= 0)) {
    set_domain_error(bad_cell, bad_cell >= 0 ? std::max(kernel_.bad_point(), conserving_.bad_point()) : -1);
    R = 0.0;
    return false;
  }
  body_forces_ = to_true(local_forces.body);
  load_forces_ = to_true(local_forces.load);
  support_forces_ = to_true(local_forces.support);
  inertial_forces_ = to_true(local_forces.inertia);
  mfem::Vector total = to_true(local_forces.absolute);
  update_links(u);
  links_.add(support_forces_, total);
  plates_.update(constraints_.rails(), load_time(), a_true);
  plates_.add_sizes(constraints_.rails(), total);
  static_forces_ = to_true(local_forces.internal);
  static_forces_ -= body_forces_;
  static_forces_ -= load_forces_;
  static_forces_ -= support_forces_;
  force_scale_ = std::max(std::sqrt(sum(total * total)), force_floor_ / config_.newton.tolerance);
  balance(R);
  return true;
}

/// The residual from the forces at both ends of the step, and the reactions at its end.
void MuscleSystem::balance(mfem::Vector& R) {
  const double w = step_.force_weight, m = step_.inertia_weight;
  R = static_forces_;
  R.Add(1 / w, inertial_forces_);
  if (w != 1) R.Add((1 - w) / w, static_forces_old_);
  constraints_.condense(R);
  plates_.add(constraints_.rails(), w, R);
  forces_ = static_forces_;
  if (step_.conserving) {  // those in the middle of the step: their work is exact
    forces_ += inertial_forces_;
    return;
  }
  forces_.Add(1 / m, inertial_forces_);
  if (m != 1) forces_.Add(-(1 - m) / m, inertial_forces_old_);
}

/// Links act where loads do in the step.
void MuscleSystem::update_links(const mfem::Vector& u) {
  if (!links_.any()) return;
  mfem::Vector place(u), v(step_.known_velocity);
  if (step_.conserving) add(0.5, u, 0.5, step_.u_old, place);
  if (v.Size() > 0) {
    v.Add(step_.velocity_factor, u);
    v.Add(-step_.velocity_factor, step_.u_old);
  }
  links_.update(place, v);
}

const double* MuscleSystem::load_position() {
  if (!step_.conserving) return u_cell_.data();
  for (std::size_t c = 0; c < middle_cell_.size(); ++c) middle_cell_[c] = 0.5 * (u_cell_[c] + u_old_cell_[c]);
  return middle_cell_.data();
}

/// Where, and how fast, the supports of the cell that deform() was called for are met.
SupportMotion MuscleSystem::support_motion(int cell, const LocalVectors& local) {
  if (local.known_velocity.Size() == 0) return {load_position(), nullptr, 0};
  gather(cell, local.known_velocity, velocity_cell_.data());
  for (int c = 0; c < tables_.values(cell); ++c)
    velocity_cell_[c] += step_.velocity_factor * (u_cell_[c] - u_old_cell_[c]);
  return {load_position(), velocity_cell_.data(), step_.velocity_factor};
}

FaceLoads::MotionOfCell MuscleSystem::motion_of(const std::vector<double>& u_cells,
                                                const std::vector<double>& v_cells) const {
  return [&](int cell) { return SupportMotion{&u_cells[first_value(cell)], &v_cells[first_value(cell)], 0}; };
}

bool MuscleSystem::augment(const mfem::Vector& u) {
  const std::vector<double> u_cells = cell_values(u);
  const auto motion = motion_of(u_cells, u_cells);
  if (!any_of(loads_.augmentation_error(load_time(), motion) > 1)) return false;
  loads_.augment(load_time(), motion);
  return true;
}

bool MuscleSystem::add_internal_forces(int cell, double* r) {
  const PointInput in = point_input(cell);
  if (!step_.conserving) {
    kernel_.add_forces(cell, material(cell), in, r);
    return true;
  }
  if (!conserving_.deform(cell, material(cell), kernel_, kernel_.points(in), false)) return false;
  conserving_.add_forces(cell, kernel_, r);
  return true;
}

bool MuscleSystem::has_potential() const {
  if (step_.conserving || loads_.has_follower() || links_.has_damper()) return false;
  for (const BoundaryConfig& boundary : config_.boundaries)
    if (boundary.support.has_damper()) return false;
  for (const auto& [name, material] : config_.materials)
    for (const TermInfo& term : material->terms())
      if (!term.stores_energy || term.dissipates) return false;
  return true;
}

/// Stored energy, that of the inertia a . M a / (2 inertia_factor), and minus what dead loads and the forces of the
/// last step have done.
double MuscleSystem::potential(const mfem::Vector& u) {
  mfem::Vector R(size());
  if (!residual(u, R)) return std::numeric_limits<double>::infinity();
  const double w = step_.force_weight;
  double energy = 0;
  for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
    std::vector<double> W(tables_.points(cell));
    material.potential(kernel.points(point_input(cell)), W.data());
    for (int q = 0; q < tables_.points(cell); ++q)
      energy += tables_.weight(cell, q) * (W[q] + material.volumetric(kernel.dilatation()[q]).U);
  });
  const std::vector<double> u_cells = cell_values(u);
  for (const BoundaryConfig& boundary : config_.boundaries)
    energy += loads_.support_state(boundary, step_.time, motion_of(u_cells, u_cells)).potential;
  const double of_links = links_.energy(u);
  const double of_plates = plates_.potential(constraints_.rails(), w, moving() ? step_.inertia_factor : 0, u);
  for (int i = 0; i < size(); ++i) {
    energy -= (load_forces_(i) + body_forces_(i)) * u(i);
    if (w != 1) energy += (1 - w) / w * static_forces_old_(i) * u(i);
    if (!moving()) continue;
    const double a = step_.inertia_factor * (u(i) - step_.u_old(i)) + step_.known_inertia(i);
    energy += 0.5 / (step_.inertia_factor * w) * a * inertial_forces_(i);
  }
  return sum(energy) + of_links + of_plates;
}

bool MuscleSystem::add_cell_forces(int cell, const LocalVectors& local, const mfem::Vector& acceleration,
                                   LocalForces& forces) {
  if (!deform(cell, local)) return false;
  const int n = tables_.values(cell);
  std::vector<double> internal(n), inertia(n), body(n), load(n), support(n);
  if (!add_internal_forces(cell, internal.data())) return false;
  if (loads_.on_cell(cell)) {
    loads_.add(cell, load_time(), load_position(), load.data(), nullptr);
    loads_.add_supports(cell, load_time(), support_motion(cell, local), support.data(), nullptr);
  }
  add_inertia_and_body(cell, acceleration, inertia.data(), body.data());
  for (int c = 0; c < n; ++c) {
    const int dof = dofs(cell)[c];
    forces.internal(dof) += internal[c];
    forces.inertia(dof) += inertia[c];
    forces.body(dof) += body[c];
    forces.load(dof) -= load[c];  // loads come as residuals, minus a force
    forces.support(dof) -= support[c];
    forces.absolute(dof) +=
        std::abs(internal[c]) + std::abs(inertia[c]) + std::abs(body[c]) + std::abs(load[c]) + std::abs(support[c]);
  }
  return true;
}

/// Nodal forces of density * acceleration, and of density * body acceleration.
void MuscleSystem::add_inertia_and_body(int cell, const mfem::Vector& acceleration, double* inertia,
                                        double* body) const {
  const int nodes = tables_.nodes(cell), dimension = tables_.dimension();
  std::vector<double> a(dimension * nodes);
  gather(cell, acceleration, a.data());
  const double scale = config_.body_scale(load_time()), density = material(cell).density();
  for (int q = 0; q < tables_.points(cell); ++q) {
    const double mass = density * tables_.weight(cell, q);
    const double* N = tables_.shape(cell, q);
    for (int i = 0; i < dimension; ++i) {
      double at_point = 0;
      for (int b = 0; b < nodes; ++b) at_point += N[b] * a[i * nodes + b];
      const double pull = mass * scale * config_.body_acceleration[i];
      for (int b = 0; b < nodes; ++b) {
        inertia[i * nodes + b] += mass * at_point * N[b];
        body[i * nodes + b] += pull * N[b];
      }
    }
  }
}

}  // namespace titin
