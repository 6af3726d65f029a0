#include "point/record.hpp"

#include <fmt/format.h>

#include "point/loading.hpp"

namespace titin {
namespace {

constexpr std::array<int, 6> symmetric{0, 4, 8, 1, 5, 6};  // xx, yy, zz, xy, yz, zx

Mat3 cauchy(const PointState& state) {
  Mat3 sigma = multiply(state.P, transpose(state.F));
  const double J = determinant(state.F);
  for (double& x : sigma) x /= J;
  return sigma;
}

}  // namespace

Record::Record(const Material& material, Volume volume, int driven)
    : material_(material),
      volume_(volume),
      driven_(driven),
      P_term_(material.terms().size()),
      work_term_(material.terms().size()) {
  add_columns();
}

void Record::add_columns() {
  const auto add = [&](const std::string& name, const char* unit) {
    columns_.push_back(*unit ? fmt::format("{} [{}]", name, unit) : name);
  };
  add("time", "s");
  for (const char* c : component_names) add(fmt::format("F_{}", c), "");
  add("J", "");
  for (const char* c : component_names) add(fmt::format("P_{}", c), "Pa");
  for (int q : symmetric) add(fmt::format("sigma_{}", component_names[q]), "Pa");
  add("pressure", "Pa");
  if (material_.has_fibres()) {
    add("fibre_stretch", ""), add("fibre_rate", "1/s");
    add("activation", "");
  }
  add("energy", "J/m^3");
  add("work", "J/m^3");
  if (volume_ == Volume::compressible) add("energy_volumetric", "J/m^3");
  for (const TermInfo& term : material_.terms()) {
    add(fmt::format("P_{}_{}", component_names[driven_], term.name), "Pa");
    add((term.stores_energy ? "energy_" : "work_") + term.name, "J/m^3");
    if (term.dissipates) add("dissipation_" + term.name, "J/m^3");
  }
  add("newton", "");
}

double Record::work_in_step(const Mat3& P_old, const Mat3& P, const Mat3& F) const {
  double work = 0;
  for (int q = 0; q < 9; ++q) work += 0.5 * (P_old[q] + P[q]) * (F[q] - F_[q]);
  return first_ ? 0 : work;
}

void Record::add_tensors(const PointState& state, std::vector<double>& row) const {
  row.insert(row.end(), state.F.begin(), state.F.end());
  row.push_back(determinant(state.F));
  row.insert(row.end(), state.P.begin(), state.P.end());
  const Mat3 sigma = cauchy(state);
  for (int q : symmetric) row.push_back(sigma[q]);
  row.push_back(-trace(sigma) / 3);
}

void Record::add_fibres(const PointInput& in, std::vector<double>& row) const {
  double stretch = 0, rate = 0, activation = 0;
  material_.fibre_state(in, &stretch, &rate, &activation);
  row.insert(row.end(), {stretch, rate, activation});
}

void Record::add_energies(const PointInput& in, const PointState& state, std::vector<double>& row) {
  const double volumetric = volume_ == Volume::compressible ? material_.volumetric(determinant(state.F)).U : 0;
  work_ += work_in_step(P_, state.P, state.F);
  double stored = volumetric;
  std::vector<double> by_term;
  for (int t = 0; t < static_cast<int>(material_.terms().size()); ++t) {
    const TermInfo& term = material_.terms()[t];
    Mat3 P;
    material_.term_stress(t, in, &P);
    work_term_[t] += work_in_step(P_term_[t], P, state.F);
    P_term_[t] = P;
    double energy = 0, dissipated = 0;
    material_.term_energy(t, in, &energy);
    stored += energy;
    by_term.insert(by_term.end(), {P[driven_], term.stores_energy ? energy : work_term_[t]});
    if (term.dissipates) {
      material_.term_dissipation(t, 1, in.new_history, &dissipated);
      by_term.push_back(dissipated);
    }
  }
  row.insert(row.end(), {stored, work_});
  if (volume_ == Volume::compressible) row.push_back(volumetric);
  row.insert(row.end(), by_term.begin(), by_term.end());
}

std::vector<double> Record::row(const PointInput& step, const PointState& state, int iterations) {
  PointInput in = step;
  in.F = &state.F;
  std::vector<double> row{in.time};
  add_tensors(state, row);
  if (material_.has_fibres()) add_fibres(in, row);
  add_energies(in, state, row);
  row.push_back(iterations);
  F_ = state.F, P_ = state.P;
  first_ = false;
  return row;
}

}  // namespace titin
