/// One point of a material with a history, taken through time.
#pragma once

#include <vector>

#include "materials_for_tests.hpp"

namespace titin::testing {

class RememberingPoint {
 public:
  explicit RememberingPoint(MaterialPointer material)
      : material_(std::move(material)), old_(material_->history_size()), now_(old_) {
    PointInput rest = point_.input();
    material_->start_history(rest, old_.data());
    now_ = old_;
  }
  /// Stress of a step of length dt to F; take() makes it the past.
  Mat3 stress(const Mat3& F, double dt, Mat9* A = nullptr) {
    point_.F = F;
    point_.dt = dt;
    Mat3 P;
    material_->stress(input(), &P, A);
    return P;
  }
  void take() {
    point_.F_old = point_.F;
    old_ = now_;
  }
  Mat3 step(const Mat3& F, double dt) {
    const Mat3 P = stress(F, dt);
    take();
    return P;
  }
  /// All that a point carries from one step to the next.
  struct Saved {
    std::vector<double> history;
    Mat3 F;
  };
  Saved saved() const { return {old_, point_.F_old}; }
  void restore(const Saved& saved) {
    old_ = saved.history;
    point_.F_old = saved.F;
  }
  double stored() {
    double W;
    material_->term_energy(0, input(), &W);
    return W;
  }
  double dissipated() {
    double D;
    material_->term_dissipation(0, 1, now_.data(), &D);
    return D;
  }

 private:
  PointInput input() {
    PointInput in = point_.input();
    in.history = old_.data();
    in.new_history = now_.data();
    return in;
  }
  MaterialPointer material_;
  Point point_;
  std::vector<double> old_, now_;
};

inline nlohmann::json time_dependent() {
  return nlohmann::json::parse(std::ifstream(TITIN_TEST_DATA "/materials/time_dependent.json"));
}
inline Mat3 diagonal(double a, double b, double c) { return {a, 0, 0, 0, b, 0, 0, 0, c}; }

/// Order of the central difference of a step's stress against its tangent, at a deformation and direction of no
/// symmetry.
inline double tangent_order(RememberingPoint& point, const Mat3& F, double dt) {
  const Mat3 H{0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.2, 0.6, -0.1};
  Mat9 A;
  point.stress(F, dt, &A);
  const auto error = [&](double h) {
    Mat3 plus = F, minus = F;
    for (int i = 0; i < 9; ++i) plus[i] += h * H[i], minus[i] -= h * H[i];
    const Mat3 P1 = point.stress(plus, dt), P0 = point.stress(minus, dt);
    double square = 0;
    for (int i = 0; i < 9; ++i) {
      double AH = 0;
      for (int j = 0; j < 9; ++j) AH += A[9 * i + j] * H[j];
      square += std::pow((P1[i] - P0[i]) / (2 * h) - AH, 2);
    }
    return std::sqrt(square);
  };
  return std::log2(error(2e-3) / error(1e-3));
}

}  // namespace titin::testing
