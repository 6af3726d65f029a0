/// How active a muscle is against time: given, or from its neural excitation u by one of two models,
///
///   zajac:     da/dt = [u - a (beta + u (1 - beta))] / T,  T = activation_time, beta = T / deactivation_time
///              Zajac (1989), Crit. Rev. Biomed. Eng. 17, 359
///   de_groote: da/dt = [(f + 1/2) / (T_a k) + (1/2 - f) k / T_d] (u - a),  k = 1/2 + 3/2 a,  f = 1/2 tanh(0.1 (u - a))
///              De Groote, Kinney, Rao, Fregly (2016), Ann. Biomed. Eng. 44, 2922, eqs. 1 and 2 (T_a activation_time)
///
/// Either depends on time alone, so it is integrated once, when the scene is read.
#pragma once

#include "base/config.hpp"

namespace titin {

enum class ActivationDynamics { zajac, de_groote };

struct ActivationModel {
  ActivationDynamics law = ActivationDynamics::zajac;
  double activation_time = 0.015, deactivation_time = 0.06;  // [s]
  double start = 0;
  double rate(double excitation, double activation) const;  ///< [1/s]
  /// Activation against time, from t = 0 to where it has settled after the last point of the excitation.
  Table integrate(const Table& excitation) const;
};

class Activation {
 public:
  Activation(double constant = 0) : curve_(constant) {}
  double operator()(double time) const { return curve_(time); }
  const std::vector<double>& kinks() const { return kinks_; }  ///< of what the scene gives
  /// Reads `activation`, or `excitation` with `dynamics`.
  void bind(Section& s);

 private:
  Table curve_;
  std::vector<double> kinks_;
};

}  // namespace titin
