/// Growth of a whole material at a given growth tensor: F = F_e F_g, and the material knows F_e alone.
///
///   P = w P_e(F_e) F_g^-T,   A[H] = w A_e[H F_g^-1] F_g^-T,   w = J_g = det F_g
///
/// Rodriguez, Hoger & McCulloch (1994), J. Biomech. 27, 455. Isotropic: F_g = s I; area across a unit normal N:
/// F_g = sqrt(s) I + (1 - sqrt(s)) N (x) N (s is the ratio of areas); along a unit direction a: F_g = I + (s - 1) a (x)
/// a.
///
/// Energies are per volume of the grown tissue, new tissue being like the old (`per = "intermediate"`), or per volume
/// before growth, as when a given mass swells (`per = "reference"`: w = 1). Fibres keep their reference direction a0
/// inside: grown tissue is laid down along a0.
///
/// The volumetric law grows too. As det F_g is given, U_e(J/J_g) is again a function of the volume ratio alone,
///
///   U(D) = w U_e(D/J_g),
///
/// and that is the one thing a three-field element sees of growth besides the stress of its terms: its dilatation D
/// stays that of the whole deformation, its pressure p = U'(D), its equations are untouched.
#pragma once

#include "materials/material.hpp"

namespace titin {

struct Growth {
  enum class Law { isotropic, area, fibre };
  enum class Per { intermediate, reference };

  Law law = Law::isotropic;
  Per per = Per::intermediate;
  double stretch = 1;
  Vec3 axis{};  ///< unit normal or direction; zero: the fibre of each point

  void bind(Section& s);
  double volume_ratio() const;  ///< det F_g
  double weight() const { return per == Per::intermediate ? volume_ratio() : 1; }
  Mat3 inverse(const Vec3& fibre) const;  ///< F_g^-1, symmetric
};

class GrownMaterial final : public Material {
 public:
  GrownMaterial(Growth growth, std::shared_ptr<const Material> inside) : growth_(growth), inside_(std::move(inside)) {}

  /// Per volume before growth: new tissue brings its mass, swelling none.
  double density() const override { return growth_.weight() * inside_->density(); }
  Vec3 fibre() const override { return inside_->fibre(); }
  Vec3 second_fibre() const override { return inside_->second_fibre(); }
  const MaterialFields& fields() const override { return inside_->fields(); }
  bool has_fibres() const override { return inside_->has_fibres(); }
  bool has_volumetric_law() const override { return inside_->has_volumetric_law(); }
  bool symmetric_tangent(FibreRate rate) const override { return inside_->symmetric_tangent(rate); }
  const std::vector<TermInfo>& terms() const override { return inside_->terms(); }

  void stress(const PointInput& in, Mat3* P, Mat9* A) const override;
  void term_stress(int term, const PointInput& in, Mat3* P) const override;
  void term_energy(int term, const PointInput& in, double* W) const override;
  void potential(const PointInput& in, double* W) const override;
  /// Of the elastic part, which is what the laws see.
  void fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const override;
  Volumetric volumetric(double ratio) const override;

  int history_size() const override { return inside_->history_size(); }
  void start_history(const PointInput& rest, double* row) const override { inside_->start_history(rest, row); }
  void term_dissipation(int term, int n, const double* history, double* D) const override;

 private:
  struct Points;  // of an input, as what is inside sees them

  Growth growth_;
  std::shared_ptr<const Material> inside_;
};

/// The material with the growth that its section asks for, if any.
std::shared_ptr<const Material> read_growth(Section& s, std::shared_ptr<const Material> material);

}  // namespace titin
