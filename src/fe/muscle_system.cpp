#include "fe/muscle_system.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/parallel.hpp"

namespace titin {

MuscleSystem::MuscleSystem(const MuscleConfig& config, const NamedMesh& mesh, mfem::ParFiniteElementSpace& space)
    : config_(config),
      space_(space),
      tables_(space, config.elements, config.points(), mesh.thickness),
      constraints_(config.boundaries, mesh, space),
      loads_(config.boundaries, mesh, config.elements, space, config.points()),
      links_(config.links, mesh, config.elements, space, config.points()),
      kernel_(tables_),
      conserving_(tables_),
      u_cell_(tables_.most_values()),
      u_old_cell_(tables_.most_values()),
      rate_old_cell_(tables_.most_values()),
      middle_cell_(tables_.most_values()),
      velocity_cell_(tables_.most_values()),
      forces_(space.GetTrueVSize()),
      body_forces_(space.GetTrueVSize()),
      load_forces_(space.GetTrueVSize()),
      support_forces_(space.GetTrueVSize()),
      static_forces_(space.GetTrueVSize()),
      inertial_forces_(space.GetTrueVSize()) {
  mfem::Array<int> dofs;
  for (int cell = 0; cell < space.GetNE(); ++cell) {
    space.GetElementVDofs(cell, dofs);
    first_value_.push_back(static_cast<int>(cell_dofs_.size()));
    cell_dofs_.insert(cell_dofs_.end(), dofs.begin(), dofs.end());
    materials_.push_back(config.materials.at(config.material_of_region.at(mesh.mesh->GetAttribute(cell))).get());
  }
  if (config.integrator.scheme != Scheme::energy_momentum)
    matrices_ = CellMatrices::create(space_, tables_, symmetric_materials());
  if (constraints_.rails().any() || links_.any())
    border_ = std::make_unique<TangentBorder>(space, constraints_, links_);
  start_history();
  for (mfem::Vector* v : {&step_.u_old, &step_.known_inertia, &forces_, &body_forces_, &load_forces_, &support_forces_,
                          &static_forces_, &inertial_forces_}) {
    v->SetSize(space.GetTrueVSize());
    *v = 0.0;
  }
  accept_forces();
}

StepState::StepState(const Integrator& integrator, double time)
    : time(time),
      dt(integrator.dt()),
      u_old(integrator.u()),
      inertia_factor(integrator.inertia_factor()),
      inertia_weight(integrator.rule().inertia_weight),
      known_inertia(integrator.known_inertia()),
      velocity_factor(integrator.velocity_factor()),
      known_velocity(integrator.known_velocity()),
      force_weight(integrator.rule().force_weight),
      work_weight(integrator.rule().work_weight) {
  conserving = integrator.config().scheme == Scheme::energy_momentum;
  if (conserving) {  // loads act in the middle of the step
    velocity_factor = 1 / dt;
    known_velocity = 0.0;
  }
  const bool lines = integrator.config().velocity == VelocityForm::lines;
  if (integrator.config().scheme == Scheme::semi_implicit) {
    rate_dt = integrator.dt_old() > 0 ? integrator.dt_old() : dt;
    rate_known = true;
    rate_old = u_old;
    rate_old.Add(-rate_dt, integrator.seen_velocity());
  } else if (lines && !conserving) {  // Grad v = (F - F_rate_old) / rate_dt
    rate_dt = 1 / integrator.velocity_factor();
    rate_old = u_old;
    rate_old.Add(-rate_dt, integrator.known_velocity());
  }
}

StepState::StepState(double time, double dt, const mfem::Vector& u_old, const mfem::Vector& v_old)
    : time(time), dt(dt), u_old(u_old), inertia_factor(1 / (dt * dt)), known_inertia(v_old) {
  known_inertia /= -dt;
}

void MuscleSystem::accept_forces() {
  loads_.accept_multipliers();
  plates_.accept();
  static_forces_old_ = static_forces_;
  inertial_forces_old_ = inertial_forces_;
}

bool MuscleSystem::symmetric_materials() const {
  bool all = true;
  for (const auto& [name, material] : config_.materials)
    all = all && material->symmetric_tangent(config_.varying_rate());
  return all;
}

void MuscleSystem::start_history() {
  std::vector<int> row_size, points;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    row_size.push_back(material(cell).history_size());
    points.push_back(tables_.points(cell));
  }
  history_ = History(row_size, points);
  PointInput rest;
  rest.n = 1;
  rest.F = rest.F_old = &identity;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    const Vec3 fibre = material(cell).fibre(), second_fibre = material(cell).second_fibre();
    PointInput at_points = rest;
    config_.point_fields.set(cell, at_points);
    for (int q = 0; q < tables_.points(cell); ++q) {
      rest.fibre = at_points.fibre ? at_points.fibre + q : &fibre;
      rest.second_fibre = at_points.second_fibre ? at_points.second_fibre + q : &second_fibre;
      rest.fields = at_points.fields ? at_points.fields + q * material(cell).fields().numbers.size() : nullptr;
      material(cell).start_history(rest, history_.now(cell) + q * row_size[cell]);
    }
  }
  history_.commit();
}

MuscleSystem::LocalVectors::LocalVectors(MuscleSystem& system, const mfem::Vector& u_true) {
  const auto to_local = [&](const mfem::Vector& from, mfem::Vector& to) {
    to.SetSize(system.space_.GetVSize());
    system.space_.GetProlongationMatrix()->Mult(from, to);
  };
  to_local(u_true, u);
  to_local(system.step_.u_old, u_old);
  if (system.step_.rate_dt > 0) to_local(system.step_.rate_old, rate_old);
  if (system.step_.known_velocity.Size() > 0) to_local(system.step_.known_velocity, known_velocity);
}

void MuscleSystem::gather(int cell, const mfem::Vector& local, double* values) const {
  for (int c = 0; c < tables_.values(cell); ++c) values[c] = local(dofs(cell)[c]);
}

std::vector<double> MuscleSystem::cell_values(const mfem::Vector& v) const {
  mfem::Vector local(space_.GetVSize());
  space_.GetProlongationMatrix()->Mult(v, local);
  std::vector<double> values(cell_dofs_.size());
  for (std::size_t c = 0; c < values.size(); ++c) values[c] = local(cell_dofs_[c]);
  return values;
}

/// Returns false when the cell is inside out.
bool MuscleSystem::deform(int cell, const LocalVectors& local) {
  gather(cell, local.u, u_cell_.data());
  gather(cell, local.u_old, u_old_cell_.data());
  if (!kernel_.deform(cell, material(cell), u_cell_.data(), u_old_cell_.data())) return false;
  if (step_.rate_dt == 0) return true;
  gather(cell, local.rate_old, rate_old_cell_.data());
  kernel_.deform_rate(cell, rate_old_cell_.data(), step_.rate_dt, step_.rate_known);
  return true;
}

PointInput MuscleSystem::point_input(int cell) const {
  PointInput in;
  in.time = step_.time;
  in.dt = step_.dt;
  in.rate = step_.dt > 0 ? config_.rate() : FibreRate::none;
  in.history = history_.old(cell);
  in.new_history = history_.now(cell);
  config_.point_fields.set(cell, in);
  return in;
}

mfem::Vector MuscleSystem::to_true(const mfem::Vector& local) const {
  mfem::Vector summed(space_.GetTrueVSize());
  space_.GetProlongationMatrix()->MultTranspose(local, summed);
  return summed;
}

/// Says where: the point of the lowest rank that has one. Collective.
void MuscleSystem::set_domain_error(int cell, int point) {
  const double mine = cell >= 0 ? rank() : std::numeric_limits<double>::max(), first = min(mine);
  const bool winner = cell >= 0 && mine == first;
  std::vector<double> x(3, 0.0);
  if (winner) {
    mfem::Vector position(x.data(), tables_.dimension());
    space_.GetElementTransformation(cell)->Transform(tables_.rule(cell).IntPoint(std::max(point, 0)), position);
  }
  sum(x);
  domain_error_ =
      fmt::format("a cell turns inside out (volume ratio not positive) near undeformed ({:.4g}, {:.4g}, {:.4g}) m",
                  x[0], x[1], x[2]);
}

}  // namespace titin
