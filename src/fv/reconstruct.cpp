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

template <int D>
Vector<D> reflected(Vector<D> v, const Vector<D>& n) {
  accumulate(v, -2 * dot(n, v), n);
  return v;
}

/// Velocity, stress and place of the image of a cell.
template <int D>
PackedFields<D> reflected_fields(const PackedFields<D>& u, const Vector<D>& n) {
  const Vector<D> v = reflected<D>(velocity_of<D>(u), n);
  const Symmetric<D> T = reflected<D>(stress_of<D>(u), n);
  Vector<D> r;
  std::copy_n(u.begin() + field_count<D>, D, r.begin());
  r = reflected<D>(r, n);
  PackedFields<D> image{};
  std::copy(v.begin(), v.end(), image.begin());
  std::copy(T.begin(), T.end(), image.begin() + D);
  std::copy(r.begin(), r.end(), image.begin() + field_count<D>);
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
  Moments im;
  im.w = m.w;
  im.wu = reflected_fields<D>(m.wu, n);
  PackedFields<D> along{};
  for (int i = 0; i < D; ++i) {
    im.wru[i] = reflected_fields<D>(m.wru[i], n);
    titin::accumulate(along, n[i], im.wru[i]);
  }
  for (int i = 0; i < D; ++i) titin::accumulate(im.wru[i], -2 * n[i], along);
  return im;
}

template <int D>
void Reconstruction<D>::gather(const FlowState<D>& state) {
  for (int p = 0; p < mesh_.nodes(); ++p) {
    double w_sum = 0;
    std::array<Registers<D>, D + 1> sum{};
    PackedFields<D> place{};
    std::copy_n(state.x[p].begin(), D, place.begin() + fields);
    const Registers<D> node = load_registers<D>(place.data());
    JudgedExtremes range;
    range.high.fill(nothing);
    range.minus_low.fill(nothing);
    for (int k = mesh_.first_corner[p]; k < mesh_.first_corner[p + 1]; ++k) {
      const CellRecord<D>& c = state.cell[mesh_.corners[k] / (D + 1)];
      const Vector<D> r = difference(c.centre, state.x[p]);
      const double w = 1 / dot(r, r);
      w_sum += w;
      Registers<D> u = c.packed();
      for (int k = 0; k < packed_registers<D>; ++k) u[k] -= node[k];
      accumulate<D>(sum[0], w, u);
      for (int i = 0; i < D; ++i) accumulate<D>(sum[1 + i], w * r[i], u);
      const auto values = judged(c);
      for (int k = 0; k < judged_count; ++k) {
        range.high[k] = std::max(range.high[k], values[k]);
        range.minus_low[k] = std::max(range.minus_low[k], -values[k]);
      }
    }
    Moments& m = moments_[p];
    m.w = w_sum;
    store_registers<D>(sum[0], m.wu);
    for (int i = 0; i < D; ++i) store_registers<D>(sum[1 + i], m.wru[i]);
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
  Vector<D> wd{};                        // with d = r + s, from the cell: sum of w d
  std::array<Registers<D>, D> change{};  // sum of w d u, later of w d (q - Q)
  for (int p : mesh_.nodes_of[cell]) {
    const Moments& m = moments_[p];
    const Vector<D> s = difference(state.x[p], c.centre), wr = m.wr();
    const Registers<D> wu = load_registers<D>(m.wu.data());
    for (int i = 0; i < D; ++i) {
      const Registers<D> wru = load_registers<D>(m.wru[i].data());
      for (int k = 0; k < packed_registers<D>; ++k) change[i][k] += wru[k] + s[i] * wu[k];
      const double first = wr[i] + s[i] * m.w;
      wd[i] += first;
      for (int j = i; j < D; ++j) S[symmetric_index<D>(i, j)] += m.wru[i][fields + j] + s[i] * wr[j] + s[j] * first;
    }
  }
  for (int i = 0; i < D; ++i) accumulate<D>(change[i], -wd[i], c.packed());
  Slopes<D> g{};
  Symmetric<D> inverse;
  const double determinant = cofactors<D>(S, inverse);
  double trace = 0;
  for (int i = 0; i < D; ++i) trace += S[i];
  if (!(determinant > singular * trace * trace * (D == 3 ? trace : 1))) return g;
  for (double& entry : inverse) entry /= determinant;
  for (int i = 0; i < D; ++i) {
    Registers<D> slope{};
    for (int j = 0; j < D; ++j) accumulate<D>(slope, inverse[symmetric_index<D>(i, j)], change[j]);
    store_registers<D>(slope, g[i]);
  }
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
    PackedFields<D> change;
    store_registers<D>(change_along<D>(difference(state.x[p], c.centre), g), change);
    for (int f = 0; f < fields; ++f)
      factor[f >= D] =
          std::min(factor[f >= D], kept(change[f], up[f] - c.q[f], down[f] - c.q[f], round_off * range[f >= D]));
  }
  for (PackedFields<D>& slope : g)
    for (int f = 0; f < fields; ++f) slope[f] *= factor[f >= D];
}

template class Reconstruction<2>;
template class Reconstruction<3>;

}  // namespace titin
