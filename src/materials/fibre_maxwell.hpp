/// A Maxwell branch along fibres: the term is the spring, and sees the elastic part lambda_e = lambda / lambda_i of the
/// stretch. Reese, Govindjee (1998) in one dimension; Holzapfel, Gasser (2001) for fibres.
///
///   d ln lambda_i / dt = tau(lambda_e) / eta,   implicit: x - x_n - dt tau(lambda e^-x) / eta = 0,  x = ln lambda_i
///
/// tau is the Kirchhoff tension of the term's fibre: its tau_11 - tau_22 in a stretch along 1 at constant volume. With
/// I4 the fibre's squared stretch, W_4 = tau / (2 I4) and W_44 = (k - 2 tau) / (4 I4^2), k = k_e / (1 + dt k_e / eta),
/// k_e = d tau / d ln lambda_e.
#pragma once

#include "materials/registry.hpp"
#include "materials/response.hpp"

namespace titin {

class FibreMaxwellResponse final : public Response {
 public:
  /// `viscosity` eta [Pa s].
  FibreMaxwellResponse(double viscosity, TermOptions options, std::shared_ptr<const Response> spring)
      : viscosity_(viscosity), options_(options), spring_(std::move(spring)) {}
  int history_size() const override { return own_size; }
  void start(const PointInput& rest, double* row) const override;
  void evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const override;
  double dissipated(const double* row) const override { return row[0]; }

 private:
  static constexpr int own_size = 2;  // dissipated energy, ln lambda_i
  struct Tension {
    double tau, slope, energy;  // slope: d tau / d ln stretch
  };
  Tension pull(double log_stretch) const;

  double viscosity_;
  TermOptions options_;
  std::shared_ptr<const Response> spring_;
};

}  // namespace titin
