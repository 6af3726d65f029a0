/// Velocities that are given along some directions of a node, and what its forces say of the others: v = N w + T y with
/// (T^T M T) y = T^T (b - M N w), T spanning the rest.
#pragma once

#include "math/vector.hpp"

namespace titin {

/// Orthonormal directions along which a node's velocity is given, each owed to a condition.
template <int D>
struct Directions {
  int count = 0;
  std::array<Vector<D>, D> normal;
  std::array<double, D> velocity;
  std::array<int, D> condition;
  /// Adds v . n = w unless n is in the span already.
  void add(const Vector<D>& n, double w, int owner);
  /// The velocity that solves M v = b in the directions that are left.
  Vector<D> solve(const Symmetric<D>& M, const Vector<D>& b) const;
};

extern template struct Directions<2>;
extern template struct Directions<3>;

}  // namespace titin
