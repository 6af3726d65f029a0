/// Fluids, and the fluid part of solids: pressure from density and internal energy, p(rho, e).
///
/// A law is a struct with `template <class T> T pressure(const T& rho, const T& e) const`, the range of states that it
/// is good for, and its keys. The sound speed follows for all: c^2 = dp/drho + p / rho^2 dp/de, by dual numbers.
#pragma once

#include <cmath>
#include <memory>

#include "materials/registry.hpp"
#include "math/dual.hpp"

namespace titin {

class Fluid {
 public:
  struct State {
    double pressure, sound_speed;  ///< [Pa], [m/s]; the speed is not a number where c^2 < 0
  };
  virtual ~Fluid() = default;
  /// At a density [kg/m^3] and a specific internal energy [J/kg].
  virtual State state(double density, double energy) const = 0;
  /// The specific internal energy of a pressure [J/kg]; all laws here are linear in it.
  virtual double energy(double density, double pressure) const = 0;
  /// Is this a state the law is good for, with real sound waves?
  virtual bool admissible(double density, double energy) const = 0;

  static std::shared_ptr<const Fluid> read(Section section);  ///< `law` and its keys
};

struct FluidEntry {
  LawInfo info;
  std::function<std::shared_ptr<const Fluid>(Section)> read;
};
const std::vector<FluidEntry>& fluid_entries();

namespace detail {

template <class Law>
class FluidAdaptor final : public Fluid {
 public:
  explicit FluidAdaptor(Law law) : law_(law) {}
  State state(double density, double energy) const override {
    using Number = Dual<2, 1>;
    const Number p = law_.pressure(Number::variable(density, 0), Number::variable(energy, 1));
    return {p.value, std::sqrt(p.gradient[0] + p.value / (density * density) * p.gradient[1])};
  }
  double energy(double density, double pressure) const override {
    const double at_zero = law_.pressure(density, 0.0), slope = law_.pressure(density, 1.0) - at_zero;
    return (pressure - at_zero) / slope;
  }
  bool admissible(double density, double energy) const override {
    return density > 0 && law_.covers(density, energy) && state(density, energy).sound_speed > 0;
  }

 private:
  Law law_;
};

}  // namespace detail

/// p = (gamma - 1) rho e.
struct PerfectGas {
  static constexpr auto name = "perfect_gas";
  static constexpr auto formula = "p = (gamma - 1) rho e";
  static constexpr auto source = "Toro 2009, Riemann Solvers, section 1.2";
  inline static const std::array published{
      ParameterSet{"air", R"(gamma = 1.4)", "Toro 2009, Riemann Solvers, section 1.2"}};
  double gamma = 1.4;
  void bind(Section& s) {
    s.read("gamma", gamma, {.range = {.min = 1, .open_min = true}, .doc = "ratio of specific heats"});
  }
  template <class T>
  T pressure(const T& rho, const T& e) const {
    return (gamma - 1) * rho * e;
  }
  bool covers(double, double e) const { return e > 0; }
};

/// Noble-Abel stiffened gas: p = (gamma - 1) rho (e - q) / (1 - b rho) - gamma Pi. With b = q = 0 the stiffened gas,
/// which also stands for water and for the pressure of metals: K = rho c^2 = gamma (p + Pi).
struct StiffenedGas {
  static constexpr auto name = "stiffened_gas";
  static constexpr auto formula = "p = (gamma - 1) rho (e - q) / (1 - b rho) - gamma Pi";
  static constexpr auto source = "Le Metayer & Saurel 2016, Phys. Fluids 28:046102";
  inline static const std::array published{
      ParameterSet{
          "liquid water, 300 to 500 K",
          R"(gamma = 1.19, stiffening = "702.8 MPa", covolume = "6.61e-4 m^3/kg", bond_energy = "-1177788 J/kg")",
          "Le Metayer & Saurel 2016, Phys. Fluids 28:046102"},
      ParameterSet{"water, without covolume", R"(gamma = 4.4, stiffening = "600 MPa")",
                   "Saurel & Abgrall 1999, J. Comput. Phys. 150:425"}};
  double gamma = 4.4, stiffening = 0, covolume = 0, bond_energy = 0;
  void bind(Section& s) {
    s.read("gamma", gamma, {.range = {.min = 1, .open_min = true}, .doc = "Grueneisen-like exponent"});
    s.read("stiffening", stiffening, {.unit = "Pa", .range = non_negative, .doc = "Pi, the attraction of molecules"});
    s.read("covolume", covolume, {.unit = "m^3/kg", .range = non_negative, .doc = "b, the volume they take up"});
    s.read("bond_energy", bond_energy, {.unit = "J/kg", .doc = "q, the energy at rest"});
  }
  template <class T>
  T pressure(const T& rho, const T& e) const {
    return (gamma - 1) * rho * (e - bond_energy) / (1.0 - covolume * rho) - gamma * stiffening;
  }
  bool covers(double rho, double e) const { return covolume * rho < 1 && pressure(rho, e) + stiffening > 0; }
};

/// Mie-Grueneisen with the Hugoniot Us = c0 + s up as reference and rho Gamma constant:
/// p = rho0 c0^2 y (chi - Gamma0 y / 2) / (chi - s y)^2 + rho0 Gamma0 e, chi = rho / rho0, y = chi - 1.
struct MieGruneisen {
  static constexpr auto name = "mie_gruneisen";
  static constexpr auto formula =
      "p = rho0 c0^2 y (chi - Gamma0 y/2) / (chi - s y)^2 + rho0 Gamma0 e, chi = rho/rho0, y = chi - 1";
  static constexpr auto source = "Meyers 1994, Dynamic Behavior of Materials, chapter 4";
  inline static const std::array published{ParameterSet{
      "copper", R"(reference_density = "8930 kg/m^3", sound_speed = "3940 m/s", slope = 1.489, gruneisen = 2)",
      "Meyers 1994, Dynamic Behavior of Materials, table 4.1"}};
  double density = 0, sound_speed = 0, slope = 0, gruneisen = 0;
  void bind(Section& s) {
    s.read("reference_density", density,
           {.unit = "kg/m^3", .range = positive, .required = true, .doc = "rho0, at rest"});
    s.read("sound_speed", sound_speed, {.unit = "m/s", .range = positive, .required = true, .doc = "c0, at rest"});
    s.read("slope", slope,
           {.range = non_negative, .required = true, .doc = "s of the shock speed over the particle speed"});
    s.read("gruneisen", gruneisen, {.range = positive, .required = true, .doc = "Gamma0"});
  }
  template <class T>
  T pressure(const T& rho, const T& e) const {
    const T chi = rho / density, y = chi - 1.0, d = chi - slope * y;
    return density * sound_speed * sound_speed * y * (chi - 0.5 * gruneisen * y) / (d * d) + density * gruneisen * e;
  }
  bool covers(double rho, double) const {
    const double chi = rho / density;
    return chi > slope * (chi - 1);
  }
};

}  // namespace titin
