#include "materials/activation.hpp"

#include <algorithm>
#include <cmath>

namespace titin {
namespace {

constexpr double steps_per_time = 100;  // of the shorter time constant: Runge-Kutta is right to 1e-8 there
constexpr double settling_times = 15;   // after the last point: e^-15 is below what matters
constexpr double smoothing = 0.1;       // b of f, De Groote et al. 2016

/// One step of the classical Runge-Kutta scheme.
double advance(const ActivationModel& model, const Table& excitation, double t, double dt, double a) {
  const double before = excitation(t), middle = excitation(t + 0.5 * dt), after = excitation(t + dt);
  const double k1 = model.rate(before, a), k2 = model.rate(middle, a + 0.5 * dt * k1);
  const double k3 = model.rate(middle, a + 0.5 * dt * k2), k4 = model.rate(after, a + dt * k3);
  return a + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

}  // namespace

double ActivationModel::rate(double u, double a) const {
  if (law == ActivationDynamics::zajac) {
    const double beta = activation_time / deactivation_time;
    return (u - a * (beta + u * (1 - beta))) / activation_time;
  }
  const double f = 0.5 * std::tanh(smoothing * (u - a)), k = 0.5 + 1.5 * a;
  return ((f + 0.5) / (activation_time * k) + (0.5 - f) * k / deactivation_time) * (u - a);
}

Table ActivationModel::integrate(const Table& excitation) const {
  const double shortest = std::min(activation_time, deactivation_time);
  const double longest = std::max(activation_time, deactivation_time);
  std::vector<double> knots{0.0};  // steps end at the kinks of the excitation
  for (double t : excitation.time())
    if (t > knots.back()) knots.push_back(t);
  knots.push_back(knots.back() + settling_times * longest);
  std::vector<double> time{0.0}, value{start};
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const double length = knots[k] - knots[k - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(length / shortest * steps_per_time)));
    for (int n = 0; n < steps; ++n) {
      const double t = knots[k - 1] + length * n / steps;
      value.push_back(std::clamp(advance(*this, excitation, t, length / steps, value.back()), 0.0, 1.0));
      time.push_back(knots[k - 1] + length * (n + 1) / steps);
    }
  }
  return Table(std::move(time), std::move(value));
}

void Activation::bind(Section& s) {
  const bool excited = s.has("excitation");
  if (!excited || s.describing())
    s.read(
        "activation", curve_,
        {.range = fraction, .required = true, .doc = "active part of the muscle against time; or give an excitation"});
  kinks_ = curve_.kinks();
  if (!excited && !s.describing()) return;
  if (excited && s.has("activation")) {
    s.read("activation", curve_, {});
    s.error("excitation", "activation is given too", "drop one of the two");
  }
  Table excitation;
  s.read("excitation", excitation,
         {.range = fraction, .doc = "neural drive against time, which the activation follows"});
  kinks_ = excitation.kinks();
  ActivationModel model;
  Section d = s.section("dynamics", "how the activation follows the excitation");
  d.choose("law", model.law, {{"zajac", ActivationDynamics::zajac}, {"de_groote", ActivationDynamics::de_groote}},
           {.doc = "Zajac 1989, or De Groote et al. 2016"});
  d.read("activation_time", model.activation_time, {.unit = "s", .range = positive, .doc = "time constant of rising"});
  d.read("deactivation_time", model.deactivation_time,
         {.unit = "s", .range = positive, .doc = "time constant of falling"});
  d.read("start", model.start, {.range = fraction, .doc = "activation at t = 0"});
  if (!s.describing() && model.activation_time > 0 && model.deactivation_time > 0) curve_ = model.integrate(excitation);
}

}  // namespace titin
