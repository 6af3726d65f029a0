/// A rod in pieces: nodes along x, elements of one or two degrees, quadrature points, masses.
///
///   continuum: Lagrange elements of degree k, k + 1 Gauss points each, consistent masses;
///   chain: point masses rho A L / N at its nodes but the ends, one point for each element between two;
///   massless: one element, and no mass but those that are fixed to its ends. A tendon is one more element at x+.
#pragma once

#include <array>
#include <vector>

#include "rod/band_matrix.hpp"
#include "rod/rod_config.hpp"

namespace titin {

struct RodElement {
  int first = 0, nodes = 2;      // its nodes are first, first + 1, ...
  double begin = 0, length = 0;  // [m]
  /// Shape functions and their derivatives [1/m] at a part (0 to 1) of it.
  std::array<double, 3> shape(double part) const, gradient(double part) const;
};

struct RodPoint {
  int element;
  double X, volume;  // [m]; its share [m^3]
  std::array<double, 3> N, G;
};

class Lattice {
 public:
  explicit Lattice(const RodConfig& config);

  int nodes() const { return static_cast<int>(X_.size()); }
  const std::vector<double>& X() const { return X_; }
  const std::vector<RodElement>& elements() const { return elements_; }
  /// Those of the muscle, then that of the tendon.
  const std::vector<RodPoint>& points() const { return points_; }
  int muscle_points() const { return muscle_points_; }
  const BandMatrix& mass() const { return mass_; }             ///< [kg]
  const BandMatrix& muscle_mass() const { return own_mass_; }  ///< without what is fixed to the ends
  int end_node(bool far) const { return far ? nodes() - 1 : 0; }
  BandMatrix matrix() const { return {nodes(), half_}; }
  const RodElement& element_at(double X) const;

  /// dv/dX at the points.
  std::vector<double> gradients(const mfem::Vector& v) const;
  /// Adds the nodal forces of a stress at each point [Pa].
  void add_forces(const std::vector<double>& stress, mfem::Vector& forces) const;
  void add_stiffness(const std::vector<double>& modulus, BandMatrix& K) const;

 private:
  void add_element(const RodElement& element, int points, double area);
  void add_masses(const RodConfig& config);

  int half_;
  std::vector<double> X_;
  std::vector<RodElement> elements_;
  std::vector<RodPoint> points_;
  int muscle_points_ = 0;
  BandMatrix mass_, own_mass_;
};

}  // namespace titin
