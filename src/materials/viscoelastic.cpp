#include "materials/viscoelastic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "math/symmetric.hpp"

namespace titin {
namespace {

// Layout of a row: dissipated energy, energy stored in the branches, S_e (6), then for each branch H (6) and E_e (6).
constexpr int stress_at = 2, branches_at = 8, branch_size = 12;

// Points of the integrals over ln tau; an exponential integral needs few: at 0.4 the relaxation is right to 1e-9.
constexpr double log_spacing = 0.4;

/// (1 - e^-x) / x without loss of digits at small x.
double mean_of_decay(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }

struct LogGrid {
  std::vector<double> time, weight;  // weight of int ... d ln tau
};

/// Gauss-Legendre of three points on intervals of ln tau.
LogGrid log_grid(double shortest, double longest) {
  constexpr double node = 0.7745966692414834;  // sqrt(3/5)
  const double length = std::log(longest / shortest);
  const int intervals = std::max(1, static_cast<int>(std::ceil(length / (3 * log_spacing))));
  LogGrid grid;
  for (int i = 0; i < intervals; ++i)
    for (const auto& [x, w] : {std::pair{-node, 5.0 / 18}, {0.0, 8.0 / 18}, {node, 5.0 / 18}}) {
      grid.time.push_back(shortest * std::exp(length * (i + 0.5 + 0.5 * x) / intervals));
      grid.weight.push_back(w * length / intervals);
    }
  return grid;
}

}  // namespace

RelaxationSeries RelaxationSeries::fung(double c, double shortest, double longest) {
  RelaxationSeries series;
  LogGrid grid = log_grid(shortest, longest);
  for (double w : grid.weight) series.strength.push_back(c * w);
  series.time = std::move(grid.time);
  return series;
}

/// t^-alpha / Gamma(1 - alpha) = sin(pi alpha) / pi int e^(-t / tau) tau^-alpha d ln tau. What is faster than the
/// window can see acts as a dashpot, what is slower as a spring.
RelaxationSeries RelaxationSeries::caputo(double alpha, double modulus, double window) {
  constexpr double below = 1e-6, above = 1e4;  // of the window: what is left out is a dashpot and a spring to 1e-4
  const double scale = modulus * std::sin(std::numbers::pi * alpha) / std::numbers::pi;
  const double fastest = below * window, slowest = above * window;
  RelaxationSeries series;
  LogGrid grid = log_grid(fastest, slowest);
  for (std::size_t k = 0; k < grid.time.size(); ++k)
    series.strength.push_back(scale * std::pow(grid.time[k], -alpha) * grid.weight[k]);
  series.time = std::move(grid.time);
  series.elastic += scale * std::pow(slowest, -alpha) / alpha;
  series.dashpot = scale * std::pow(fastest, 1 - alpha) / (1 - alpha);
  return series;
}

double RelaxationSeries::relaxation(double t) const {
  double sum = elastic;
  for (std::size_t i = 0; i < time.size(); ++i) sum += strength[i] * std::exp(-t / time[i]);
  return sum;
}

RelaxationSeries RelaxationSeries::instantaneous() const {
  const double at_once = std::accumulate(strength.begin(), strength.end(), elastic);
  RelaxationSeries series = *this;
  series.elastic /= at_once;
  series.dashpot /= at_once;
  for (double& s : series.strength) s /= at_once;
  return series;
}

ViscoelasticResponse::ViscoelasticResponse(RelaxationSeries series, std::shared_ptr<const Response> inside)
    : series_(std::move(series)), inside_(std::move(inside)) {}

int ViscoelasticResponse::own_size() const { return branches_at + branch_size * static_cast<int>(series_.time.size()); }

int ViscoelasticResponse::history_size() const { return own_size() + inside_->history_size(); }

void ViscoelasticResponse::start(const PointInput& rest, double* row) const {
  std::fill_n(row, own_size(), 0.0);
  inside_->start(rest, row + own_size());
  // a law may pull at rest: that stress is there from the beginning and has relaxed
  Mat3 P;
  double W;
  std::vector<double> scratch(row + own_size(), row + history_size());
  inside_->evaluate(rest, {row + own_size(), scratch.data(), 0}, &P, nullptr, &W);
  const Sym3 S = symmetric_part(P);
  std::copy(S.begin(), S.end(), row + stress_at);
}

void ViscoelasticResponse::evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const {
  inside_->evaluate(in, history.shifted(own_size()), P, A, W);
  for (int p = 0; p < in.n; ++p) {
    double* now = history.now + p * history.stride;
    Mat3 S;
    const double factor = advance(in, p, P[p], history.old + p * history.stride, now, S);
    if (A) {  // dS = factor dS_e, so A = factor A_e + delta_ik (S - factor S_e)_JL
      const Mat3 S_e = full({now[stress_at], now[stress_at + 1], now[stress_at + 2], now[stress_at + 3],
                             now[stress_at + 4], now[stress_at + 5]});
      for (double& a : A[p]) a *= factor;
      for (int i = 0; i < 3; ++i)
        for (int J = 0; J < 3; ++J)
          for (int L = 0; L < 3; ++L) A[p][9 * (3 * i + J) + 3 * i + L] += S[3 * J + L] - factor * S_e[3 * J + L];
    }
    P[p] = multiply(in.F[p], S);
    W[p] = series_.elastic * W[p] + now[1];
  }
}

/// One point: its new history and S; returns dS / dS_e.
double ViscoelasticResponse::advance(const PointInput& in, int p, const Mat3& elastic_P, const double* old, double* now,
                                     Mat3& S) const {
  const Sym3 S_e = symmetric_part(multiply(inverse(in.F[p]), elastic_P));
  const Mat3& F_old = in.F_old ? in.F_old[p] : in.F[p];
  const Sym3 E = green_strain(in.F[p]), E_old = green_strain(F_old);
  Sym3 dS, dE, total;
  for (int c = 0; c < 6; ++c) {
    dS[c] = S_e[c] - old[stress_at + c];
    dE[c] = E[c] - E_old[c];
    now[stress_at + c] = S_e[c];
  }
  const double over_dt = in.dt > 0 ? series_.dashpot / in.dt : 0.0;
  double factor = series_.elastic + over_dt;
  for (int c = 0; c < 6; ++c) total[c] = series_.elastic * S_e[c] + over_dt * dS[c];
  now[0] = old[0] + over_dt * contract(dS, dE);
  now[1] = old[1];
  for (std::size_t i = 0; i < series_.time.size(); ++i) {
    const int at = branches_at + branch_size * static_cast<int>(i);
    const double x = in.dt / series_.time[i], keep = std::exp(-x), take = mean_of_decay(x);
    Sym3 H_mean, stored;
    for (int c = 0; c < 6; ++c) {
      now[at + c] = keep * old[at + c] + take * dS[c];
      now[at + 6 + c] = keep * old[at + 6 + c] + take * dE[c];
      total[c] += series_.strength[i] * now[at + c];
      H_mean[c] = 0.5 * series_.strength[i] * (old[at + c] + now[at + c]);
      stored[c] = now[at + 6 + c] - old[at + 6 + c];
    }
    factor += series_.strength[i] * take;
    now[1] += contract(H_mean, stored);
    now[0] += contract(H_mean, dE) - contract(H_mean, stored);
  }
  S = full(total);
  return factor;
}

}  // namespace titin
