/// Volumetric energies U(D) [J/m^3] of a volume ratio D = J, all with U(1) = U'(1) = 0 and U''(1) = bulk_modulus.
#pragma once

#include "materials/registry.hpp"

namespace titin {

/// What the three share: a bulk modulus.
struct BulkModulus {
  double bulk_modulus = 0;  ///< [Pa]
  void bind(Section& s) {
    s.read("bulk_modulus", bulk_modulus,
           {.unit = "Pa", .range = positive, .required = true, .doc = "stiffness against change of volume at rest"});
  }
};

/// Convex, and without bound both ways: the one to prefer.
struct SimoVolume : BulkModulus {
  static constexpr auto name = "simo";
  static constexpr auto formula = "U = K/4 (D^2 - 1 - 2 ln D)";
  static constexpr auto source = "Simo & Taylor 1991, Comput. Methods Appl. Mech. Eng. 85:273";
  inline static const std::array published{
      ParameterSet{"skeletal muscle", R"(bulk_modulus = "10 MPa")", "Flexodeal Lite 1.5.4, parameters.prm"}};
  template <class T>
  T energy(const T& ratio) const {
    using std::log;
    return 0.25 * bulk_modulus * ((ratio - 1.0) * (ratio + 1.0) - 2.0 * log(ratio));
  }
};
TITIN_VOLUMETRIC(SimoVolume)

/// Its energy stays finite where the volume vanishes.
struct QuadraticVolume : BulkModulus {
  static constexpr auto name = "quad";
  static constexpr auto formula = "U = K/2 (D - 1)^2";
  static constexpr auto source = "the default of Abaqus, among others";
  inline static const std::array published{
      ParameterSet{"myocardium", R"(bulk_modulus = "1 MPa")", "CardioMechanics, example EM01"}};
  template <class T>
  T energy(const T& ratio) const {
    const T change = ratio - 1.0;
    return 0.5 * bulk_modulus * change * change;
  }
};
TITIN_VOLUMETRIC(QuadraticVolume)

/// Not convex beyond D = e.
struct LogarithmicVolume : BulkModulus {
  static constexpr auto name = "log";
  static constexpr auto formula = "U = K/2 (ln D)^2";
  static constexpr auto source = "the default of FEBio's uncoupled solids";
  inline static const std::array published{
      ParameterSet{"skeletal muscle", R"(bulk_modulus = "10 MPa")", "FEBio test decks mu02 and mu03"}};
  template <class T>
  T energy(const T& ratio) const {
    using std::log;
    const T l = log(ratio);
    return 0.5 * bulk_modulus * l * l;
  }
};
TITIN_VOLUMETRIC(LogarithmicVolume)

/// Convex, and without bound both ways.
struct QuadraticLogarithmicVolume : BulkModulus {
  static constexpr auto name = "quad_log";
  static constexpr auto formula = "U = K/4 [(D - 1)^2 + (ln D)^2]";
  static constexpr auto source = "Boscheri, Loubere & Maire, ADER-MOOD scheme for hyperelastic solids";
  inline static const std::array published{ParameterSet{"rubber of the twisting column, E = 17 MPa, nu = 0.45",
                                                        R"(bulk_modulus = "56.66667 MPa")",
                                                        "Boscheri, Loubere & Maire 2022, J. Comput. Phys. 449:110779"}};
  template <class T>
  T energy(const T& ratio) const {
    using std::log;
    const T change = ratio - 1.0, l = log(ratio);
    return 0.25 * bulk_modulus * (change * change + l * l);
  }
};
TITIN_VOLUMETRIC(QuadraticLogarithmicVolume)

}  // namespace titin
