/// Finite viscoelasticity around any isotropic term: a Maxwell branch, whose spring is the term and sees the elastic
/// part of the deformation only. Reese, Govindjee (1998), eqs. 40 to 58.
///
///   b_e = F C_i^-1 F^T,  -1/2 L_v(b_e) b_e^-1 = dev(tau) / (2 eta_D) + tr(tau) / (9 eta_V) I
///
/// The step is implicit by the exponential map: in the axes of the trial b_e = F C_i,n^-1 F^T, with logarithmic strains
/// e_a,
///
///   e_a - e_a,trial + dt [ (tau_a - tr(tau) / 3) / (2 eta_D) + tr(tau) / (9 eta_V) ] = 0,
///
/// which keeps det C_i when there is no volumetric flow and is of first order in dt. tau_a and d tau_a / d e_b are the
/// term's own stress and tangent at F = diag(exp e), so any isotropic law serves as the spring.
#pragma once

#include <limits>

#include "materials/response.hpp"
#include "math/spectral.hpp"
#include "math/symmetric.hpp"

namespace titin {

struct MaxwellFlow {
  double viscosity = 0;                                             // eta_D [Pa s]
  double bulk_viscosity = std::numeric_limits<double>::infinity();  // eta_V [Pa s]; infinite: volume does not flow
  void bind(Section& s);
};

class MaxwellResponse final : public Response {
 public:
  MaxwellResponse(MaxwellFlow flow, std::shared_ptr<const Response> spring) : flow_(flow), spring_(std::move(spring)) {}
  int history_size() const override { return own_size; }
  void start(const PointInput& rest, double* row) const override;
  void evaluate(const PointInput& in, HistoryRows history, Mat3* P, Mat9* A, double* W) const override;
  double dissipated(const double* row) const override { return row[0]; }

 private:
  static constexpr int own_size = 7;  // dissipated energy, C_i^-1 - I (6)

  struct Point {
    Eigenpairs trial;  // of the trial b_e
    Vec3 trial_strain, strain, tau;
    Mat3 moduli;    // d tau_a / d e_b, then the algorithmic ones
    Mat3 jacobian;  // of the flow equations
  };
  void solve(std::vector<Point>& points, double dt, double* W) const;
  void pull(std::vector<Point>& points, double* W) const;
  double correct(Point& point, double dt) const;
  void write(const Point& point, const Mat3& F, double dt, const double* old, double* now, Mat3& P, Mat9* A) const;

  MaxwellFlow flow_;
  std::shared_ptr<const Response> spring_;
};

}  // namespace titin
