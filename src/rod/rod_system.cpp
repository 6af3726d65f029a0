#include "rod/rod_system.hpp"

#include <fmt/format.h>

#include <cmath>

namespace titin {

RodSystem::RodSystem(const RodConfig& config) : config_(config), lattice_(config) {
  const int muscle_points = lattice_.muscle_points();
  parts_.push_back({config.muscle_name, Uniaxial(config.muscle, config.pennation), 0, muscle_points});
  if (config.tendon.given())
    parts_.push_back({config.tendon_name, Uniaxial(config.tendon_material, 0), muscle_points, 1});
  for (const RodEndConfig& end : config.ends)
    if (end.prescribed) {
      given_.Append(lattice_.end_node(end.at_far_end));
      given_values_.push_back(&end.displacement);
    }
  start_history();
  for (mfem::Vector* v :
       {&step_.u_old, &step_.known_inertia, &forces_, &load_forces_, &static_forces_, &inertial_forces_}) {
    v->SetSize(lattice_.nodes());
    *v = 0.0;
  }
  accept_forces();
}

void RodSystem::start_history() {
  std::vector<int> row_size, count;
  for (const Part& part : parts_) {
    row_size.push_back(part.law.material().history_size());
    count.push_back(part.count);
  }
  history_ = History(row_size, count);
  PointInput rest;
  rest.n = 1;
  rest.F = rest.F_old = &identity;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Material& material = parts_[i].law.material();
    const Vec3 fibre = material.fibre(), second_fibre = material.second_fibre();
    rest.fibre = &fibre;
    rest.second_fibre = &second_fibre;
    for (int p = 0; p < parts_[i].count; ++p)
      material.start_history(rest, history_.now(static_cast<int>(i)) + p * row_size[i]);
  }
  history_.commit();
}

void RodSystem::set_given(double time, mfem::Vector& u) const {
  for (int k = 0; k < given_.Size(); ++k) u(given_[k]) = (*given_values_[k])(time);
}

void RodSystem::set_given_rates(double time, mfem::Vector& v) const {
  for (int k = 0; k < given_.Size(); ++k) v(given_[k]) = given_values_[k]->slope_before(time);
}

void RodSystem::accept_forces() {
  static_forces_old_ = static_forces_;
  inertial_forces_old_ = inertial_forces_;
}

void RodSystem::commit_history() { history_.commit(); }

void RodSystem::walk(StateWalk& walk) {
  walk.common("history", history_.all_old());
  walk.common("new_history", history_.all_now());
  for (auto [name, forces] : {std::pair{"static_forces", &static_forces_}, {"inertial_forces", &inertial_forces_}}) {
    std::vector<double> values(forces->begin(), forces->end());
    walk.common(name, values);
    std::copy(values.begin(), values.end(), forces->begin());
  }
  accept_forces();
}

/// Sets stretches at the points; false where one is not positive.
bool RodSystem::stretch(const mfem::Vector& u) {
  const auto of = [this](const mfem::Vector& v) {
    std::vector<double> list = lattice_.gradients(v);
    for (double& slope : list) slope += 1;
    return list;
  };
  stretch_ = of(u);
  stretch_old_ = of(step_.u_old);
  if (step_.rate_dt > 0) rate_old_ = of(step_.rate_old);
  for (std::size_t p = 0; p < stretch_.size(); ++p) {
    if (stretch_[p] > 0) continue;
    domain_error_ = fmt::format("an element turns inside out near undeformed x = {:.4g} m", lattice_.points()[p].X);
    return false;
  }
  return true;
}

UniaxialPoints RodSystem::points_of(const Part& part) {
  const int index = static_cast<int>(&part - parts_.data());
  UniaxialPoints points;
  points.n = part.count;
  points.stretch = &stretch_[part.first];
  points.stretch_old = &stretch_old_[part.first];
  points.time = step_.time;
  points.dt = step_.dt;
  points.rate = config_.rate();
  if (step_.rate_dt > 0) {
    points.rate_old = &rate_old_[part.first];
    points.rate_dt = step_.rate_dt;
    points.rate_known = step_.rate_known;
  }
  points.history = history_.old(index);
  points.new_history = history_.now(index);
  return points;
}

UniaxialPoints RodSystem::points_at(const Part& part, const mfem::Vector& u) {
  stretch(u);
  return points_of(part);
}

void RodSystem::stress(double* N, double* dN) {
  for (const Part& part : parts_) {
    double* const slope = dN ? dN + part.first : nullptr;
    if (step_.conserving && step_.dt > 0)
      part.law.conserving_stress(points_of(part), N + part.first, slope);
    else
      part.law.stress(points_of(part), N + part.first, slope);
  }
}

mfem::Vector RodSystem::loads() const {
  const double time = step_.conserving ? step_.time - 0.5 * step_.dt : step_.time;
  mfem::Vector forces(lattice_.nodes());
  forces = 0.0;
  for (const RodEndConfig& end : config_.ends) forces(lattice_.end_node(end.at_far_end)) += end.force(time);
  if (config_.body)
    for (const RodPoint& point : lattice_.points()) {
      const RodElement& element = lattice_.elements()[point.element];
      const double force = point.volume * config_.body(point.X, time);
      for (int a = 0; a < element.nodes; ++a) forces(element.first + a) += force * point.N[a];
    }
  return forces;
}

bool RodSystem::residual(const mfem::Vector& u, mfem::Vector& R) {
  if (!stretch(u)) return false;
  std::vector<double> N(stretch_.size());
  stress(N.data(), nullptr);
  static_forces_ = 0.0;
  lattice_.add_forces(N, static_forces_);
  load_forces_ = loads();
  static_forces_ -= load_forces_;
  inertial_forces_ = 0.0;
  if (moving()) {
    mfem::Vector a(u);
    a -= step_.u_old;
    a *= step_.inertia_factor;
    a += step_.known_inertia;
    inertial_forces_ = lattice_.mass().multiply(a);
  }
  double squares = 0;
  for (std::size_t p = 0; p < N.size(); ++p)
    for (int a = 0; a < lattice_.elements()[lattice_.points()[p].element].nodes; ++a)
      squares += std::pow(lattice_.points()[p].volume * N[p] * lattice_.points()[p].G[a], 2);
  squares += load_forces_ * load_forces_ + inertial_forces_ * inertial_forces_;
  force_scale_ = std::sqrt(squares);
  balance(R);
  return true;
}

/// The residual from the forces at both ends of the step, and the reactions at its end.
void RodSystem::balance(mfem::Vector& R) {
  const double w = step_.rule.force_weight, m = step_.rule.inertia_weight;
  R = static_forces_;
  R.Add(1 / w, inertial_forces_);
  if (w != 1) R.Add((1 - w) / w, static_forces_old_);
  for (int node : given_) R(node) = 0;
  forces_ = static_forces_;
  if (step_.conserving) {  // those in the middle of the step: their work is exact
    forces_ += inertial_forces_;
    return;
  }
  forces_.Add(1 / m, inertial_forces_);
  if (m != 1) forces_.Add(-(1 - m) / m, inertial_forces_old_);
}

BandMatrix RodSystem::tangent(const mfem::Vector& u) {
  stretch(u);
  std::vector<double> N(stretch_.size()), dN(stretch_.size());
  stress(N.data(), dN.data());
  BandMatrix K = lattice_.matrix();
  lattice_.add_stiffness(dN, K);
  if (moving()) K.add(step_.inertia_factor / step_.rule.force_weight, lattice_.mass());
  for (int node : given_) K.make_unit_row(node);
  return K;
}

mfem::Vector RodSystem::initial_acceleration(const mfem::Vector& R) const {
  BandMatrix M = lattice_.mass();
  mfem::Vector a(R);
  a.Neg();
  std::vector<char> fixed(lattice_.nodes());
  for (int node : given_) fixed[node] = 1;
  for (int i = 0; i < lattice_.nodes(); ++i) {
    if (M(i, i) > 0 && !fixed[i]) continue;
    M.make_unit_row(i);
    a(i) = 0;
  }
  if (!M.solve(a)) a = 0.0;
  return a;
}

}  // namespace titin
