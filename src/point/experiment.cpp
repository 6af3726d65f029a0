#include "point/experiment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "point/record.hpp"

namespace titin {
namespace {

/// A point on its way through a loading.
class Experiment {
 public:
  Experiment(const Material& material, const LoadingConfig& loading)
      : material_(material),
        loading_(loading),
        point_(material, loading.volume),
        course_(loading.course()),
        record_(material, loading.volume, loading.driven()),
        old_(material.history_size()),
        new_(old_) {
    PointInput rest = step(0, 0);
    rest.F = &identity;
    material.start_history(rest, old_.data());
  }

  CurveTable run() {
    CurveTable table{record_.columns(), {}, ""};
    double before = 0;
    for (double time : loading_.times()) {
      const PointInput in = step(time, time - before);
      const Outcome outcome = point_.find(control(time), in, state_);
      if (!outcome.ok()) {
        table.problem = fmt::format("no equilibrium at {:g} s: {}", time, outcome.problem);
        return table;
      }
      accept(in);
      table.rows.push_back(record_.row(in, state_, outcome.iterations));
      if (time == loading_.release) held_ = loading_.load * state_.P[loading_.driven()];
      F_old_ = state_.F;
      old_ = new_;
      before = time;
    }
    return table;
  }

 private:
  PointInput step(double time, double dt) {
    PointInput in;
    in.n = 1;
    in.F_old = &F_old_;
    in.time = time, in.dt = dt;
    in.rate = loading_.fibre_rate;
    in.history = old_.data(), in.new_history = new_.data();
    return in;
  }
  MixedControl control(double time) const {
    if (time > loading_.release) return loading_.control(time, held_, true);
    return loading_.control(time, course_(time), loading_.by_stress);
  }
  /// Newton may have tried other deformations last.
  void accept(const PointInput& in) { point_.stress(in, state_.F, state_.multiplier, state_.P, nullptr); }

  const Material& material_;
  const LoadingConfig& loading_;
  Equilibrium point_;
  Table course_;
  Record record_;
  PointState state_;
  Mat3 F_old_ = identity;
  std::vector<double> old_, new_;
  double held_ = 0;
};

CurveTable six_planes(const Material& material, LoadingConfig loading) {
  CurveTable all;
  loading.loading = Loading::simple_shear;
  for (std::size_t k = 0; k < shear_components.size() && all.problem.empty(); ++k) {
    loading.plane = shear_components[k];
    CurveTable one = Experiment(material, loading).run();
    all.columns = one.columns;
    all.problem = one.problem;
    for (auto& row : one.rows) {
      row.insert(row.begin(), static_cast<double>(k + 1));
      all.rows.push_back(std::move(row));
    }
  }
  // The stress of a term is that of each plane's own component.
  for (std::string& head : all.columns)
    if (const std::string own = fmt::format("P_{}_", component_names[loading.plane]); head.starts_with(own))
      head = "P_shear_" + head.substr(own.size());
  all.columns.insert(all.columns.begin(), "plane");
  return all;
}

}  // namespace

std::string CurveTable::csv() const {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const auto& row : rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

CurveTable run_experiment(const Material& material, const LoadingConfig& loading) {
  if (loading.loading == Loading::triaxial_shear) return six_planes(material, loading);
  return Experiment(material, loading).run();
}

}  // namespace titin
