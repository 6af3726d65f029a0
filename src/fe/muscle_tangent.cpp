/// The tangent of MuscleSystem: cell by cell or several side by side, into the matrix of the run, into the cells of the
/// block solver, or into an action without a matrix.
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "fe/muscle_system.hpp"

namespace titin {

namespace {

/// Forces below this part of (largest stiffness x size of the body) are round-off: displacements carry 16 digits.
constexpr double round_off = 1e-15;

}  // namespace

Assembly& MuscleSystem::assembly() {
  if (assembly_) return *assembly_;
  assembly_ = std::make_unique<Assembly>(space_, constrained_dofs());
  const bool conserves = config_.integrator.scheme == Scheme::energy_momentum;
  check(MatSetOption(assembly_->matrix(), MAT_SYMMETRIC,
                     symmetric_materials() && !loads_.has_follower() && !conserves ? PETSC_TRUE : PETSC_FALSE));
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
  const LocalVectors local(*this, u);
  action.set([&](int cell) { return tangent_points(cell, local); });
}

TangentPoints MuscleSystem::tangent_points(int cell, const LocalVectors& local) {
  deform(cell, local);
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
  std::vector<double> K;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    K.assign(std::size_t(tables_.values(cell)) * tables_.values(cell), 0.0);
    deform(cell, local);
    add_internal_tangent(cell, K.data());
    if (moving()) add_inertia_tangent(cell, K.data());
    take(cell, K.data());
  }
}

bool MuscleSystem::has_cell_blocks() const {
  return config_.block_solver_problem().empty() && !any_of(space_.GetNE() == 0);
}

const CellBlocks& MuscleSystem::cell_blocks(double gamma) {
  if (!cells_) cells_ = std::make_unique<TangentCells>(space_, tables_, constraints_, gamma);
  return cells_->blocks();
}

void MuscleSystem::add_internal_tangent(int cell, double* K) {
  const PointInput in = point_input(cell);
  if (!step_.conserving) return kernel_.add_tangent(cell, material(cell), in, K);
  conserving_.deform(cell, material(cell), kernel_, kernel_.points(in), true);
  conserving_.add_tangent(cell, kernel_, K);
}

void MuscleSystem::add_load_tangent(int cell, const LocalVectors& local, double* K) {
  const int n = tables_.values(cell);
  gather(cell, local.u, u_cell_.data());
  gather(cell, local.u_old, u_old_cell_.data());
  std::vector<double> unused(n), slope(n * n);
  const double part = step_.conserving ? 0.5 : 1;  // how far the load's place moves with the end of the step
  SupportMotion motion = support_motion(cell, local);
  motion.velocity_factor /= part;
  loads_.add(cell, load_time(), load_position(), unused.data(), slope.data());
  loads_.add_supports(cell, load_time(), motion, unused.data(), slope.data());
  for (int c = 0; c < n * n; ++c) K[c] += part * slope[c];
}

void MuscleSystem::assemble(const mfem::Vector& u, const mfem::Vector* lift, mfem::Vector* R) {
  Timers::Scope timer("tangent");
  const LocalVectors local(*this, u);
  mfem::Vector local_lift, local_R;
  if (lift) {
    local_lift.SetSize(space_.GetVSize());
    local_R.SetSize(space_.GetVSize());
    space_.GetProlongationMatrix()->Mult(*lift, local_lift);
    local_R = 0.0;
  }
  double stiffest = 0;
  assembly().begin();
  if (border_) border_->begin();
  form_cells(local, [&](int cell, double* K) {
    const int n = tables_.values(cell);
    for (int c = 0; c < n; ++c) stiffest = std::max(stiffest, std::abs(K[c * n + c]));
    if (loads_.on_cell(cell)) add_load_tangent(cell, local, K);
    if (cells_) {
      deform(cell, local);
      cells_->set(cell, kernel_, material(cell), K, inertia(cell));
    }
    if (lift) add_lift(cell, K, &local_lift, &local_R);
    if (border_) border_->add(dofs(cell), n, K);
    assembly_->add(cell, K);
  });
  end_border();
  if (lift) {
    mfem::Vector change = to_true(local_R);
    constraints_.condense(change);
    *R += change;
  }
  mfem::Vector lower, upper;
  space_.GetParMesh()->GetBoundingBox(lower, upper);
  upper -= lower;
  force_floor_ = round_off * titin::max(stiffest) * upper.Normlinf() * std::sqrt(double(space_.GlobalTrueVSize()));
  assembly_->end();
}

void MuscleSystem::end_border() {
  if (!border_) return;
  const bool has_velocity = step_.known_velocity.Size() > 0;
  border_->end(moving() ? step_.inertia_factor / step_.force_weight : 0.0, step_.conserving ? 0.5 : 1,
               has_velocity ? step_.velocity_factor : 0.0);
}

/// The derivative of the inertia in the residual.
void MuscleSystem::add_inertia_tangent(int cell, double* K) const {
  const int nodes = tables_.nodes(cell), n = tables_.values(cell);
  std::vector<double> mass(nodes * nodes);
  kernel_.add_mass(cell, inertia(cell), mass.data());
  for (int i = 0; i < tables_.dimension(); ++i)
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) K[(i * nodes + a) * n + i * nodes + b] += mass[a * nodes + b];
}

/// What a change of the cell's constrained values does to its forces.
void MuscleSystem::add_lift(int cell, const double* K, const mfem::Vector* local_lift, mfem::Vector* local_R) const {
  const int n = tables_.values(cell);
  for (int d = 0; d < n; ++d) {
    const int dof = dofs(cell)[d];
    const double lift = constraints_.is_constrained_local(dof) ? (*local_lift)(dof) : 0.0;
    if (lift == 0) continue;
    for (int c = 0; c < n; ++c) (*local_R)(dofs(cell)[c]) += K[c * n + d] * lift;
  }
}

}  // namespace titin
