#include "fe/muscle_system.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {

namespace {

/// Forces below this part of (largest stiffness x size of the body) are round-off: displacements carry 16 digits.
constexpr double round_off = 1e-15;

}  // namespace

MuscleSystem::MuscleSystem(const MuscleConfig& config, const NamedMesh& mesh, mfem::ParFiniteElementSpace& space)
    : config_(config),
      space_(space),
      tables_(space, config.order, config.points()),
      constraints_(config.boundaries, mesh, space),
      loads_(config.boundaries, mesh, tables_, space, config.points()),
      kernel_(tables_),
      u_cell_(3 * tables_.nodes()),
      u_old_cell_(3 * tables_.nodes()),
      forces_(space.GetTrueVSize()),
      body_forces_(space.GetTrueVSize()),
      load_forces_(space.GetTrueVSize()) {
  mfem::Array<int> dofs;
  for (int cell = 0; cell < space.GetNE(); ++cell) {
    space.GetElementVDofs(cell, dofs);
    cell_dofs_.insert(cell_dofs_.end(), dofs.begin(), dofs.end());
    materials_.push_back(config.materials.at(config.material_of_region.at(mesh.mesh->GetAttribute(cell))).get());
  }
  matrices_ = CellMatrices::create(space_, tables_, symmetric_materials());
  start_history();
  for (mfem::Vector* v : {&step_.u_old, &step_.v_old, &forces_, &body_forces_, &load_forces_}) {
    v->SetSize(space.GetTrueVSize());
    *v = 0.0;
  }
}

Assembly& MuscleSystem::assembly() {
  if (assembly_) return *assembly_;
  assembly_ = std::make_unique<Assembly>(space_, constrained_dofs());
  check(MatSetOption(assembly_->matrix(), MAT_SYMMETRIC,
                     symmetric_materials() && !loads_.has_follower() ? PETSC_TRUE : PETSC_FALSE));
  check(MatSetOption(assembly_->matrix(), MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  return *assembly_;
}

std::vector<char> MuscleSystem::constrained_dofs() const {
  std::vector<char> constrained(space_.GetVSize());
  for (int dof = 0; dof < space_.GetVSize(); ++dof) constrained[dof] = constraints_.is_constrained_local(dof);
  return constrained;
}

std::unique_ptr<TangentAction> MuscleSystem::make_action(Precision precision) const {
  return TangentAction::create(space_, tables_, constrained_dofs(), symmetric_materials(), precision);
}

void MuscleSystem::set_action(const mfem::Vector& u, TangentAction& action) {
  Timers::Scope timer("tangent");
  const LocalVectors local(*this, u, step_.u_old);
  action.set([&](int cell) { return tangent_points(cell, local); });
}

TangentPoints MuscleSystem::tangent_points(int cell, const LocalVectors& local) {
  gather(cell, local);
  kernel_.deform(cell, material(cell), u_cell_.data(), u_old_cell_.data());
  return kernel_.tangent_points(cell, material(cell), point_input(cell), inertia(cell));
}

/// Calls take(cell, K) with each cell's tangent, loads left out.
void MuscleSystem::form_cells(const LocalVectors& local, const std::function<void(int, double*)>& take) {
  if (!matrices_) return form_cells_singly(local, take);
  const int cells = space_.GetNE();
  for (int first = 0; first < cells; first += matrices_->cells_at_once()) {
    const int count = std::min(matrices_->cells_at_once(), cells - first);
    matrices_->form(first, count, [&](int cell) { return tangent_points(cell, local); });
    for (int i = 0; i < count; ++i) take(first + i, matrices_->matrix(i));
  }
}

void MuscleSystem::form_cells_singly(const LocalVectors& local, const std::function<void(int, double*)>& take) {
  const int n = 3 * tables_.nodes();
  std::vector<double> K(n * n);
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    std::fill(K.begin(), K.end(), 0.0);
    gather(cell, local);
    kernel_.deform(cell, material(cell), u_cell_.data(), u_old_cell_.data());
    kernel_.add_tangent(cell, material(cell), point_input(cell), K.data());
    if (moving()) add_inertia_tangent(cell, K.data());
    take(cell, K.data());
  }
}

bool MuscleSystem::symmetric_materials() const {
  bool all = true;
  for (const auto& [name, material] : config_.materials) all = all && material->symmetric_tangent(config_.rate());
  return all;
}

void MuscleSystem::start_history() {
  std::vector<int> row_size;
  for (const Material* material : materials_) row_size.push_back(material->history_size());
  history_ = History(row_size, tables_.points());
  PointInput rest;
  rest.n = 1;
  rest.F = rest.F_old = &identity;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    const Vec3 fibre = material(cell).fibre(), second_fibre = material(cell).second_fibre();
    PointInput at_points = rest;
    config_.point_fields.set(cell, at_points);
    for (int q = 0; q < tables_.points(); ++q) {
      rest.fibre = at_points.fibre ? at_points.fibre + q : &fibre;
      rest.second_fibre = at_points.second_fibre ? at_points.second_fibre + q : &second_fibre;
      rest.fields = at_points.fields ? at_points.fields + q * material(cell).fields().numbers.size() : nullptr;
      material(cell).start_history(rest, history_.now(cell) + q * row_size[cell]);
    }
  }
  history_.commit();
}

MuscleSystem::LocalVectors::LocalVectors(MuscleSystem& system, const mfem::Vector& u_true,
                                         const mfem::Vector& u_old_true)
    : u(system.space_.GetVSize()), u_old(system.space_.GetVSize()) {
  system.space_.GetProlongationMatrix()->Mult(u_true, u);
  system.space_.GetProlongationMatrix()->Mult(u_old_true, u_old);
}

void MuscleSystem::gather(int cell, const mfem::Vector& local, double* values) const {
  const int n = 3 * tables_.nodes();
  for (int c = 0; c < n; ++c) values[c] = local(cell_dofs_[cell * n + c]);
}

std::vector<double> MuscleSystem::cell_values(const mfem::Vector& v) const {
  mfem::Vector local(space_.GetVSize());
  space_.GetProlongationMatrix()->Mult(v, local);
  std::vector<double> values(cell_dofs_.size());
  for (std::size_t c = 0; c < values.size(); ++c) values[c] = local(cell_dofs_[c]);
  return values;
}

void MuscleSystem::gather(int cell, const LocalVectors& local) {
  gather(cell, local.u, u_cell_.data());
  gather(cell, local.u_old, u_old_cell_.data());
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

/// Local-dof vectors of a residual, kept apart for the accounts of work.
struct MuscleSystem::LocalForces {
  explicit LocalForces(int size) : internal(size), inertia(size), body(size), load(size), absolute(size) {
    for (auto* v : {&internal, &inertia, &body, &load, &absolute}) *v = 0.0;
  }
  mfem::Vector internal, inertia, body, load, absolute;
};

bool MuscleSystem::residual(const mfem::Vector& u, mfem::Vector& R) {
  Timers::Scope timer("residual");
  mfem::Vector a_true(size()), a(space_.GetVSize());
  for (int i = 0; i < size(); ++i)
    a_true(i) = moving() ? ((u(i) - step_.u_old(i)) / step_.dt - step_.v_old(i)) / step_.dt : 0.0;
  space_.GetProlongationMatrix()->Mult(a_true, a);
  const LocalVectors local(*this, u, step_.u_old);
  LocalForces local_forces(space_.GetVSize());
  int bad_cell = -1;
  for (int cell = 0; cell < space_.GetNE() && bad_cell < 0; ++cell)
    if (!add_cell_forces(cell, local, a, local_forces)) bad_cell = cell;
  if (any_of(bad_cell >= 0)) {
    set_domain_error(bad_cell, bad_cell >= 0 ? kernel_.bad_point() : -1);
    R = 0.0;
    return false;
  }
  body_forces_ = to_true(local_forces.body);
  load_forces_ = to_true(local_forces.load);
  forces_ = to_true(local_forces.internal);
  forces_ += to_true(local_forces.inertia);
  forces_ -= body_forces_;
  forces_ -= load_forces_;
  const mfem::Vector total = to_true(local_forces.absolute);
  force_scale_ = std::max(std::sqrt(sum(total * total)), force_floor_);
  R = forces_;
  for (int dof : constraints_.dofs()) R(dof) = 0;
  return true;
}

/// Returns false when the cell is inside out.
bool MuscleSystem::add_cell_forces(int cell, const LocalVectors& local, const mfem::Vector& acceleration,
                                   LocalForces& forces) {
  gather(cell, local);
  if (!kernel_.deform(cell, material(cell), u_cell_.data(), u_old_cell_.data())) return false;
  const int n = 3 * tables_.nodes();
  std::vector<double> internal(n), inertia(n), body(n), load(n);
  kernel_.add_forces(cell, material(cell), point_input(cell), internal.data());
  loads_.add(cell, step_.time, u_cell_.data(), load.data(), nullptr);
  add_inertia_and_body(cell, acceleration, inertia.data(), body.data());
  for (int c = 0; c < n; ++c) {
    const int dof = cell_dofs_[cell * n + c];
    forces.internal(dof) += internal[c];
    forces.inertia(dof) += inertia[c];
    forces.body(dof) += body[c];
    forces.load(dof) -= load[c];  // loads come as residuals, minus a force
    forces.absolute(dof) += std::abs(internal[c]) + std::abs(inertia[c]) + std::abs(body[c]) + std::abs(load[c]);
  }
  return true;
}

/// Nodal forces of density * acceleration, and of density * body acceleration.
void MuscleSystem::add_inertia_and_body(int cell, const mfem::Vector& acceleration, double* inertia,
                                        double* body) const {
  const int nodes = tables_.nodes();
  std::vector<double> a(3 * nodes);
  gather(cell, acceleration, a.data());
  const double scale = config_.body_scale(step_.time), density = material(cell).density();
  for (int q = 0; q < tables_.points(); ++q) {
    const double mass = density * tables_.weight(cell, q);
    const double* N = tables_.shape(q);
    for (int i = 0; i < 3; ++i) {
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

void MuscleSystem::assemble(const mfem::Vector& u, const mfem::Vector* lift, mfem::Vector* R) {
  Timers::Scope timer("tangent");
  const int n = 3 * tables_.nodes();
  const LocalVectors local(*this, u, step_.u_old);
  mfem::Vector local_lift, local_R;
  if (lift) {
    local_lift.SetSize(space_.GetVSize());
    local_R.SetSize(space_.GetVSize());
    space_.GetProlongationMatrix()->Mult(*lift, local_lift);
    local_R = 0.0;
  }
  double stiffest = 0;
  std::vector<double> unused(n);
  assembly().begin();
  form_cells(local, [&](int cell, double* K) {
    for (int c = 0; c < n; ++c) stiffest = std::max(stiffest, std::abs(K[c * n + c]));
    if (loads_.on_cell(cell)) {
      gather(cell, local);
      loads_.add(cell, step_.time, u_cell_.data(), unused.data(), K);
    }
    if (lift) add_lift(cell, K, &local_lift, &local_R);
    assembly_->add(cell, K);
  });
  if (lift) {
    mfem::Vector change = to_true(local_R);
    for (int dof : constraints_.dofs()) change(dof) = 0;
    *R += change;
  }
  mfem::Vector lower, upper;
  space_.GetParMesh()->GetBoundingBox(lower, upper);
  upper -= lower;
  force_floor_ = round_off * titin::max(stiffest) * upper.Normlinf() * std::sqrt(double(space_.GlobalTrueVSize()));
  assembly_->end();
}

/// Mass / dt^2: the derivative of backward Euler's inertia.
void MuscleSystem::add_inertia_tangent(int cell, double* K) const {
  const int nodes = tables_.nodes(), n = 3 * nodes;
  std::vector<double> mass(nodes * nodes);
  kernel_.add_mass(cell, material(cell).density() / (step_.dt * step_.dt), mass.data());
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) K[(i * nodes + a) * n + i * nodes + b] += mass[a * nodes + b];
}

/// What a change of the cell's constrained values does to its forces.
void MuscleSystem::add_lift(int cell, const double* K, const mfem::Vector* local_lift, mfem::Vector* local_R) const {
  const int n = 3 * tables_.nodes();
  const int* dofs = &cell_dofs_[cell * n];
  for (int d = 0; d < n; ++d) {
    const double lift = constraints_.is_constrained_local(dofs[d]) ? (*local_lift)(dofs[d]) : 0.0;
    if (lift == 0) continue;
    for (int c = 0; c < n; ++c) (*local_R)(dofs[c]) += K[c * n + d] * lift;
  }
}

/// Says where: the point of the lowest rank that has one. Collective.
void MuscleSystem::set_domain_error(int cell, int point) {
  const double mine = cell >= 0 ? rank() : std::numeric_limits<double>::max(), first = min(mine);
  const bool winner = cell >= 0 && mine == first;
  std::vector<double> x(3, 0.0);
  if (winner) {
    mfem::Vector position(3);
    auto* map = space_.GetElementTransformation(cell);
    map->Transform(tables_.rule().IntPoint(std::max(point, 0)), position);
    x.assign(position.begin(), position.end());
  }
  sum(x);
  domain_error_ =
      fmt::format("a cell turns inside out (volume ratio not positive) near undeformed ({:.4g}, {:.4g}, {:.4g}) m",
                  x[0], x[1], x[2]);
}

}  // namespace titin
