#include "fe/muscle_history.hpp"

#include <fmt/format.h>

#include <numbers>

#include "base/parallel.hpp"

namespace titin {

namespace {

constexpr double degree = std::numbers::pi / 180;
const char* const component_name[] = {"x", "y", "z"};

}  // namespace

MuscleHistory::MuscleHistory(MuscleSystem& system)
    : system_(system), attachments_(system), torques_(system), momenta_(system) {
  const MuscleConfig& config = system.config();
  int max_attribute = 0;
  for (const auto& [attribute, name] : config.material_of_region) max_attribute = std::max(max_attribute, attribute);
  terms_of_region_.resize(max_attribute + 1);
  const bool one = config.materials.size() == 1;
  for (const auto& [name, material] : config.materials) {
    std::vector<int> accounts;
    for (const TermInfo& term : material->terms()) {
      accounts.push_back(static_cast<int>(terms_.size()));
      terms_.push_back({one ? term.name : name + "_" + term.name, term.stores_energy, term.dissipates,
                        term.stores_energy && term.has_curves});
    }
    for (const auto& [attribute, region_material] : config.material_of_region)
      if (region_material == name) terms_of_region_[attribute] = accounts;
  }
  take_means();
  take_markers();
  for (std::size_t b = 0; b < config.boundaries.size(); ++b)
    if (config.boundaries[b].constrained()) shown_ = "reaction_" + config.boundaries[b].name + "_x";
  if (shown_.empty()) shown_ = "volume";
}

/// A mean over each material with fibres, and over the cells with fibres of each average.
void MuscleHistory::take_means() {
  const MuscleConfig& config = system_.config();
  const auto& space = system_.space();
  cell_means_.resize(space.GetNE());
  for (const auto& [name, material] : config.materials) {
    if (!material->has_fibres()) continue;
    for (int cell = 0; cell < space.GetNE(); ++cell)
      if (config.material_of_region.at(space.GetParMesh()->GetAttribute(cell)) == name)
        cell_means_[cell].push_back(static_cast<int>(means_.size()));
    means_.push_back({name});
  }
  for (const AverageConfig& average : config.averages) {
    for (int cell : average.cells)
      if (system_.material(cell).has_fibres()) cell_means_[cell].push_back(static_cast<int>(means_.size()));
    means_.push_back({average.name});
  }
}

void MuscleHistory::take_markers() {
  const auto& space = system_.space();
  for (const MarkerConfig& config : system_.config().markers) {
    Marker marker{config.name, config.cell, {}};
    if (config.cell >= 0) {
      marker.shape.SetSize(system_.tables().nodes(config.cell));
      space.GetFE(config.cell)->CalcShape(config.place, marker.shape);
    }
    markers_.push_back(marker);
  }
}

void MuscleHistory::update(const mfem::Vector& u, const mfem::Vector& v, const StepState& step) {
  u_ = u;
  v_ = v;
  dissipated_by_support_.resize(system_.config().boundaries.size());
  add_support_dissipation(step);
  forces_ = system_.forces();
  momenta_.update(u, v);
  volumetric_ = volume_ = 0;
  for (auto& term : terms_)
    if (term.stored) term.value = term.dissipated = 0;
  for (auto& mean : means_) mean.volume = mean.stretch = mean.pennation = mean.rate = 0;
  end_weight_ = step.work_weight;
  next_stress_ = 0;
  system_.for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
    add_cell(cell, material, kernel, kernel.points(system_.point_input(cell)));
  });
  add_boundary_work(u, step);
  attachments_.update(u, v, step, end_weight_);
  if (kinetic_at_start_ < 0) {
    kinetic_at_start_ = momenta_.kinetic();
    stored_at_start_ = volumetric_;
    for (const auto& term : terms_)
      if (term.stored) stored_at_start_ += term.value;
  }
}

void MuscleHistory::add_cell(int cell, const Material& material, const ThreeField& kernel, const PointInput& in) {
  for (int q = 0; q < in.n; ++q) {
    const double w = system_.tables().weight(cell, q);
    volume_ += w * kernel.J()[q];
    volumetric_ += w * material.volumetric(kernel.dilatation()[q]).U;
  }
  add_terms(cell, material, kernel, in);
  add_means(cell, material, kernel, in);
}

void MuscleHistory::add_terms(int cell, const Material& material, const ThreeField& kernel, const PointInput& in) {
  const auto& accounts = terms_of_region_[system_.space().GetParMesh()->GetAttribute(cell)];
  std::vector<double> W(in.n), D(in.n);
  std::vector<Mat3> P(in.n);
  for (std::size_t t = 0; t < accounts.size(); ++t) {
    TermAccount& account = terms_[accounts[t]];
    const int term = static_cast<int>(t);
    if (account.stored)
      material.term_energy(term, in, W.data());
    else
      material.term_stress(term, in, P.data());
    if (account.dissipates) material.term_dissipation(term, in.n, in.new_history, D.data());
    if (account.has_curves) account.from_curves += energy_of_curves(cell, term, material, kernel, in);
    for (int q = 0; q < in.n; ++q) {
      const double w = system_.tables().weight(cell, q);
      if (account.stored) account.value += w * W[q];
      if (account.dissipates) account.dissipated += w * D[q];
      if (!account.stored) account.value += w * work(P[q], kernel.F()[q], kernel.F_old()[q]);
    }
  }
}

/// What the change of a term's numbers in this step adds to its energy, at the deformations of both ends as the step
/// weighs them.
double MuscleHistory::energy_of_curves(int cell, int term, const Material& material, const ThreeField& kernel,
                                       PointInput in) const {
  if (!(in.dt > 0)) return 0;
  const auto change_at = [&](const std::vector<Mat3>& F) {
    std::vector<double> before(in.n), after(in.n);
    PointInput at = in;
    at.F = F.data();
    material.term_energy(term, at, after.data());
    at.time -= at.dt;
    material.term_energy(term, at, before.data());
    double energy = 0;
    for (int q = 0; q < in.n; ++q) energy += system_.tables().weight(cell, q) * (after[q] - before[q]);
    return energy;
  };
  const double weight = system_.step().conserving ? 1 : end_weight_;  // its stress has the numbers of the end only
  const double at_start = weight * change_at(kernel.F_old());
  return weight == 1 ? at_start : at_start + (1 - weight) * change_at(kernel.F());
}

/// Of a stress at a point during the step [J/m^3]. Points come in the same order at every step.
double MuscleHistory::work(const Mat3& P, const Mat3& F, const Mat3& F_old) {
  if (next_stress_ == P_old_.size()) P_old_.push_back(P);
  Mat3& P_old = P_old_[next_stress_++];
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += (end_weight_ * P[i] + (1 - end_weight_) * P_old[i]) * (F[i] - F_old[i]);
  P_old = P;
  return sum;
}

void MuscleHistory::add_means(int cell, const Material& material, const ThreeField& kernel, const PointInput& in) {
  if (cell_means_[cell].empty()) return;
  std::vector<double> stretch(in.n), rate(in.n), activation(in.n);
  material.fibre_state(in, stretch.data(), rate.data(), activation.data());
  const Vec3 axis = system_.config().pennation_axis;
  for (int q = 0; q < in.n; ++q) {
    const double w = system_.tables().weight(cell, q) * kernel.J()[q];
    const Vec3 a = multiply(kernel.F()[q], in.fibre[q]);
    const double cosine = std::clamp(dot(a, axis) / (norm(a) * norm(axis)), -1.0, 1.0);
    for (int m : cell_means_[cell]) {
      means_[m].volume += w;
      means_[m].stretch += w * stretch[q];
      means_[m].rate += w * rate[q];
      means_[m].pennation += w * std::acos(cosine) / degree;
    }
  }
}

void MuscleHistory::add_boundary_work(const mfem::Vector& u, const StepState& step) {
  mfem::Vector boundary = system_.load_forces();
  boundary += system_.support_forces();
  for (int dof : system_.constraints().dofs()) boundary(dof) += forces_(dof);
  const double weight = step.conserving ? 1 : end_weight_;  // forces of the middle are those of the whole step
  if (step.dt > 0)
    for (int i = 0; i < u.Size(); ++i) {
      const double du = u(i) - step.u_old(i);
      work_boundary_ += (weight * boundary(i) + (1 - weight) * boundary_forces_old_(i)) * du;
      work_body_ += (weight * system_.body_forces()(i) + (1 - weight) * body_forces_old_(i)) * du;
    }
  boundary_forces_old_ = boundary;
  body_forces_old_ = system_.body_forces();
}

Quantity MuscleHistory::reaction(int boundary, int component) const {
  double force = 0;
  for (int dof : system_.constraints().boundary_dofs(boundary)[component]) force += forces_(dof);
  return {fmt::format("reaction_{}_{}", system_.config().boundaries[boundary].name, component_name[component]), "N",
          sum(force)};
}

/// What dampers took in the step, by its mean velocity.
void MuscleHistory::add_support_dissipation(const StepState& step) {
  if (!(step.dt > 0)) return;
  mfem::Vector mean(u_);
  mean -= step.u_old;
  mean /= step.dt;
  const std::vector<double> u_cells = system_.cell_values(u_), v_cells = system_.cell_values(mean);
  const auto& boundaries = system_.config().boundaries;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].support.has_damper())
      dissipated_by_support_[b] +=
          step.dt *
          system_.loads().support_state(boundaries[b], step.time, system_.motion_of(u_cells, v_cells)).dissipation;
}

/// Returns what the boundary's supports hold and have dissipated: they are part of the system.
double MuscleHistory::add_support_quantities(std::size_t b, std::vector<Quantity>& list) const {
  const BoundaryConfig& boundary = system_.config().boundaries[b];
  const std::vector<double> u_cells = system_.cell_values(u_), v_cells = system_.cell_values(v_);
  const SupportState state =
      system_.loads().support_state(boundary, system_.step().time, system_.motion_of(u_cells, v_cells));
  for (int i = 0; i < system_.tables().dimension(); ++i)
    list.push_back({fmt::format("support_{}_{}", boundary.name, component_name[i]), "N", sum(state.force[i])});
  if (boundary.support.wall.given) list.push_back({"gap_" + boundary.name, "m", min(state.gap)});
  const double energy = sum(state.energy), dissipated = sum(dissipated_by_support_[b]);
  list.push_back({"energy_support_" + boundary.name, "J", energy});
  if (boundary.support.has_damper()) list.push_back({"dissipation_support_" + boundary.name, "J", dissipated});
  return energy + dissipated;
}

std::vector<Quantity> MuscleHistory::quantities() const {
  std::vector<Quantity> list;
  const auto& boundaries = system_.config().boundaries;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    for (int i = 0; i < system_.tables().dimension() && boundaries[b].constrained(); ++i)
      list.push_back(reaction(static_cast<int>(b), i));
  torques_.list(u_, forces_, list);
  momenta_.list(list);
  const double kinetic = sum(momenta_.kinetic()), volumetric = sum(volumetric_);
  list.push_back({"energy_kinetic", "J", kinetic});
  list.push_back({"energy_volumetric", "J", volumetric});
  double stored = volumetric, done = 0;
  for (const auto& term : terms_) {
    const double value = sum(term.value);
    (term.stored ? stored : done) += value;
    list.push_back({(term.stored ? "energy_" : "work_") + term.name, "J", value});
    if (term.has_curves) {
      const double brought = sum(term.from_curves);
      done -= brought;
      list.push_back({"work_parameters_" + term.name, "J", brought});
    }
    if (!term.dissipates) continue;
    const double dissipated = sum(term.dissipated);
    done += dissipated;
    list.push_back({"dissipation_" + term.name, "J", dissipated});
  }
  double held = 0;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].support.given()) held += add_support_quantities(b, list);
  attachments_.list(list);
  held += attachments_.in_links();
  stored += held + attachments_.in_loads();
  const double boundary = sum(work_boundary_) + held + attachments_.work(),
               body = sum(work_body_);  // supports are part of the system
  list.push_back({"work_boundary", "J", boundary});
  list.push_back({"work_body", "J", body});
  list.push_back(
      {"energy_balance_error", "J",
       boundary + body - done - (kinetic - sum(std::max(kinetic_at_start_, 0.0))) - (stored - sum(stored_at_start_))});
  list.push_back({"volume", "m^3", sum(volume_)});
  for (const auto& mean : means_) {
    const double volume = sum(mean.volume), over = volume > 0 ? 1 / volume : 0;
    list.push_back({"mean_stretch_" + mean.name, "", sum(mean.stretch) * over});
    list.push_back({"mean_pennation_" + mean.name, "degree", sum(mean.pennation) * over});
    list.push_back({"mean_fibre_rate_" + mean.name, "1/s", sum(mean.rate) * over});
  }
  const std::vector<double> u_cells = system_.cell_values(u_);
  for (const auto& marker : markers_)
    for (int i = 0; i < system_.tables().dimension(); ++i) {
      double value = 0;
      const int nodes = marker.shape.Size();  // none on other ranks
      for (int a = 0; a < nodes; ++a)
        value += marker.shape(a) * u_cells[system_.first_value(marker.cell) + i * nodes + a];
      list.push_back({fmt::format("marker_{}_u{}", marker.name, component_name[i]), "m", sum(value)});
    }
  return list;
}

}  // namespace titin
