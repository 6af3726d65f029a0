#include "fe/stress_recovery.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {

namespace {

/// k of the stress' error h^k.
int degree_of(const CellElement& element) {
  return element.pressure_degree >= 0 ? element.pressure_degree + 1 : element.order;
}

}  // namespace

StressRecovery::StressRecovery(MuscleSystem& system)
    : system_(system),
      points_(*system.space().GetParMesh(), system.tables()),
      stress_(points_.count()),
      cell_error_(system.space().GetNE()) {
  int degree = 1;
  for (const CellElement& element : system.config().elements.list()) degree = std::max(degree, degree_of(element));
  for (const auto& [name, material] : system.config().materials) {
    std::vector<int> cells;
    for (int cell = 0; cell < system.space().GetNE(); ++cell)
      if (&system.material(cell) == material.get()) cells.push_back(cell);
    fits_.emplace_back(points_, cells, degree);
  }
  for (int cell = 0; cell < system.space().GetNE(); ++cell) volume_ += points_.volume(cell);
  volume_ = sum(volume_);
}

void StressRecovery::update(const mfem::Vector& u) {
  Timers::Scope timer("error estimate");
  take_stress(u);
  error_ = norm_ = 0;
  for (PatchFit& fit : fits_) {
    fit.update(stress_);
    compare(fit);
  }
  error_ = std::sqrt(sum(error_));
  norm_ = std::sqrt(sum(norm_));
}

/// The whole first Piola stress at all points.
void StressRecovery::take_stress(const mfem::Vector& u) {
  system_.for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
    const PointInput in = kernel.points(system_.point_input(cell));
    Mat3* P = &stress_[points_.first(cell)];
    material.stress(in, P, nullptr);
    for (int q = 0; q < in.n; ++q) add(P[q], kernel.pressure()[q], cofactor(kernel.F()[q]));
  });
}

void StressRecovery::compare(const PatchFit& fit) {
  for (int cell : fit.cells()) {
    double square = 0;
    for (int q = 0; q < system_.tables().points(cell); ++q) {
      const Mat3 &P = stress_[points_.first(cell) + q], smooth = fit.at(cell, q);
      const double w = system_.tables().weight(cell, q);
      for (int i = 0; i < 9; ++i) {
        square += w * (smooth[i] - P[i]) * (smooth[i] - P[i]);
        norm_ += w * P[i] * P[i];
      }
    }
    cell_error_[cell] = std::sqrt(square);
    error_ += square;
  }
}

double StressRecovery::density(int cell) const { return cell_error_[cell] / std::sqrt(points_.volume(cell)); }

std::vector<Quantity> StressRecovery::quantities() const {
  return {{"stress_error", "Pa", error_ / std::sqrt(volume_)}, {"stress_error_relative", "", relative()}};
}

}  // namespace titin
