/// Linear fields in cells by least squares over all cells that share a node, without any cell of another rank.
///
/// q(x) = Q_c + g . (x - x_c) minimises sum_j w_j (Q_c + g . (x_j - x_c) - Q_j)^2, where a cell j counts once for every
/// node p that it shares, with w = 1 / |x_j - x_p|^2 (equal weights are weakly anti-dissipative). Sums over the
/// neighbours split into moments about nodes, which are summed over ranks:
///
///   with r = x_j - x_p, s = x_p - x_c:   S_c = sum_p [sum w r r + s (sum w r) + (sum w r) s + s s sum w]
///                                        r_c = sum_p [sum w r Q + s sum w Q - Q_c (sum w r + s sum w)],  g = S^-1 r.
///
/// Linear fields are exact. At planes of symmetry the images of the cells take part, v - 2 n n.v and H T H with
/// H = I - 2 n n: one-sided slopes are unstable in bodies that are one or two cells wide between walls. The limiter is
/// that of Barth & Jespersen (1989, AIAA 89-0366): no value at a corner leaves the range of the neighbours; one factor
/// for all components of the velocity and one for those of the stress, so that it does not depend on the axes.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "fv/boundary.hpp"
#include "fv/state.hpp"

namespace titin {

/// g[i][k] = d q_k / d x_i.
template <int D>
using Slopes = std::array<PackedFields<D>, D>;

/// s . g: the change of all fields over a way s.
template <int D>
Registers<D> change_along(const Vector<D>& s, const Slopes<D>& g) {
  Registers<D> sum{};
  for (int i = 0; i < D; ++i) accumulate<D>(sum, s[i], load_registers<D>(g[i].data()));
  return sum;
}

/// sum_j d T_ij / d x_j.
template <int D>
Vector<D> divergence_of_stress(const Slopes<D>& g) {
  Vector<D> sum{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum[i] += g[j][D + symmetric_index<D>(i, j)];
  return sum;
}

template <int D>
class Reconstruction {
 public:
  /// `mirrors` stay the caller's.
  Reconstruction(const SimplexMesh<D>& mesh, NodeExchange& exchange, const std::vector<Mirrors<D>>& mirrors);

  /// Takes in a state: moments, and the ranges that steps are judged by, about every node. Collective.
  void gather(const FlowState<D>& state);
  /// The range of all fields about every node, for the limiter. Collective.
  void gather_ranges(const FlowState<D>& state);

  Slopes<D> slopes(int cell, const FlowState<D>& state) const;
  /// Scales slopes; needs gather_ranges of the same state.
  void limit(int cell, const FlowState<D>& state, Slopes<D>& g) const;

  /// What steps are judged by: density [kg/m^3], mean stress [Pa], components of the velocity [m/s].
  static constexpr int judged_count = 2 + D;
  static constexpr int moment_bytes = sizeof(double) + (D + 1) * sizeof(PackedFields<D>);
  static std::array<double, judged_count> judged(const CellRecord<D>& c) {
    std::array<double, judged_count> values{c.density, mean_stress<D>(c.q)};
    std::copy_n(c.q.begin(), D, values.begin() + 2);
    return values;
  }
  struct Range {
    double low, high;
  };
  /// Of the k-th of these over the cells that share a node with this one, itself included.
  Range range(int cell, int k) const {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int p : mesh_.nodes_of[cell]) {
      range.high = std::max(range.high, judged_[p].high[k]);
      range.low = std::min(range.low, -judged_[p].minus_low[k]);
    }
    return range;
  }

 private:
  static constexpr int fields = field_count<D>;
  /// Over the cells about a node: sum w, w u, w r_i u, where u holds the fields and r. (In the plane one number of u is
  /// the density, which nobody reads.)
  struct Moments {
    double w = 0;
    PackedFields<D> wu{};
    std::array<PackedFields<D>, D> wru{};
    Vector<D> wr() const {
      Vector<D> r;
      std::copy_n(wu.begin() + fields, D, r.begin());
      return r;
    }
  };
  struct Extremes {  // of all fields; as maxima, so that one exchange does for both
    CellFields<D> high, minus_low;
  };
  struct JudgedExtremes {
    std::array<double, judged_count> high, minus_low;
  };

  const SimplexMesh<D>& mesh_;
  static Moments image(const Moments& m, const Vector<D>& n);

  NodeExchange& exchange_;
  const std::vector<Mirrors<D>>& mirrors_;
  std::vector<Moments> moments_;        // [node]
  std::vector<Extremes> extremes_;      // [node]
  std::vector<JudgedExtremes> judged_;  // [node]
};

extern template class Reconstruction<2>;
extern template class Reconstruction<3>;

}  // namespace titin
