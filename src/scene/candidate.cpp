#include "scene/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace titin {
namespace {

using Overrides = std::vector<std::string>;

constexpr double shortest_step = 1.0 / 16, longest_step = 4, coarsest_mesh = 0.5, finest_mesh = 6;  // over the probe's
constexpr double same_step = 1e-6;  // round-off in a length
constexpr double shown = 0.75;      // of the scheme's order: less is not yet its own
constexpr double no_rate = 1, slowest_rate = 0.5,
                 slowest_order = 0.5;  // in space; in time, where what is followed jumps
/// Of implicit solves: block solver 1.0 to 1.1 (docs/verification/solvers.md), factors 1.5.
constexpr double cost_exponent = 1.2;

Overrides joined(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string percent(double x) { return fmt::format("{:.2g} %", 100 * x); }

/// Do equal steps, this many of them, end at all times that steps of dt end at?
bool meets(const std::vector<double>& times, double end, double steps, double dt) {
  const auto whole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
  return std::all_of(times.begin(), times.end(),
                     [&](double t) { return t > end || !whole(t / dt) || whole(t / end * steps); });
}

/// Judges one order.
class Judge {
 public:
  Judge(const Trial& trial, int order) : trial_(trial), mesh_(trial.mesh), step_(trial.clock.step) {
    found_.order = order;
    if (order != trial.own_order) found_.overrides = {fmt::format("{}={}", trial.order_key, order)};
    settings_ = joined(trial.taken, found_.overrides);
  }

  /// None: no such order for these cells, or none that gets to the end. The step comes first, and the mesh is measured
  /// with it: waves that a long one damps are none that cells have to carry.
  std::optional<Candidate> go() {
    fine_ = found_.overrides.empty() ? trial_.base : with_step(step_);
    if (!fine_.ok()) return std::nullopt;
    const double cost = fine_.cpu_seconds / trial_.asked.cpu_seconds;
    if (!trial_.clock.by_stability) choose_step();
    if (!fine_.ok()) return std::nullopt;
    const double at_probe = mesh_error();
    choose_mesh(at_probe);
    estimate_cost();
    trial_.say(fmt::format(
        "{:<34}{:>14}{:>11.2f}x  rate {:.1f}: {} for {}",
        trial_.order_key.empty() ? "elements" : fmt::format("mesh, with {} = {}", trial_.order_key, found_.order),
        percent(at_probe), cost, found_.rate, found_.mesh.words(), percent(found_.mesh_error)));
    return found_;
  }

 private:
  Probe run(const Overrides& settings, const MeshChoice& mesh, double step) const {
    Overrides all = joined(settings, mesh.overrides());
    if (step != trial_.clock.step) all.push_back(fmt::format("time.step={:.9g} s", step));
    return trial_.run(all);
  }
  Probe with_step(double step) const { return run(settings_, mesh_, step); }

  /// At the probe, on a finer mesh where it is too coarse to show an order.
  double mesh_error() {
    const double error = mesh_error_here();
    return error > trial_.for_the_mesh && found_.rate <= no_rate && refined() ? mesh_error() : error;
  }

  /// While that is cheap.
  bool refined() {
    const MeshChoice finer = mesh_.scaled(2);
    const double cost = fine_.cpu_seconds * cost_of(2, mesh_.dimension(), trial_.clock.by_stability);
    if (cost > trial_.dearest) return false;
    Probe probe = run(settings_, finer, step_);
    if (!probe.ok()) return false;
    mesh_ = finer, fine_ = std::move(probe);
    return true;
  }

  double mesh_error_here() {
    const auto half = mesh_.halved();
    if (!half) return 0;
    const Probe coarse = run(settings_, *half, step_);
    if (!coarse.ok()) return 1;
    const double change = difference(coarse, fine_), ratio = mesh_.over(*half);
    const auto quarter = half->halved();
    const Probe coarsest = quarter ? run(settings_, *quarter, step_) : Probe{};
    if (quarter && coarsest.ok() && change > 0)
      found_.rate = std::clamp(std::log(difference(coarsest, coarse) / change) / std::log(half->over(*quarter)),
                               slowest_rate, found_.order + 1.0);
    double error = change / (std::pow(ratio, found_.rate) - 1);
    if (found_.overrides.empty()) return error;
    const bool as_it_was = step_ == trial_.clock.step && mesh_.over(trial_.mesh) == 1;
    const Probe own = as_it_was ? trial_.base : run(trial_.taken, mesh_, step_);
    return own.ok() ? std::max(error, difference(fine_, own)) : 1;  // a lower order's own trend may deceive
  }

  void choose_mesh(double at_probe) {
    const double factor =
        std::clamp(std::pow(at_probe / trial_.for_the_mesh, 1 / found_.rate), coarsest_mesh, finest_mesh);
    found_.mesh = mesh_.scaled(factor);
    found_.mesh_error = at_probe * std::pow(found_.mesh.over(mesh_), -found_.rate);
  }

  struct StepError {
    double order, error;
  };

  /// By Richardson from steps of two and four times the length: they show the order, which where what is followed jumps
  /// is less than the scheme's.
  StepError step_error(const Probe& twice, const Probe& four) const {
    const double change = twice.ok() ? difference(twice, fine_) : 0;
    double order = fine_.order;
    if (change > 0 && fine_.steps >= 4 && four.ok())
      order = std::clamp(std::log2(difference(four, twice) / change), slowest_order, order);
    return {order, twice.ok() ? change / (std::exp2(order) - 1) : 1};
  }

  /// Steps that are too long, and too long to show the scheme's order, are halved first, while that is cheap.
  void choose_step() {
    const ClockConfig& clock = trial_.clock;
    found_.step = clock.step;
    if (fine_.steps < 2 || clock.tolerance > 0) return;
    Probe twice = with_step(2 * step_), four = fine_.steps < 4 ? Probe{} : with_step(4 * step_);
    const double shortest = clock.step * shortest_step, longest = clock.step * longest_that_saves(twice, four);
    StepError seen = step_error(twice, four);
    while (seen.order < shown * fine_.order && seen.error > trial_.for_the_step && step_ > shortest &&
           2 * fine_.cpu_seconds <= trial_.dearest) {
      Probe half = with_step(step_ / 2);
      if (!half.ok()) break;
      four = std::exchange(twice, std::exchange(fine_, std::move(half)));
      step_ /= 2;
      seen = step_error(twice, four);
    }
    double step = longest;
    if (seen.error > 0) step = step_ * std::pow(trial_.for_the_step / seen.error, 1 / seen.order);
    found_.step = clock.end / steps_for(std::clamp(step, shortest, longest));
    found_.step_error = seen.error * std::pow(found_.step / step_, seen.order);
    trial_.say(fmt::format("{:<34}{:>14}{:>12}  order {:.1f}: {:.4g} s for {}", fmt::format("step of {:.4g} s", step_),
                           percent(seen.error), "", seen.order, found_.step, percent(found_.step_error)));
    if (found_.step < step_ * (1 - same_step)) take_chosen_step();
  }

  /// On a coarser mesh where it is dear on this one; one that can be halved still, to be compared with.
  void take_chosen_step() {
    double cost = fine_.cpu_seconds * step_ / found_.step;
    for (auto half = mesh_.halved(); half && half->halved() && cost > trial_.dearest; half = mesh_.halved()) {
      cost /= cost_of(mesh_.over(*half), mesh_.dimension(), false);
      mesh_ = *half;
    }
    fine_ = with_step(step_ = found_.step);
  }

  /// Over the probe's: longer steps that need more Newton iterations for it, or are cut, save nothing.
  double longest_that_saves(const Probe& twice, const Probe& four) const {
    if (!twice.ok() || (fine_.newton > 0 && twice.newton >= fine_.newton)) return 1;
    return !four.ok() || (four.newton > 0 && four.newton >= twice.newton) ? longest_step / 2 : longest_step;
  }

  /// Equal steps of at most this length. Those of the scene that end at a kink still do: a step over one sees a mean of
  /// both sides, which steps that end there do not warn of.
  double steps_for(double longest) const {
    const ClockConfig& clock = trial_.clock;
    const double least = std::ceil(clock.end / longest - 1e-9);
    const double most = 2 * std::max(least, std::ceil(clock.end / clock.step - 1e-9));
    for (double steps = least; steps <= most; ++steps)
      if (meets(trial_.kinks, clock.end, steps, clock.step)) return steps;
    return least;
  }

  void estimate_cost() {
    const double finer = found_.mesh.over(mesh_);
    const bool by_stability = trial_.clock.by_stability;
    found_.cost = fine_.cpu_seconds * cost_of(finer, mesh_.dimension(), by_stability);
    if (!by_stability) found_.cost *= step_ / found_.step;
  }

  const Trial& trial_;
  Candidate found_;
  Overrides settings_;
  MeshChoice mesh_;  // of the probes
  double step_;      // [s] of the same
  Probe fine_;
};

}  // namespace

std::vector<Candidate> candidates(const Trial& trial) {
  std::vector<Candidate> found;
  for (int order = trial.own_order; order > 0 && order >= trial.own_order - 1; --order)
    if (const auto candidate = Judge(trial, order).go()) found.push_back(*candidate);
  return found;
}

double cost_of(double finer, std::size_t dimension, bool by_stability) {
  const double d = static_cast<double>(dimension);
  return std::pow(finer, by_stability ? d + 1 : d * cost_exponent);
}

}  // namespace titin
