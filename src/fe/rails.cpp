#include "fe/rails.hpp"

#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace titin {

void RailConfig::bind(Section& boundary, int dimension) {
  if (!boundary.has("rail") && !boundary.describing()) return;
  Section s = boundary.section("rail", "a rigid plate on the boundary, which moves along one direction");
  s.choose_word("along", axis, {"x", "y", "z"},
                {.required = true, .doc = "the displacement that all its points share; the others are as without"});
  s.read("force", force, {.unit = "N", .doc = "that drives the plate along the rail, constant or in time"});
  s.read("mass", mass, {.unit = "kg", .range = non_negative, .doc = "of the load that moves with the plate"});
  if (axis >= dimension && dimension > 0) s.error("along", "the body is plane", "take \"x\" or \"y\"");
}

void Rails::add(const RailConfig& config, int boundary, const mfem::Array<int>& dofs) {
  Rail rail{&config, boundary, dofs, -1};
  const double none = std::numeric_limits<double>::max();
  if (min(dofs.Size() > 0 ? rank() : none) == rank()) rail.carrier = dofs[0];
  rails_.push_back(rail);
}

void Rails::finish(const mfem::ParFiniteElementSpace& space) {
  if (!any()) return;
  mfem::Vector number(space.GetTrueVSize()), local(space.GetVSize());
  number = -1.0;
  for (std::size_t j = 0; j < rails_.size(); ++j)
    for (int dof : rails_[j].dofs) number(dof) = static_cast<double>(j);
  space.GetProlongationMatrix()->Mult(number, local);
  for (double j : local) of_local_.push_back(static_cast<int>(std::lround(j)));
}

std::vector<double> Rails::values(const mfem::Vector& x) const {
  std::vector<double> q;
  for (const Rail& rail : rails_) q.push_back(rail.carrier >= 0 ? x(rail.carrier) : 0.0);
  sum(q);
  return q;
}

std::vector<double> Rails::totals(const mfem::Vector& R) const {
  std::vector<double> force(rails_.size(), 0.0);
  for (std::size_t j = 0; j < rails_.size(); ++j)
    for (int dof : rails_[j].dofs) force[j] += R(dof);
  sum(force);
  return force;
}

void Rails::gather(mfem::Vector& R) const {
  if (!any()) return;
  const std::vector<double> force = totals(R);
  for (std::size_t j = 0; j < rails_.size(); ++j) {
    for (int dof : rails_[j].dofs) R(dof) = 0;
    if (rails_[j].carrier >= 0) R(rails_[j].carrier) = force[j];
  }
}

void Rails::spread(mfem::Vector& x) const {
  if (!any()) return;
  const std::vector<double> q = values(x);
  for (std::size_t j = 0; j < rails_.size(); ++j)
    for (int dof : rails_[j].dofs) x(dof) = q[j];
}

void PlateForces::update(const Rails& rails, double time, const mfem::Vector& acceleration) {
  if (!rails.any()) return;
  driving_.clear();
  inertia_ = rails.values(acceleration);
  for (std::size_t j = 0; j < rails.list().size(); ++j) {
    driving_.push_back(-rails.list()[j].config->force(time));
    inertia_[j] *= rails.list()[j].config->mass;
  }
  driving_old_.resize(driving_.size());
}

void PlateForces::add(const Rails& rails, double force_weight, mfem::Vector& R) const {
  const double w = force_weight;
  for (std::size_t j = 0; j < rails.list().size(); ++j)
    if (const int carrier = rails.list()[j].carrier; carrier >= 0)
      R(carrier) += driving_[j] + (inertia_[j] + (1 - w) * driving_old_[j]) / w;
}

void PlateForces::add_sizes(const Rails& rails, mfem::Vector& absolute) const {
  for (std::size_t j = 0; j < rails.list().size(); ++j)
    if (const int carrier = rails.list()[j].carrier; carrier >= 0)
      absolute(carrier) += std::abs(driving_[j]) + std::abs(inertia_[j]);
}

double PlateForces::potential(const Rails& rails, double force_weight, double inertia_factor,
                              const mfem::Vector& u) const {
  const double w = force_weight;
  const std::vector<double> q = rails.values(u);
  double energy = 0;
  for (std::size_t j = 0; j < q.size(); ++j) {
    energy += (driving_[j] + (1 - w) / w * driving_old_[j]) * q[j];
    const double mass = rails.list()[j].config->mass;
    if (mass > 0 && inertia_factor > 0) energy += 0.5 * inertia_[j] * inertia_[j] / (mass * inertia_factor * w);
  }
  return energy;
}

}  // namespace titin
