/// What is written of a state of a material point: deformation, stresses, energies and work, term by term.
#pragma once

#include <string>
#include <vector>

#include "materials/material.hpp"
#include "point/equilibrium.hpp"

namespace titin {

class Record {
 public:
  /// `driven`: the component of stress that is also written for each term.
  Record(const Material& material, Volume volume, int driven);
  const std::vector<std::string>& columns() const { return columns_; }
  /// The row of a state that `step` led to; call once for each step, in order, because work adds up.
  std::vector<double> row(const PointInput& step, const PointState& state, int iterations);

 private:
  void add_columns();
  void add_tensors(const PointState& state, std::vector<double>& row) const;
  void add_fibres(const PointInput& in, std::vector<double>& row) const;
  void add_energies(const PointInput& in, const PointState& state, std::vector<double>& row);
  double work_in_step(const Mat3& P_old, const Mat3& P, const Mat3& F) const;

  const Material& material_;
  Volume volume_;
  int driven_;
  std::vector<std::string> columns_;
  // of the last row
  bool first_ = true;
  Mat3 F_ = identity, P_{};
  std::vector<Mat3> P_term_;
  double work_ = 0;
  std::vector<double> work_term_;
};

}  // namespace titin
