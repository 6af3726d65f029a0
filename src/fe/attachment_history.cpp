#include "fe/attachment_history.hpp"

#include <fmt/format.h>

namespace titin {

AttachmentHistory::AttachmentHistory(MuscleSystem& system)
    : system_(system), plates_(system.constraints().rails().list().size()), joints_(system.links().list().size()) {}

void AttachmentHistory::update(const mfem::Vector& u, const mfem::Vector& v, const StepState& step, double end_weight) {
  update_plates(u, v, step, end_weight);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Links::Link& link = system_.links().list()[i];
    const double before = Links::elongation(link, step.u_old);
    joints_[i].elongation = Links::elongation(link, u);
    const double change = joints_[i].elongation - before;
    if (step.dt > 0) joints_[i].dissipated += link.damper * change * change / step.dt;
  }
}

void AttachmentHistory::update_plates(const mfem::Vector& u, const mfem::Vector& v, const StepState& step,
                                      double end_weight) {
  const Rails& rails = system_.constraints().rails();
  const std::vector<double> q = rails.values(u), q_old = rails.values(step.u_old), speed = rails.values(v);
  for (std::size_t j = 0; j < plates_.size(); ++j) {
    Plate& plate = plates_[j];
    const RailConfig& config = *rails.list()[j].config;
    const double force = config.force(step.time);
    const double in_step = step.conserving ? config.force(step.time - 0.5 * step.dt)
                                           : end_weight * force + (1 - end_weight) * plate.force_old;
    if (step.dt > 0) plate.work += in_step * (q[j] - q_old[j]);
    plate.travel = q[j];
    plate.speed = speed[j];
    plate.kinetic = 0.5 * config.mass * speed[j] * speed[j];
    plate.force_old = force;
    if (plate.kinetic_at_start < 0) plate.kinetic_at_start = plate.kinetic;
  }
}

double AttachmentHistory::work() const {
  double total = 0;
  for (const Plate& plate : plates_) total += plate.work;
  return total;
}

double AttachmentHistory::in_loads() const {
  double total = 0;
  for (const Plate& plate : plates_) total += plate.kinetic - plate.kinetic_at_start;
  return total;
}

double AttachmentHistory::in_links() const {
  double total = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double e = joints_[i].elongation;
    total += 0.5 * system_.links().list()[i].spring * e * e + joints_[i].dissipated;
  }
  return total;
}

void AttachmentHistory::list(std::vector<Quantity>& quantities) const {
  const auto& rails = system_.constraints().rails().list();
  for (std::size_t j = 0; j < plates_.size(); ++j) {
    const std::string& name = system_.config().boundaries[rails[j].boundary].name;
    quantities.push_back({"travel_" + name, "m", plates_[j].travel});
    quantities.push_back({"speed_" + name, "m/s", plates_[j].speed});
    quantities.push_back({"work_force_" + name, "J", plates_[j].work});
    if (rails[j].config->mass > 0) quantities.push_back({"energy_load_" + name, "J", plates_[j].kinetic});
  }
  list_links(quantities);
}

void AttachmentHistory::list_links(std::vector<Quantity>& quantities) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Links::Link& link = system_.links().list()[i];
    const std::string axis = fmt::format("{}_{}", link.config->name, "xyz"[link.axis]);
    const double e = joints_[i].elongation;
    quantities.push_back({"elongation_" + axis, "m", e});
    quantities.push_back({"force_" + axis, "N", link.force});
    quantities.push_back({"energy_link_" + axis, "J", 0.5 * link.spring * e * e});
    if (link.damper > 0) quantities.push_back({"dissipation_link_" + axis, "J", joints_[i].dissipated});
  }
}

}  // namespace titin
