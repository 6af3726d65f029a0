#include "fv/directions.hpp"

#include <algorithm>

#include "mesh/simplex_geometry.hpp"

namespace titin {
namespace {

/// What is left of a unit direction beside others: less is round-off, and the direction is given already.
constexpr double independent = 1e-6;

template <int D>
std::array<Vector<D>, D> complement(const Directions<D>& given) {
  std::array<Vector<D>, D> rest{};
  if constexpr (D == 2) {
    rest[0] = {-given.normal[0][1], given.normal[0][0]};
  } else {
    const Vector<3>& n = given.normal[0];
    if (given.count == 2) {
      rest[0] = cross(n, given.normal[1]);
    } else {
      const int smallest = static_cast<int>(
          std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
          n.begin());
      Vector<3> axis{};
      axis[smallest] = 1;
      rest[0] = cross(n, axis);
      const double size = norm(rest[0]);
      for (double& component : rest[0]) component /= size;
      rest[1] = cross(n, rest[0]);
    }
  }
  return rest;
}

template <int D>
Vector<D> solve_free(const Symmetric<D>& M, const Vector<D>& b) {
  Symmetric<D> C;
  const double determinant = cofactors<D>(M, C);
  Vector<D> v = product<D>(C, b);
  for (double& component : v) component /= determinant;
  return v;
}

}  // namespace

template <int D>
void Directions<D>::add(const Vector<D>& n, double w, int owner) {
  if (count == D) return;
  Vector<D> rest = n;
  for (int k = 0; k < count; ++k) {
    const double along = dot(rest, normal[k]);
    accumulate(rest, -along, normal[k]);
    w -= along * velocity[k];
  }
  const double size = norm(rest);
  if (size < independent) return;
  for (double& component : rest) component /= size;
  normal[count] = rest;
  velocity[count] = w / size;
  condition[count] = owner;
  ++count;
}

template <int D>
Vector<D> Directions<D>::solve(const Symmetric<D>& M, const Vector<D>& b) const {
  if (count == 0) return solve_free<D>(M, b);
  Vector<D> v{};
  for (int k = 0; k < count; ++k) accumulate(v, velocity[k], normal[k]);
  if (count == D) return v;
  const auto T = complement(*this);
  const Vector<D> rest = difference(b, product<D>(M, v));
  const Vector<D> MT = product<D>(M, T[0]);
  if (D - count == 1) {
    accumulate(v, dot(T[0], rest) / dot(T[0], MT), T[0]);
    return v;
  }
  const Vector<D> MU = product<D>(M, T[1]);
  const double a = dot(T[0], MT), c = dot(T[0], MU), d = dot(T[1], MU), r = dot(T[0], rest), s = dot(T[1], rest);
  const double determinant = a * d - c * c;
  accumulate(v, (d * r - c * s) / determinant, T[0]);
  accumulate(v, (a * s - c * r) / determinant, T[1]);
  return v;
}

template struct Directions<2>;
template struct Directions<3>;

}  // namespace titin
