/// Quasi-linear viscoelasticity around any term: the stress remembers through a sum of exponentials.
///
///   S(t) = elastic S_e + dashpot dS_e/dt + sum_i strength_i H_i,   dH_i/dt + H_i / tau_i = dS_e/dt
///
/// with S_e the second Piola stress of what is inside. A step is exact for S_e that is linear in it (Taylor, Pister,
/// Goudreau 1970; Simo 1987): H_n+1 = e^-x H_n + a (S_e,n+1 - S_e,n), x = dt / tau, a = (1 - e^-x) / x. One series
/// serves three models:
///   * Prony: strengths given, over the long-term stress (S_e stays at the end) or the instantaneous one (S_e at once);
///   * Fung's spectrum c / tau on [shortest, longest] (Fung 1972; Neubert 1963), by Gauss points in ln tau;
///   * Caputo's fractional derivative S = S_e + B D^alpha S_e, whose kernel is an integral of exponentials, likewise.
///
/// Energy: a branch stretches by E_e, dE_e/dt + E_e / tau = dE/dt, stores int H : dE_e and dissipates int H : (dE -
/// dE_e); exact for a linear law, and in sum always the work done.
#pragma once

#include <vector>

#include "materials/response.hpp"

namespace titin {

struct RelaxationSeries {
  double elastic = 1;                  ///< share of S_e that stays
  double dashpot = 0;                  ///< [s]
  std::vector<double> strength, time;  ///< of S_e; [s]

  static RelaxationSeries fung(double c, double shortest, double longest);
  /// Kernel t^-alpha / Gamma(1 - alpha) times `modulus` [s^alpha], good for times from `window` x 1e-4 to `window` [s].
  static RelaxationSeries caputo(double alpha, double modulus, double window);
  /// S(t) / S_e of a step in S_e at t = 0, for t > 0.
  double relaxation(double t) const;
  /// The same response relative to the stress at once: its relaxation begins at 1.
  RelaxationSeries instantaneous() const;
};

class ViscoelasticResponse final : public Response {
 public:
  ViscoelasticResponse(RelaxationSeries series, std::shared_ptr<const Response> inside);
  int history_size() const override;
  void start(const PointInput& rest, double* row) const override;
  void evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const override;
  double dissipated(const double* row) const override { return row[0] + inside_->dissipated(row + own_size()); }

 private:
  int own_size() const;
  double advance(const PointInput& in, int p, const Mat3& elastic_P, const double* old, double* now, Mat3& S) const;

  RelaxationSeries series_;
  std::shared_ptr<const Response> inside_;
};

}  // namespace titin
