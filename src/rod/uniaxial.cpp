#include "rod/uniaxial.hpp"

#include <cmath>

namespace titin {
namespace {

/// Below this change of the stretch the quotient of the energy is left out: what is missing is of third order in it,
/// while the quotient would divide round-off by it.
constexpr double least_change = 1e-6;

Mat3 along_fibre(double stretch) {
  const double side = 1 / std::sqrt(stretch);
  return {stretch, 0, 0, 0, side, 0, 0, 0, side};
}

constexpr int axes[] = {0, 4, 8};  // of a tensor: the three normal components

}  // namespace

/// Points in space, along the fibre.
struct Uniaxial::Batch {
  std::vector<Mat3> F, F_old, F_rate_old;
  PointInput in;

  Batch(const Uniaxial& law, const UniaxialPoints& points) {
    const auto fill = [&](const double* stretch, std::vector<Mat3>& list) {
      list.reserve(points.n);
      for (int p = 0; p < points.n; ++p) list.push_back(along_fibre(law.fibre_stretch(stretch[p])));
    };
    fill(points.stretch, F);
    fill(points.stretch_old, F_old);
    in.n = points.n;
    in.F = F.data();
    in.F_old = F_old.data();
    in.time = points.time;
    in.dt = points.dt;
    in.rate = points.dt > 0 ? points.rate : FibreRate::none;
    in.history = points.history;
    in.new_history = points.new_history;
    if (!points.rate_old) return;
    fill(points.rate_old, F_rate_old);
    in.F_rate_old = F_rate_old.data();
    in.rate_dt = points.rate_dt;
    if (points.rate_known) in.F_rate = F_old.data();
  }
};

Uniaxial::Uniaxial(std::shared_ptr<const Material> material, double pennation)
    : material_(std::move(material)),
      cos2_(std::cos(pennation) * std::cos(pennation)),
      sin2_(std::sin(pennation) * std::sin(pennation)) {}

double Uniaxial::fibre_stretch(double stretch) const {
  return sin2_ == 0 ? stretch : std::sqrt(stretch * stretch * cos2_ + sin2_);
}

double Uniaxial::fibre_rate(double stretch, double rate) const { return slope(stretch) * rate; }

double Uniaxial::activation(double time) const {
  PointInput in;
  in.n = 1;
  in.F = &identity;
  in.time = time;
  double stretch, rate, activation;
  material_->fibre_state(in, &stretch, &rate, &activation);
  return activation;
}

/// N = P : dF/dl dl/dm.
void Uniaxial::project(const Batch& batch, const UniaxialPoints& points, const Mat3* P, double* N) const {
  for (int p = 0; p < points.n; ++p) {
    const double side = std::pow(batch.F[p][0], -1.5);
    N[p] = (P[p][0] - 0.5 * side * (P[p][4] + P[p][8])) * slope(points.stretch[p]);
  }
}

void Uniaxial::evaluate(const Batch& batch, const UniaxialPoints& points, double* N, double* dN) const {
  std::vector<Mat3> P(points.n);
  std::vector<Mat9> A(dN ? points.n : 0);
  material_->stress(batch.in, P.data(), dN ? A.data() : nullptr);
  project(batch, points, P.data(), N);
  for (int p = 0; p < points.n && dN; ++p) {
    const double l = batch.F[p][0], side = std::pow(l, -1.5), dl = slope(points.stretch[p]);
    const double dF[] = {1, -0.5 * side, -0.5 * side};
    double dT = 0.75 * side / l * (P[p][4] + P[p][8]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) dT += dF[a] * A[p][9 * axes[a] + axes[b]] * dF[b];
    dN[p] = dT * dl * dl + N[p] / dl * (cos2_ - dl * dl) / l;
  }
}

void Uniaxial::stress(const UniaxialPoints& points, double* N, double* dN) const {
  evaluate(Batch(*this, points), points, N, dN);
}

void Uniaxial::conserving_stress(const UniaxialPoints& points, double* N, double* dN) const {
  const int n = points.n;
  std::vector<double> middle(n), W(n), W_old(n), N_end(n), N_rest(n), dN_rest(n);
  for (int p = 0; p < n; ++p) middle[p] = 0.5 * (points.stretch[p] + points.stretch_old[p]);
  UniaxialPoints half = points;
  half.stretch = middle.data();
  half.time -= 0.5 * points.dt;
  half.dt *= 0.5;
  half.rate_old = nullptr;
  half.new_history = nullptr;
  Batch at_middle(*this, half), at_end(*this, points);
  at_middle.in.part = at_end.in.part = PointInput::Part::stored;
  evaluate(at_middle, half, N, dN);
  evaluate(at_end, points, N_end.data(), nullptr);
  PointInput energy = at_end.in;
  energy.rate = FibreRate::none;
  material_->potential(energy, W.data());
  energy.F = at_end.F_old.data();
  material_->potential(energy, W_old.data());
  at_middle.in.part = PointInput::Part::rest;
  evaluate(at_middle, half, N_rest.data(), dN ? dN_rest.data() : nullptr);
  for (int p = 0; p < n; ++p) {
    const double change = points.stretch[p] - points.stretch_old[p];
    const bool still = std::abs(change) < least_change;
    if (!still) N[p] = (W[p] - W_old[p]) / change;
    if (dN) dN[p] = (still ? 0.5 * dN[p] : (N_end[p] - N[p]) / change) + 0.5 * dN_rest[p];
    N[p] += N_rest[p];
  }
}

void Uniaxial::term_stress(int term, const UniaxialPoints& points, double* N) const {
  const Batch batch(*this, points);
  std::vector<Mat3> P(points.n);
  material_->term_stress(term, batch.in, P.data());
  project(batch, points, P.data(), N);
}

void Uniaxial::term_energy(int term, const UniaxialPoints& points, double* W) const {
  material_->term_energy(term, Batch(*this, points).in, W);
}

Uniaxial::Linear Uniaxial::linearise(double stretch, double time, const double* history) const {
  constexpr double any_step = 1;  // [s]: its derivative by the end of the step is that by the rate over the step
  UniaxialPoints point;
  point.n = 1;
  point.stretch = point.stretch_old = &stretch;
  point.time = time;
  point.dt = any_step;
  point.history = history;
  double N, dN, dN_moving;
  stress(point, &N, &dN);
  point.rate = FibreRate::stretch_difference;
  stress(point, &N, &dN_moving);
  return {dN, (dN_moving - dN) * any_step};
}

}  // namespace titin
