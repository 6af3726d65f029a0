/// A material along one line: what is left of a law in space when a muscle is a rod.
///
/// The muscle keeps its volume and its sides are free, so a fibre's stretch l says everything: F = diag(l, l^-1/2,
/// l^-1/2) along the fibre, and the pressure drops out of the nominal stress, which is the work that a change of l
/// does:
///
///   T(l) = P : dF/dl,   dF/dl = diag(1, -l^-3/2 / 2, -l^-3/2 / 2),   dT/dl = dF/dl : A : dF/dl + P : d2F/dl2.
///
/// Fibres at an angle alpha to the line of action (pennation) turn as they shorten, their distance staying what it is
/// (Hill-type models: Zajac 1989, Crit. Rev. Biomed. Eng. 17, 359): with m the stretch of the line,
///
///   l = sqrt(m^2 cos^2 alpha_0 + sin^2 alpha_0),   N = T dl/dm,   dl/dm = m cos^2 alpha_0 / l,
///
/// per area across the line, which is that across the fibres over cos alpha_0. docs/theory/rod.md. SI units.
#pragma once

#include <memory>
#include <vector>

#include "materials/material.hpp"

namespace titin {

/// n points of a rod in a step. Pointers stay the caller's.
struct UniaxialPoints {
  int n = 0;
  const double *stretch = nullptr, *stretch_old = nullptr;  ///< [n] of the line, at the end of the step and before it
  double time = 0, dt = 0;                                  ///< [s] at the end; 0: no step, and no rate
  FibreRate rate = FibreRate::none;
  // Where the rate is not that from stretch_old to stretch in dt, as RodStep has it.
  const double* rate_old = nullptr;  ///< [n]
  double rate_dt = 0;                ///< [s]
  bool rate_known = false;           ///< from rate_old to stretch_old, whatever the step does
  const double* history = nullptr;   ///< [n][history_size]
  double* new_history = nullptr;
};

class Uniaxial {
 public:
  /// `pennation` [rad] of the undeformed fibres.
  Uniaxial(std::shared_ptr<const Material> material, double pennation);

  /// Nominal stress N [Pa] and, unless null, its derivative by the stretch at the end of the step.
  void stress(const UniaxialPoints& points, double* N, double* dN) const;
  /// The same as a mean over the step whose work is the energy that is stored (discrete gradient); terms that store
  /// none act in the middle of the step.
  void conserving_stress(const UniaxialPoints& points, double* N, double* dN) const;
  void term_stress(int term, const UniaxialPoints& points, double* N) const;
  void term_energy(int term, const UniaxialPoints& points, double* W) const;  ///< [J/m^3]
  double fibre_stretch(double stretch) const;
  double fibre_rate(double stretch, double rate) const;  ///< [1/s] from that of the line
  double activation(double time) const;

  /// dN = stiffness dm + viscosity dm/dt about a point at rest.
  struct Linear {
    double stiffness, viscosity;  ///< [Pa], [Pa s]
  };
  Linear linearise(double stretch, double time, const double* history) const;

  const Material& material() const { return *material_; }

 private:
  struct Batch;
  double slope(double stretch) const { return stretch * cos2_ / fibre_stretch(stretch); }
  void project(const Batch& batch, const UniaxialPoints& points, const Mat3* P, double* N) const;
  void evaluate(const Batch& batch, const UniaxialPoints& points, double* N, double* dN) const;

  std::shared_ptr<const Material> material_;
  double cos2_, sin2_;  // squares of the angle's cosine and sine
};

}  // namespace titin
