/// A material: a sum of terms (matrix, fibres, active, ...) and a volumetric law; the only face that formulations see.
///
/// A term that is written in invariants (materials/invariants.hpp) only turns numbers into numbers: invariants in,
/// first and second derivatives of its energy out. The material sums those numbers over its terms and builds the
/// tensors once.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "materials/invariants.hpp"
#include "math/symmetric.hpp"

namespace titin {

/// n points of one material. Pointers stay the caller's.
struct PointInput {
  int n = 0;
  const Mat3* F = nullptr;      ///< [n] deformation gradient at t_n+1
  const Mat3* F_old = nullptr;  ///< [n] at t_n; may be null when rate is none
  const Vec3* fibre = nullptr;  ///< [n] unit fibre directions in the reference configuration; null: the material's own
  double time = 0;              ///< t_n+1 [s]: time curves (activation) are taken here
  double dt = 0;                ///< [s]; a rate needs dt > 0
  FibreRate rate = FibreRate::none;
  /// Which terms: those whose stress derives from energy that they store (without memory), or all the others.
  enum class Part { all, stored, rest } part = Part::all;
  // Where the rate of fibres is not this step's: what it is taken from.
  const Mat3* F_rate_old = nullptr;    ///< [n] instead of F_old, rate_dt before the end; null: F_old and dt
  const Mat3* F_rate = nullptr;        ///< [n] instead of F, when the rate is known before the step; null: F
  double rate_dt = 0;                  ///< [s] with F_rate_old
  const Vec3* second_fibre = nullptr;  ///< [n] of the second family; null: the material's own
  const double* history = nullptr;     ///< [n][history_size] at t_n; null: points at rest until now
  double* new_history = nullptr;       ///< the same at t_n+1, written by `stress`; may be null
  const double* fields = nullptr;      ///< [n][fields of the material] parameters that vary in space; null if none do
};

class SpatialField;
/// What of a material varies in space (materials/spatial_field.hpp): whoever owns points finds its values there.
struct MaterialFields {
  using Pointer = std::shared_ptr<const SpatialField>;
  std::vector<Pointer> numbers;  ///< of its laws: PointInput::fields
  Pointer fibre, second_fibre;   ///< null: the same everywhere
  bool at_right_angles = false;  ///< a term needs the two directions so
  bool empty() const { return numbers.empty() && !fibre && !second_fibre; }
};

/// What a term of a material is called and whether it stores energy (the others do work: active stress).
struct TermInfo {
  std::string name, law;
  bool stores_energy = true;
  bool dissipates = false;
  bool has_curves = false;  ///< parameters change in time, and bring or take energy
};

class Material {
 public:
  /// Reads density, terms and volumetric law; wrong input is reported to the section (see Config::finish).
  static std::shared_ptr<const Material> read(Section section);
  virtual ~Material() = default;

  virtual double density() const = 0;  ///< reference density [kg/m^3]
  virtual Vec3 fibre() const = 0;      ///< unit reference direction, a first one if it varies; {0,0,0} without fibres
  virtual Vec3 second_fibre() const = 0;
  virtual const MaterialFields& fields() const = 0;
  virtual bool has_fibres() const = 0;
  /// Without one, the terms themselves resist changes of volume: nothing for formulations that split it off.
  virtual bool has_volumetric_law() const = 0;
  virtual bool symmetric_tangent(FibreRate rate) const = 0;
  virtual const std::vector<TermInfo>& terms() const = 0;

  /// First Piola stress P [Pa] (n values) of all terms but the volumetric law and, unless null, its derivative A =
  /// dP/dF. NaN where det F <= 0: a caller that meets such points gives up the step before.
  virtual void stress(const PointInput& in, Mat3* P, Mat9* A) const = 0;
  /// Cauchy stress T [Pa] of all terms and of the volumetric law at J = det F and, unless null, their `potential` W
  /// with that of the law [J/m^3]. NaN as above. For formulations that move with the material.
  virtual void cauchy_stress(const PointInput& in, Sym3* T, double* W) const;
  /// The same as `stress` of one term alone (weights of mixtures included).
  virtual void term_stress(int term, const PointInput& in, Mat3* P) const = 0;
  /// Stored energy per reference volume [J/m^3] of one term (0 for terms that store none).
  virtual void term_energy(int term, const PointInput& in, double* W) const = 0;
  /// Stored energy of all terms, volumetric law left out, and the potential of those active terms that have one while
  /// their activation is held [J/m^3].
  virtual void potential(const PointInput& in, double* W) const = 0;
  /// Output of fibre points: stretch |F a0|, its rate [1/s] by the rate's own definition, and activation (0 without).
  virtual void fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const = 0;

  /// Times at which what is given to the material (activation) has a kink.
  virtual std::vector<double> kinks() const { return {}; }

  /// Doubles of history that a point carries from step to step (viscosity, damage); what they are is the material's
  /// affair.
  virtual int history_size() const { return 0; }
  /// The history of one point at rest; `rest` holds its F = I and its fibres.
  virtual void start_history(const PointInput& /*rest*/, double* /*row*/) const {}
  /// Energy that a term has dissipated since the start [J/m^3], from rows of history.
  virtual void term_dissipation(int /*term*/, int n, const double* /*history*/, double* D) const {
    std::fill_n(D, n, 0.0);
  }

  struct Volumetric {
    double U, dU, d2U;  ///< energy [J/m^3] of a volume ratio and its derivatives [Pa]
  };
  virtual Volumetric volumetric(double ratio) const = 0;
};

}  // namespace titin
