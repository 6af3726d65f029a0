/// The material that scenes describe: a weighted sum of terms, of volumetric functions and of densities.
///
/// A rule of mixtures is nothing but weights: W = (1 - fraction) W_own + fraction W_mix.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "materials/material.hpp"
#include "materials/registry.hpp"
#include "materials/response.hpp"

namespace titin {

struct WeightedTerm {
  TermInfo info;
  double weight = 1;
  std::shared_ptr<const Term> term;
  std::vector<Wrapper> wrappers;  ///< what gives it a memory, inner first (materials/memory_material.hpp)
};
struct WeightedVolumetric {
  double weight = 1;
  std::shared_ptr<const VolumetricLaw> law;
};

class SumMaterial final : public Material {
 public:
  struct Parts {
    double density = 0;
    FibrePair<double> fibres{};
    FibreMeasure measure = FibreMeasure::isochoric;
    std::vector<WeightedTerm> terms;
    std::vector<WeightedVolumetric> volumetric;
    MaterialFields fields;
  };
  explicit SumMaterial(Parts parts);

  double density() const override { return parts_.density; }
  Vec3 fibre() const override { return parts_.fibres.first; }
  Vec3 second_fibre() const override { return parts_.fibres.second; }
  const MaterialFields& fields() const override { return parts_.fields; }
  bool has_fibres() const override { return used_.has_any({Invariant::I4, Invariant::I5, Invariant::I8}); }
  bool has_volumetric_law() const override { return !parts_.volumetric.empty(); }
  bool symmetric_tangent(FibreRate rate) const override;
  const std::vector<TermInfo>& terms() const override { return infos_; }

  void stress(const PointInput& in, Mat3* P, Mat9* A) const override;
  void cauchy_stress(const PointInput& in, Sym3* T, double* W) const override;
  void term_stress(int term, const PointInput& in, Mat3* P) const override;
  void term_energy(int term, const PointInput& in, double* W) const override;
  void potential(const PointInput& in, double* W) const override;
  void fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const override;
  Volumetric volumetric(double ratio) const override;
  std::vector<double> kinks() const override;

 private:
  std::span<const WeightedTerm> terms(PointInput::Part part) const;
  void evaluate(const PointInput& in, std::span<const WeightedTerm> terms, Mat3* P, Mat9* A) const;

  Parts parts_;
  std::vector<WeightedTerm> stored_, rest_;
  std::vector<TermInfo> infos_;
  InvariantSet used_;
};

}  // namespace titin
