/// Flows of gases whose exact solution is known: how a run starts, what its boundaries do, and what its errors are.
///
/// * kidder: isentropic compression of a shell, homologous r(t) = h(t) R, h = sqrt(1 - t^2 / tau^2), until it focuses
/// at
///   tau. Kidder (1976), Nucl. Fusion 16:3; set-up of Maire (2009), J. Comput. Phys. 228:2391, sec. 5.4.
/// * noh: uniform implosion onto a point (3-D) or line (2-D). Noh (1987), J. Comput. Phys. 72:78.
/// Others have files of their own. All are about the origin or along x, in SI units.
#pragma once

#include <memory>

#include "base/config.hpp"
#include "math/tensor.hpp"

namespace titin {

struct FlowPoint {
  double density = 0, pressure = 0;  // [kg/m^3], [Pa]
  Vec3 velocity{};                   // [m/s]
};

class ExactFlow {
 public:
  virtual ~ExactFlow() = default;
  virtual FlowPoint at(const Vec3& x, double t) const = 0;
  /// [Pa] outside of the body at a face around x, which need not lie quite where the exact boundary does.
  virtual double pressure_on_boundary(const Vec3& x, double t) const { return at(x, t).pressure; }
  /// Distance of a node at x of a loaded boundary from where the exact flow has it [m].
  virtual double off_surface(const Vec3&, double) const { return 0; }
  /// Reads [exact]; null when the scene names no solution.
  static std::shared_ptr<const ExactFlow> read(Section section, int dimension);
};

/// gamma = 1 + 2 / dimension.
class Kidder final : public ExactFlow {
 public:
  struct Shell {
    double inner_radius = 0.9, outer_radius = 1;  // [m]
    double inner_density = 1, outer_density = 2;  // [kg/m^3]
    double entropy = 1;                           // p / rho^gamma, SI
  };
  Kidder(const Shell& shell, int dimension);
  FlowPoint at(const Vec3& x, double t) const override;
  /// Of the nearer of its two surfaces.
  double pressure_on_boundary(const Vec3& x, double t) const override;
  double off_surface(const Vec3& x, double t) const override;
  double focusing_time() const { return tau_; }                                      ///< [s]
  double shrinkage(double t) const { return std::sqrt(1 - t * t / (tau_ * tau_)); }  ///< h

 private:
  Shell shell_;
  double gamma_, tau_;
};

class Noh final : public ExactFlow {
 public:
  Noh(double density, double pressure, double speed, double gamma, int dimension)
      : density_(density), pressure_(pressure), speed_(speed), gamma_(gamma), dimension_(dimension) {}
  FlowPoint at(const Vec3& x, double t) const override;
  double shock_radius(double t) const { return 0.5 * (gamma_ - 1) * speed_ * t; }

 private:
  double density_, pressure_, speed_, gamma_;
  int dimension_;
};

}  // namespace titin
