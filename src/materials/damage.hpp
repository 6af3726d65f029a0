/// Continuum damage around any term: W = (1 - d(r)) W_0 with r the largest W_0 so far. Simo, Ju (1987); Miehe (1995).
///
///   exponential: d = 1 - exp(-(r - threshold) / scale)
///   balzani:     d = 1 - (1 - e^(s (g - 1))) / (1 - e^(s (g_0 - 1))),  g = sqrt(r / failure), g_0 = sqrt(threshold /
///   failure),
///                0 below the threshold, 1 at failure (after Balzani, Schroeder, Gross 2006)
///   simo_ju:     1 - d = b + (1 - b) (1 - e^-x) / x,  x = sqrt(r / scale)
///
/// P = (1 - d) P_0; while r grows, A = (1 - d) A_0 - d'(r) dr/dW_0 P_0 x P_0. The dissipated energy is int W_0 dd.
/// Softening localises: with a relaxation time, r follows W_0 by dr/dt = <W_0 - r> / time, which keeps a mesh in it.
#pragma once

#include "materials/response.hpp"

namespace titin {

struct DamageLaw {
  enum class Kind { exponential, balzani, simo_ju } kind = Kind::exponential;
  double threshold = 0, scale = 0, failure = 0;  // [J/m^3]
  double shape = -1, residual = 0;               // s; b
  double most = 0.999;                           // of d: what is left keeps the tangent regular
  double time = 0;                               // [s]
  void bind(Section& s);

  struct Value {
    double d, slope;  // slope [m^3/J]
  };
  Value evaluate(double r) const;

 private:
  Value formula(double r) const;
};

class DamageResponse final : public Response {
 public:
  DamageResponse(DamageLaw law, std::shared_ptr<const Response> inside) : law_(law), inside_(std::move(inside)) {}
  int history_size() const override { return own_size + inside_->history_size(); }
  void start(const PointInput& rest, double* row) const override;
  void evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const override;
  double dissipated(const double* row) const override { return row[0] + inside_->dissipated(row + own_size); }

 private:
  static constexpr int own_size = 2;  // dissipated energy, r

  DamageLaw law_;
  std::shared_ptr<const Response> inside_;
};

}  // namespace titin
