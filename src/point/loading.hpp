/// What is done to a material point: which components of F are driven, held or free, and how the drive goes in time.
///
///     uniaxial        F_xx driven; no other stress, no rotation (F_yx = F_zx = F_zy = 0)
///     equibiaxial     F_xx = F_yy driven; no stress along z
///     planar          F_xx driven, F_yy = 1 ("pure shear"); no stress along z
///     biaxial         F_xx driven, F_yy - 1 = ratio (F_xx - 1); no stress along z
///     simple_shear    one off-diagonal component driven, F = I besides
///     triaxial_shear  simple shear in each of the six planes, one after the other from rest
///     confined        F_xx driven, F = I besides
///     components      each component as the user says
///
/// The drive is a stretch, an amount of shear, or instead the first Piola stress of the driven component [Pa].
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "point/equilibrium.hpp"

namespace titin {

enum class Loading { uniaxial, equibiaxial, planar, biaxial, simple_shear, triaxial_shear, confined, components };
enum class Program { ramp, hold, cycle, sine, isotonic };
enum class Spacing { equal, logarithmic };

inline constexpr std::array<const char*, 9> component_names{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
inline constexpr std::array<int, 6> shear_components{1, 2, 3, 5, 6, 7};

/// A component of F, or of P [Pa], against time.
struct ComponentDrive {
  bool by_stress = false;
  Table value = 0;
};

/// [point] of a scene, but for its material.
struct LoadingConfig {
  Loading loading = Loading::uniaxial;
  Volume volume = Volume::compressible;
  FibreRate fibre_rate = FibreRate::stretch_difference;
  double ratio = 1;
  int plane = 1;           ///< component of F that simple shear drives
  bool by_stress = false;  ///< the drive is a stress
  bool needs_drive = true;
  Table drive = 1;  ///< target of the program, or the whole course
  std::array<ComponentDrive, 9> components;

  Program program = Program::ramp;
  Spacing spacing = Spacing::equal;
  double rise = 1, end = 0;                                  ///< [s]
  double release = std::numeric_limits<double>::infinity();  ///< isotonic [s]
  double load = 1;  ///< isotonic: share of the stress at the release that is held after it
  int cycles = 1, steps = 50;

  void bind(Section& s);

  bool is_shear() const { return loading == Loading::simple_shear || loading == Loading::triaxial_shear; }
  int driven() const { return is_shear() ? plane : 0; }  ///< the component that the drive is
  /// The drive against time, as the program makes it.
  Table course() const;
  /// Ends of the steps [s], the first one 0.
  std::vector<double> times() const;
  MixedControl control(double time, double drive, bool by_stress) const;

 private:
  void bind_drive(Section& s);
  void bind_components(Section& s);
  void bind_table(Section& s);
  void bind_program(Section& s);
  void check(Section& s) const;
  double rest() const { return by_stress || is_shear() ? 0 : 1; }
  MixedControl aligned(double drive, bool by_stress) const;
  MixedControl sheared(double drive, bool by_stress) const;
};

}  // namespace titin
