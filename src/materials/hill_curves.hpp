/// The dimensionless curves of Hill-type muscle: force against fibre stretch (active, passive) and against fibre
/// velocity.
///
/// `flexodeal` are the fitted tables of the Flexodeal codes (sfu-nml/flexodeal 1.1.1): seven sines on [0.4, 1.75],
/// piecewise cubics and quadratics. `flexodeal_smooth` differs in the active force near the ends of that range only,
/// where the sines dip below zero and end in a jump: cubics on [0.4, 0.5] and [1.6, 1.75] bring force and slope to zero
/// there. `degroote` are those of De Groote, Kinney, Rao and Fregly (2016), Ann. Biomed. Eng. 44, 2922, with the
/// constants as corrected in OpenSim (DeGrooteFregly2016Muscle): smooth for all stretches. Stretch 1 is the optimal
/// length; velocity is the rate of stretch over its largest value, lengthening positive.
#pragma once

#include <array>
#include <cmath>

#include "math/piecewise.hpp"
#include "math/taylor_table.hpp"

namespace titin {

enum class HillCurve { flexodeal, flexodeal_smooth, degroote };

/// What the curves are multiples of: Kirchhoff stress along the fibre, or force per undeformed area, which is less by
/// the stretch where the volume stays. Models in space have the former, those of whole muscles the latter.
enum class HillStress { kirchhoff, nominal };

namespace hill {

struct Sine {
  double amplitude, frequency, phase;
};
inline constexpr std::array<Sine, 7> active_sines{{{0.642587074375392, 1.290128342448810, 0.629168420414746},
                                                   {0.325979591577056, 5.308969899884336, -4.520101562237307},
                                                   {0.328204247867325, 6.744187042136006, 1.689155892259429},
                                                   {0.015388902741327, 19.823676877725276, -7.386155292116579},
                                                   {0.139240359517525, 8.038287396059996, 2.543022326676525},
                                                   {0.001801867529599, 32.237736486095052, -6.454098315528945},
                                                   {0.012560837549867, 23.117614057963024, -2.643346778503341}}};
inline constexpr double active_min = 0.4, active_max = 1.75;

/// The k-th derivative of the sum of sines.
inline double active_sines_derivative(double stretch, int k) {
  double sum = 0;
  for (const Sine& s : active_sines)
    sum += s.amplitude * std::pow(s.frequency, k) * std::sin(s.frequency * stretch + s.phase + k * std::acos(0.0));
  return sum;
}

/// The sum of sines to 1e-15, at a fifth of the time of seven sines and their cosines.
inline const TaylorTable<128, 8> active_sine_sum(active_min, active_max, active_sines_derivative);

/// Cubic that is 0 with slope 0 at `end` and joins the sines with equal slope at `join`.
template <class T>
T active_blend(const T& stretch, double end, double join) {
  const auto sines = active_sine_sum(Dual<1, 1>::variable(join, 0));
  const double width = join - end;
  const T s = (stretch - end) / width;
  return s * s * ((3 - 2 * s) * sines.value + (s - 1) * (width * sines.gradient[0]));
}

template <class T>
T active_gaussians(const T& stretch) {
  using std::exp;
  constexpr double b[3][4] = {{0.8150671134243542, 1.055033428970575, 0.162384573599574, 0.063303448465465},
                              {0.433004984392647, 0.716775413397760, -0.029947116970696, 0.200356847296188},
                              {0.1, 1, 0.353553390593274, 0}};
  T sum = 0.0;
  for (const auto& g : b) {
    const T z = (stretch - g[1]) / (g[2] + g[3] * stretch);
    sum += g[0] * exp(-0.5 * z * z);
  }
  return sum;
}

/// Active force over the largest isometric one.
template <class T>
T active_force(HillCurve curve, const T& stretch) {
  constexpr double join_min = 0.5, join_max = 1.6;
  if (curve == HillCurve::degroote) return active_gaussians(stretch);
  if (stretch < active_min || stretch > active_max) return 0.0;
  if (curve == HillCurve::flexodeal_smooth && stretch < join_min) return active_blend(stretch, active_min, join_min);
  if (curve == HillCurve::flexodeal_smooth && stretch > join_max) return active_blend(stretch, active_max, join_max);
  return active_sine_sum(stretch);
}

inline constexpr Piecewise<4, 3> velocity_table{
    .breaks = {-1.2, -0.25, 0, 0.05, 0.75},
    .coefficients = {{{0, 0, 0.14317485143460784, 0.25792669408341773},
                      {0.3503552027590582, 0.9703687419567255, -0.9435495605479662, 29.825565394304522},
                      {1, 6.090887473114851, 186.19612494819665, -3165.6847983144276},
                      {1.3743240862369306, 0.9678639805763023, -1.413963071288272, 0.6882206253246714}}}};

/// Factor of the active force at a velocity; 1 at rest. `degroote` is kept from turning negative below -1.
template <class T>
T force_velocity(HillCurve curve, const T& velocity) {
  if (curve != HillCurve::degroote) return velocity_table(velocity);
  if (velocity < -1.0) return 0.0;
  using std::log, std::sqrt;
  constexpr double d[4] = {-0.3211346127989808, -8.149, -0.374, 0.8825327733249912};
  const T z = d[1] * velocity + d[2];
  return d[0] * log(z + sqrt(z * z + 1.0)) + d[3];
}

inline constexpr Piecewise<3, 2> passive_table{
    .breaks = {1, 1.25, 1.5, 1.65},
    .coefficients = {{{0, 0, 2.353844827629192},
                      {0.1471153017268245, 1.176922413814596, 3.436356700507747},
                      {0.6561181989622077, 2.8951007640684696, 0.4274082856676522}}},
    .above = Continuation::linear};

/// (exp(k x) - offset) / scale with k = 4 / 0.6 in x = stretch - 1, zero at stretch 0.2.
struct PassiveExponential {
  static constexpr double k = 4 / 0.6;
  double offset = std::exp(k * (0.2 - 1)), scale = std::exp(4.0) - offset;
};

/// Passive force over the largest isometric one.
template <class T>
T passive_force(HillCurve curve, const T& stretch) {
  if (curve != HillCurve::degroote) return passive_table(stretch);
  using std::exp;
  const PassiveExponential p;
  return (exp(p.k * (stretch - 1.0)) - p.offset) / p.scale;
}

/// Integral of passive_force(x) from 1: the same where the curve gives nominal stress.
inline double passive_nominal_energy(HillCurve curve, double stretch) {
  if (curve != HillCurve::degroote) return passive_table.integral(1, stretch);
  const PassiveExponential p;
  return (std::expm1(p.k * (stretch - 1)) / p.k - p.offset * (stretch - 1)) / p.scale;
}

/// Integral of passive_force(x) / x from 1: the stored energy over the largest isometric stress.
inline double passive_energy(HillCurve curve, double stretch) {
  if (curve != HillCurve::degroote) return passive_table.integral_over_x(1, stretch);
  const PassiveExponential p;
  const double integral = std::exp(-p.k) * (std::expint(p.k * stretch) - std::expint(p.k));
  return (integral - p.offset * std::log(stretch)) / p.scale;
}

}  // namespace hill
}  // namespace titin
