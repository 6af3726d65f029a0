#include "materials/damage.hpp"

#include <algorithm>
#include <cmath>

namespace titin {

void DamageLaw::bind(Section& s) {
  s.choose("law", kind, {{"exponential", Kind::exponential}, {"balzani", Kind::balzani}, {"simo_ju", Kind::simo_ju}},
           {.required = true, .doc = "how the damage grows with the largest energy so far"});
  s.read("threshold", threshold, {.unit = "J/m^3", .range = non_negative, .doc = "energy density where damage begins"});
  if (kind != Kind::balzani || s.describing())
    s.read("scale", scale,
           {.unit = "J/m^3",
            .range = positive,
            .required = true,
            .doc = "energy density over which it grows (exponential, simo_ju)"});
  if (kind == Kind::balzani || s.describing()) {
    s.read("failure", failure,
           {.unit = "J/m^3", .range = positive, .required = true, .doc = "energy density of d = 1 (balzani)"});
    s.read("shape", shape, {.doc = "s of balzani, not 0: below 0 it grows fast at first"});
    if (shape == 0) s.error("shape", "0 is no shape", "take -1 or 1, say");
    if (!s.describing() && threshold >= failure)
      s.error("failure", "not above the threshold", "give failure > threshold");
  }
  if (kind == Kind::simo_ju || s.describing())
    s.read("residual", residual, {.range = fraction, .doc = "b of simo_ju: share that is never lost"});
  s.read("most", most,
         {.range = {.min = 0, .max = 1, .open_max = true}, .doc = "largest d: what is left keeps the tangent regular"});
  s.read("time", time, {.unit = "s", .range = non_negative, .doc = "delay of the damage; 0: none"});
}

DamageLaw::Value DamageLaw::evaluate(double r) const {
  const Value value = formula(r);
  if (value.d <= 0) return {0, 0};
  return value.d < most ? value : Value{most, 0};
}

DamageLaw::Value DamageLaw::formula(double r) const {
  switch (kind) {
    case Kind::exponential: {
      const double left = std::exp(-(r - threshold) / scale);
      return {1 - left, left / scale};
    }
    case Kind::balzani: {
      if (r <= threshold) return {0, 0};
      if (r >= failure) return {1, 0};
      const double g = std::sqrt(r / failure), whole = -std::expm1(shape * (std::sqrt(threshold / failure) - 1));
      return {1 + std::expm1(shape * (g - 1)) / whole, shape * std::exp(shape * (g - 1)) / whole / (2 * g * failure)};
    }
    case Kind::simo_ju: {
      if (r <= threshold) return {0, 0};
      const double x = std::sqrt(r / scale);
      const double mean = -std::expm1(-x) / x;              // (1 - e^-x) / x
      const double mean_slope = (std::exp(-x) - mean) / x;  // its derivative
      return {(1 - residual) * (1 - mean), -(1 - residual) * mean_slope / (2 * x * scale)};
    }
  }
  return {0, 0};
}

void DamageResponse::start(const PointInput& rest, double* row) const {
  row[0] = 0;
  row[1] = law_.threshold;
  inside_->start(rest, row + own_size);
}

void DamageResponse::evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const {
  inside_->evaluate(in, history.shifted(own_size), P, A, W);
  for (int p = 0; p < in.n; ++p) {
    const double* old = history.old + p * history.stride;
    double* now = history.now + p * history.stride;
    const double follow = law_.time > 0 ? in.dt / (law_.time + in.dt) : 1.0;  // dr / dW_0 of the implicit step
    const double excess = std::max(W[p] - old[1], 0.0);
    now[1] = old[1] + follow * excess;
    const DamageLaw::Value before = law_.evaluate(old[1]), after = law_.evaluate(now[1]);
    now[0] = old[0] + 0.5 * (old[1] + W[p]) * (after.d - before.d);
    const double left = 1 - after.d;
    if (A) {
      const double softening = excess > 0 ? after.slope * follow : 0.0;
      for (int a = 0; a < 9; ++a)
        for (int b = 0; b < 9; ++b) A[p][9 * a + b] = left * A[p][9 * a + b] - softening * P[p][a] * P[p][b];
    }
    for (double& stress : P[p]) stress *= left;
    W[p] *= left;
  }
}

}  // namespace titin
