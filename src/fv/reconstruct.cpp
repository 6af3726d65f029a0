#include "fv/reconstruct.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace titin {
namespace {

/// Below this part of its size cubed (squared in the plane) a matrix of moments has no inverse: too few neighbours.
constexpr double singular = 1e-10;
constexpr double nothing = -std::numeric_limits<double>::infinity();
/// A change below this part of the largest range among the components is round-off, and limits nothing.
constexpr double round_off = 1e-8;

/// How much of a change from the cell's value stays inside [down, up] (differences from it).
double kept(double change, double up, double down, double negligible) {
  if (std::abs(change) <= negligible) return 1;
  return std::min(1.0, (change > 0 ? up : down) / change);
}

/// H S H, H = I - 2 n n.
template <int D>
Symmetric<D> reflected(const Symmetric<D>& S, const Vector<D>& n) {
  const Vector<D> Sn = product<D>(S, n);
  const double nn = dot(n, Sn);
  Symmetric<D> image = S;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      image[symmetric_index<D>(i, j)] += 4 * nn * n[i] * n[j] - 2 * (n[i] * Sn[j] + Sn[i] * n[j]);
  return image;
}

/// Velocity and stress of the image of a cell.
template <int D>
CellFields<D> reflected_fields(const CellFields<D>& q, const Vector<D>& n) {
  Vector<D> v = velocity_of<D>(q);
  accumulate(v, -2 * dot(n, v), n);
  const Symmetric<D> T = reflected<D>(stress_of<D>(q), n);
  CellFields<D> image;
  std::copy(v.begin(), v.end(), image.begin());
  std::copy(T.begin(), T.end(), image.begin() + D);
  return image;
}

}  // namespace

template <int D>
Reconstruction<D>::Reconstruction(const SimplexMesh<D>& mesh, NodeExchange& exchange,
                                  const std::vector<Mirrors<D>>& mirrors)
    : mesh_(mesh),
      exchange_(exchange),
      mirrors_(mirrors),
      moments_(mesh.nodes()),
      extremes_(mesh.nodes()),
      judged_(mesh.nodes()) {}

/// Of the images of all cells behind the plane.
template <int D>
typename Reconstruction<D>::Moments Reconstruction<D>::image(const Moments& m, const Vector<D>& n) {
  Moments im = m;
  accumulate(im.wr, -2 * dot(n, m.wr), n);
  im.wrr = reflected<D>(m.wrr, n);
  im.wq = reflected_fields<D>(m.wq, n);
  CellFields<D> along{};
  for (int i = 0; i < D; ++i) {
    im.wrq[i] = reflected_fields<D>(m.wrq[i], n);
    accumulate(along, n[i], im.wrq[i]);
  }
  for (int i = 0; i < D; ++i) accumulate(im.wrq[i], -2 * n[i], along);
  return im;
}

template <int D>
void Reconstruction<D>::gather(const FlowState<D>& state) {
  for (int p = 0; p < mesh_.nodes(); ++p) {
    Moments m;
    JudgedExtremes range;
    range.high.fill(nothing);
    range.minus_low.fill(nothing);
    for (int k = mesh_.first_corner[p]; k < mesh_.first_corner[p + 1]; ++k) {
      const CellRecord<D>& c = state.cell[mesh_.corners[k] / (D + 1)];
      const Vector<D> r = difference(c.centre, state.x[p]);
      const double w = 1 / dot(r, r);
      m.w += w;
      accumulate(m.wr, w, r);
      add_square<D>(m.wrr, w, r);
      accumulate(m.wq, w, c.q);
      for (int i = 0; i < D; ++i) accumulate(m.wrq[i], w * r[i], c.q);
      const auto values = judged(c);
      for (int k = 0; k < judged_count; ++k) {
        range.high[k] = std::max(range.high[k], values[k]);
        range.minus_low[k] = std::max(range.minus_low[k], -values[k]);
      }
    }
    moments_[p] = m;
    judged_[p] = range;
  }
  exchange_.sum(&moments_[0].w, sizeof(Moments) / sizeof(double));
  for (const Mirrors<D>& mirrors : mirrors_)
    for (int k = 0; k < mirrors.count; ++k) {
      const Moments im = image(moments_[mirrors.node], mirrors.normal[k]);
      double* to = &moments_[mirrors.node].w;
      for (std::size_t i = 0; i < sizeof(Moments) / sizeof(double); ++i) to[i] += (&im.w)[i];
    }
  exchange_.max(&judged_[0].high[0], 2 * judged_count);
}

template <int D>
void Reconstruction<D>::gather_ranges(const FlowState<D>& state) {
  for (int p = 0; p < mesh_.nodes(); ++p) {
    Extremes e;
    e.high.fill(nothing);
    e.minus_low.fill(nothing);
    for (int k = mesh_.first_corner[p]; k < mesh_.first_corner[p + 1]; ++k) {
      const CellFields<D>& q = state.cell[mesh_.corners[k] / (D + 1)].q;
      for (int f = 0; f < fields; ++f) {
        e.high[f] = std::max(e.high[f], q[f]);
        e.minus_low[f] = std::max(e.minus_low[f], -q[f]);
      }
    }
    extremes_[p] = e;
  }
  exchange_.max(&extremes_[0].high[0], sizeof(Extremes) / sizeof(double));
}

template <int D>
Slopes<D> Reconstruction<D>::slopes(int cell, const FlowState<D>& state) const {
  const CellRecord<D>& c = state.cell[cell];
  Symmetric<D> S{};
  std::array<CellFields<D>, D> r{};
  for (int p : mesh_.nodes_of[cell]) {
    const Moments& m = moments_[p];
    const Vector<D> s = difference(state.x[p], c.centre);
    for (int i = 0; i < D; ++i) {
      const double first = m.wr[i] + s[i] * m.w;
      for (int j = i; j < D; ++j)
        S[symmetric_index<D>(i, j)] += m.wrr[symmetric_index<D>(i, j)] + m.wr[i] * s[j] + s[i] * (m.wr[j] + s[j] * m.w);
      for (int f = 0; f < fields; ++f) r[i][f] += m.wrq[i][f] + s[i] * m.wq[f] - c.q[f] * first;
    }
  }
  Slopes<D> g{};
  Symmetric<D> inverse;
  const double determinant = cofactors<D>(S, inverse);
  double trace = 0;
  for (int i = 0; i < D; ++i) trace += S[i];
  if (!(determinant > singular * trace * trace * (D == 3 ? trace : 1))) return g;
  for (double& entry : inverse) entry /= determinant;
  for (int f = 0; f < fields; ++f)
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) g[f][i] += inverse[symmetric_index<D>(i, j)] * r[j][f];
  return g;
}

template <int D>
void Reconstruction<D>::limit(int cell, const FlowState<D>& state, Slopes<D>& g) const {
  const CellRecord<D>& c = state.cell[cell];
  CellFields<D> up, down;
  for (int f = 0; f < fields; ++f) up[f] = down[f] = c.q[f];
  for (int p : mesh_.nodes_of[cell])
    for (int f = 0; f < fields; ++f) {
      up[f] = std::max(up[f], extremes_[p].high[f]);
      down[f] = std::min(down[f], -extremes_[p].minus_low[f]);
    }
  double factor[] = {1, 1}, range[] = {0, 0};  // of velocity, of stress
  for (int f = 0; f < fields; ++f) range[f >= D] = std::max(range[f >= D], up[f] - down[f]);
  for (int p : mesh_.nodes_of[cell]) {
    const Vector<D> s = difference(state.x[p], c.centre);
    for (int f = 0; f < fields; ++f)
      factor[f >= D] =
          std::min(factor[f >= D], kept(dot(g[f], s), up[f] - c.q[f], down[f] - c.q[f], round_off * range[f >= D]));
  }
  for (int f = 0; f < fields; ++f)
    for (double& component : g[f]) component *= factor[f >= D];
}

template class Reconstruction<2>;
template class Reconstruction<3>;

}  // namespace titin
