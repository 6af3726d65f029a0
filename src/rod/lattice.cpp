#include "rod/lattice.hpp"

#include <algorithm>

namespace titin {

std::array<double, 3> RodElement::shape(double s) const {
  if (nodes == 2) return {1 - s, s, 0};
  return {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)};
}

std::array<double, 3> RodElement::gradient(double s) const {
  if (nodes == 2) return {-1 / length, 1 / length, 0};
  return {(4 * s - 3) / length, (4 - 8 * s) / length, (4 * s - 1) / length};
}

Lattice::Lattice(const RodConfig& config) : half_(config.element_order()) {
  const std::vector<double> ends = config.vertices();
  const int order = config.element_order(), points = config.kind == RodKind::continuum ? order + 1 : 1;
  X_ = {ends.front()};
  for (int e = 0; e < config.elements(); ++e)
    add_element({nodes() - 1, order + 1, ends[e], ends[e + 1] - ends[e]}, points, config.line_area());
  muscle_points_ = static_cast<int>(points_.size());
  if (config.tendon.given()) add_element({nodes() - 1, 2, config.length, config.tendon.length}, 1, config.tendon.area);
  add_masses(config);
}

void Lattice::add_element(const RodElement& element, int points, double area) {
  for (int k = 1; k < element.nodes; ++k) X_.push_back(element.begin + element.length * k / (element.nodes - 1));
  const int exact_degree = 2 * points - 1;
  const mfem::IntegrationRule& rule = mfem::IntRules.Get(mfem::Geometry::SEGMENT, exact_degree);
  for (int q = 0; q < points; ++q) {
    const double s = rule.IntPoint(q).x;
    points_.push_back({static_cast<int>(elements_.size()), element.begin + s * element.length,
                       rule.IntPoint(q).weight * element.length * area, element.shape(s), element.gradient(s)});
  }
  elements_.push_back(element);
}

void Lattice::add_masses(const RodConfig& config) {
  mass_ = own_mass_ = matrix();
  if (!config.has_mass()) return;
  const double density = config.muscle->density();
  if (config.kind == RodKind::continuum)
    for (int p = 0; p < muscle_points_; ++p) {
      const RodElement& element = elements_[points_[p].element];
      for (int a = 0; a < element.nodes; ++a)
        for (int b = 0; b < element.nodes; ++b)
          own_mass_(element.first + a, element.first + b) +=
              density * points_[p].volume * points_[p].N[a] * points_[p].N[b];
    }
  if (config.kind == RodKind::chain)
    for (int i = 1; i <= config.masses; ++i)
      own_mass_(i, i) = density * config.line_area() * config.length / config.masses;
  mass_ = own_mass_;
  for (const RodEndConfig& end : config.ends) mass_(end_node(end.at_far_end), end_node(end.at_far_end)) += end.mass;
}

const RodElement& Lattice::element_at(double X) const {
  const auto past = [X](const RodElement& element) { return X <= element.begin + element.length; };
  const auto found = std::find_if(elements_.begin(), elements_.end(), past);
  return found == elements_.end() ? elements_.back() : *found;
}

std::vector<double> Lattice::gradients(const mfem::Vector& v) const {
  std::vector<double> slopes(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const RodElement& element = elements_[points_[p].element];
    for (int a = 0; a < element.nodes; ++a) slopes[p] += points_[p].G[a] * v(element.first + a);
  }
  return slopes;
}

void Lattice::add_forces(const std::vector<double>& stress, mfem::Vector& forces) const {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const RodElement& element = elements_[points_[p].element];
    for (int a = 0; a < element.nodes; ++a)
      forces(element.first + a) += points_[p].volume * stress[p] * points_[p].G[a];
  }
}

void Lattice::add_stiffness(const std::vector<double>& modulus, BandMatrix& K) const {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const RodElement& element = elements_[points_[p].element];
    for (int a = 0; a < element.nodes; ++a)
      for (int b = 0; b < element.nodes; ++b)
        K(element.first + a, element.first + b) += points_[p].volume * modulus[p] * points_[p].G[a] * points_[p].G[b];
  }
}

}  // namespace titin
