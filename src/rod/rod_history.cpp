#include "rod/rod_history.hpp"

#include <algorithm>
#include <cmath>

namespace titin {

RodHistory::RodHistory(RodSystem& system) : system_(system) {
  const bool one = system.parts().size() == 1;
  for (const RodSystem::Part& part : system.parts()) {
    auto& list = accounts_.emplace_back();
    for (const TermInfo& term : part.law.material().terms())
      list.push_back({one ? term.name : part.name + "_" + term.name, term.stores_energy, term.dissipates, 0, 0, {}});
  }
  shown_ = "mean_stretch_" + system.parts().front().name;
  for (const RodEndConfig& end : system.config().ends)
    if (end.prescribed) shown_ = "reaction_" + end.name + "_x";
}

void RodHistory::update(const mfem::Vector& u, const mfem::Vector& v, const mfem::Vector& seen) {
  list_.clear();
  add_ends(u);
  add_boundary_work(u);
  add_energies(u, v);
  add_means(u, seen);
  add_markers(u, seen);
  started_ = true;
}

void RodHistory::walk(StateWalk& walk) {
  walk.number("work_boundary", work_);
  walk.number("energy_at_start", energy_at_start_);
  std::vector<double> ends(end_forces_old_.begin(), end_forces_old_.end());
  walk.common("end_forces", ends);
  std::copy(ends.begin(), ends.end(), end_forces_old_.begin());
  for (std::size_t i = 0; i < accounts_.size(); ++i)
    for (std::size_t t = 0; t < accounts_[i].size(); ++t) {
      Account& account = accounts_[i][t];
      const std::string name = std::to_string(i) + "_" + std::to_string(t);
      walk.number("term_" + name, account.value);
      walk.number("dissipated_" + name, account.dissipated);
      walk.common("stress_" + name, account.stress_old);
    }
}

void RodHistory::add_ends(const mfem::Vector& u) {
  for (const RodEndConfig& end : system_.config().ends) {
    const int node = system_.lattice().end_node(end.at_far_end);
    if (end.prescribed) list_.push_back({"reaction_" + end.name + "_x", "N", system_.forces()(node)});
    list_.push_back({"end_" + end.name + "_ux", "m", u(node)});
  }
  const Lattice& lattice = system_.lattice();
  list_.push_back({"length", "m", lattice.X().back() + u(lattice.nodes() - 1) - u(0)});
}

/// Of loads and of given displacements.
void RodHistory::add_boundary_work(const mfem::Vector& u) {
  const RodStep& step = system_.step();
  mfem::Vector forces = system_.load_forces();
  for (int node : system_.given()) forces(node) += system_.forces()(node);
  const double weight =
      step.conserving ? 1 : step.rule.work_weight;  // forces of the middle are those of the whole step
  if (started_)
    for (int i = 0; i < u.Size(); ++i)
      work_ += (weight * forces(i) + (1 - weight) * end_forces_old_(i)) * (u(i) - step.u_old(i));
  end_forces_old_ = forces;
}

void RodHistory::add_term(Account& account, int term, const RodSystem::Part& part, const UniaxialPoints& points) {
  const double weight = system_.step().rule.work_weight;
  std::vector<double> value(points.n);
  const auto volume = [&](int p) { return system_.lattice().points()[part.first + p].volume; };
  if (account.dissipates) {
    part.law.material().term_dissipation(term, points.n, points.new_history, value.data());
    account.dissipated = 0;
    for (int p = 0; p < points.n; ++p) account.dissipated += volume(p) * value[p];
  }
  if (account.stored) {
    part.law.term_energy(term, points, value.data());
    account.value = 0;
    for (int p = 0; p < points.n; ++p) account.value += volume(p) * value[p];
    return;
  }
  part.law.term_stress(term, points, value.data());
  if (account.stress_old.empty()) account.stress_old = value;
  for (int p = 0; p < points.n && started_; ++p)
    account.value += volume(p) * (weight * value[p] + (1 - weight) * account.stress_old[p]) *
                     (points.stretch[p] - points.stretch_old[p]);
  account.stress_old = value;
}

void RodHistory::add_energies(const mfem::Vector& u, const mfem::Vector& v) {
  const double kinetic = 0.5 * (system_.lattice().mass().multiply(v) * v);
  double stored = kinetic, done = 0;
  list_.push_back({"energy_kinetic", "J", kinetic});
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    const RodSystem::Part& part = system_.parts()[i];
    const UniaxialPoints points = system_.points_at(part, u);
    for (std::size_t t = 0; t < accounts_[i].size(); ++t) {
      Account& account = accounts_[i][t];
      add_term(account, static_cast<int>(t), part, points);
      (account.stored ? stored : done) += account.value;
      list_.push_back({(account.stored ? "energy_" : "work_") + account.name, "J", account.value});
      if (!account.dissipates) continue;
      done += account.dissipated;
      list_.push_back({"dissipation_" + account.name, "J", account.dissipated});
    }
  }
  if (!started_) energy_at_start_ = stored;
  list_.push_back({"work_boundary", "J", work_});
  list_.push_back({"energy_balance_error", "J", work_ - done - (stored - energy_at_start_)});
}

/// Over the volume of each part; the least and the largest stretch of the muscle.
void RodHistory::add_means(const mfem::Vector& u, const mfem::Vector& seen) {
  std::vector<double> stretch = system_.lattice().gradients(u);
  const std::vector<double> rate = system_.lattice().gradients(seen);
  for (double& slope : stretch) slope += 1;
  for (const RodSystem::Part& part : system_.parts()) {
    double volume = 0, mean = 0, mean_rate = 0;
    for (int p = part.first; p < part.first + part.count; ++p) {
      const double share = system_.lattice().points()[p].volume;
      volume += share;
      mean += share * part.law.fibre_stretch(stretch[p]);
      mean_rate += share * part.law.fibre_rate(stretch[p], rate[p]);
    }
    list_.push_back({"mean_stretch_" + part.name, "", mean / volume});
    list_.push_back({"mean_fibre_rate_" + part.name, "1/s", mean_rate / volume});
  }
  const auto end = stretch.begin() + system_.lattice().muscle_points();
  const auto [least, largest] = std::minmax_element(stretch.begin(), end);
  list_.push_back({"stretch_min", "", *least});
  list_.push_back({"stretch_max", "", *largest});
  list_.push_back({"activation", "", system_.parts().front().law.activation(system_.step().time)});
}

void RodHistory::add_markers(const mfem::Vector& u, const mfem::Vector& seen) {
  for (const RodMarkerConfig& marker : system_.config().markers) {
    const RodElement& element = system_.lattice().element_at(marker.position);
    const double part = (marker.position - element.begin) / element.length;
    const auto N = element.shape(part), G = element.gradient(part);
    double value = 0, stretch = 1, rate = 0;
    for (int a = 0; a < element.nodes; ++a) {
      value += N[a] * u(element.first + a);
      stretch += G[a] * u(element.first + a);
      rate += G[a] * seen(element.first + a);
    }
    list_.push_back({"marker_" + marker.name + "_ux", "m", value});
    list_.push_back({"marker_" + marker.name + "_stretch", "", stretch});
    list_.push_back({"marker_" + marker.name + "_rate", "1/s", rate});
  }
}

}  // namespace titin
