/// What a cell is made of: Cauchy stress and wave speed from its deformation, density and internal energy.
///
/// Fluids take p(rho, e) of materials/fluid.hpp, T = -p I. Solids take any elastic material: T = P F^T / J with P of
/// all terms and of the volumetric law at J = det F; their internal energy does not change the stress, and its excess
/// over the stored energy is heat. Plane strain in two dimensions: F_33 = 1.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "materials/fluid.hpp"
#include "materials/material.hpp"
#include "math/symmetric.hpp"

namespace titin {

/// The deformation at which a cell's wave speed was last sought: the search costs far more than a stress, and the speed
/// depends on F only through C = F^T F.
struct WaveMemory {
  Sym3 C{};
  double speed = 0;  // [m/s]; 0: none yet
};

/// n cells of one material.
struct CellBatch {
  int n = 0;
  const Mat3* F = nullptr;          ///< [n]; solids alone read it
  const double* density = nullptr;  ///< [n] current [kg/m^3]
  const double* energy = nullptr;   ///< [n] specific internal [J/kg]
  const int* cell = nullptr;        ///< [n] places in the memory of waves
  double time = 0;                  ///< [s] for active materials
};

class Closure {
 public:
  enum class Kind { fluid, solid, active };
  explicit Closure(Kind kind) : kind_(kind) {}
  virtual ~Closure() = default;
  bool is_solid() const { return kind_ != Kind::fluid; }
  /// Does its stress also do work that no stored energy tells (active fibres)?
  bool does_work() const { return kind_ == Kind::active; }
  /// Cauchy stress [Pa] of n cells; not a number where there is none.
  virtual void stress(const CellBatch& in, Sym3* T) const = 0;
  /// The same, the speed of the fastest wave [m/s] and, unless null, what `stored` says. `memory` [cell] is the
  /// caller's, kept from step to step.
  virtual void stress_and_speed(const CellBatch& in, WaveMemory* memory, Sym3* T, double* speed, double* psi) const = 0;
  /// Of a solid's volumetric law at a volume ratio: energy [J/m^3] and its derivative [Pa]; none for the rest.
  struct Volumetric {
    double U, dU;
  };
  virtual Volumetric volumetric(double /*ratio*/) const { return {0, 0}; }
  /// Does it have a direction of fibres, and how far are n cells stretched along it? 0 without.
  virtual bool has_fibres() const { return false; }
  virtual void fibre_stretch(const CellBatch& in, double* stretch) const { std::fill_n(stretch, in.n, 0.0); }
  virtual std::vector<double> kinks() const { return {}; }  ///< times at which an activation has a kink [s]
  /// Is this a state the material is good for?
  virtual bool admissible(double density, double energy) const = 0;
  /// Energy stored without heat [J/kg]: what a solid gives back. Fluids store none.
  virtual void stored(const CellBatch& in, double* psi) const = 0;
  /// Specific internal energy [J/kg] of an undeformed solid, or of a fluid at this pressure.
  virtual double energy_at(double density, double pressure) const = 0;

 private:
  Kind kind_;
};

/// Shared laws stay as they are; a closure holds no state of cells.
std::unique_ptr<Closure> make_closure(std::shared_ptr<const Fluid> fluid);
std::unique_ptr<Closure> make_closure(std::shared_ptr<const Material> solid);

}  // namespace titin
