/// A material some of whose terms remember: the sum of the plain terms, and a response for each term with wrappers.
#pragma once

#include <memory>

#include "materials/response.hpp"
#include "materials/sum_material.hpp"

namespace titin {

/// The material of these parts; one without history when no term has wrappers.
std::shared_ptr<const Material> with_memory(SumMaterial::Parts parts);

class MemoryMaterial final : public Material {
 public:
  explicit MemoryMaterial(SumMaterial::Parts parts);

  double density() const override { return elastic_.density(); }
  Vec3 fibre() const override { return elastic_.fibre(); }
  Vec3 second_fibre() const override { return elastic_.second_fibre(); }
  const MaterialFields& fields() const override { return elastic_.fields(); }
  bool has_fibres() const override { return elastic_.has_fibres(); }
  bool has_volumetric_law() const override { return elastic_.has_volumetric_law(); }
  bool symmetric_tangent(FibreRate rate) const override { return elastic_.symmetric_tangent(rate); }
  const std::vector<TermInfo>& terms() const override { return infos_; }

  void stress(const PointInput& in, Mat3* P, Mat9* A) const override;
  void term_stress(int term, const PointInput& in, Mat3* P) const override;
  void term_energy(int term, const PointInput& in, double* W) const override;
  void potential(const PointInput& in, double* W) const override;
  void fibre_state(const PointInput& in, double* stretch, double* rate, double* activation) const override {
    elastic_.fibre_state(in, stretch, rate, activation);
  }
  std::vector<double> kinks() const override { return elastic_.kinks(); }
  Volumetric volumetric(double ratio) const override { return elastic_.volumetric(ratio); }

  int history_size() const override { return history_size_; }
  void start_history(const PointInput& rest, double* row) const override;
  void term_dissipation(int term, int n, const double* history, double* D) const override;

 private:
  struct Remembering {
    std::shared_ptr<const Response> response;
    double weight;
    int at;  // column of its first history
  };
  /// What one evaluation works on: the caller's rows, or at rest, or scratch; directions of the points in any case.
  struct Rows;
  const Remembering* remembering(int term) const;  // null for a plain term

  SumMaterial elastic_, plain_;  // all terms without their memory; those that have none
  FibrePair<double> fibres_{};   // where the caller gives none
  std::vector<TermInfo> infos_;  // plain ones first
  std::vector<Remembering> remembering_;
  int history_size_ = 0;
};

}  // namespace titin
