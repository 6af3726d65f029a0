/// What the tests of materials share: materials from a few lines of a scene, deformations, and one point's stress.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "materials/compressible.hpp"
#include "materials/registry.hpp"

namespace titin::testing {

using MaterialPointer = std::shared_ptr<const Material>;

/// The material that these lines of [materials.m] describe; throws InputError.
inline MaterialPointer material(const std::string& lines) {
  Config config("[materials.m]\n" + lines, "test.toml");
  MaterialPointer m = Material::read(config.root().section("materials").section("m"));
  config.finish();
  return m;
}

/// A material of one law, with fibres along (0.8, 0.36, 0.48) and a second family across them.
inline MaterialPointer material_of(const std::string& law, const std::string& parameters,
                                   const std::string& more = "") {
  const std::string comma = parameters.empty() ? "" : ", ";
  return material(
      "density = \"1000 kg/m^3\"\nfibre = [0.8, 0.36, 0.48]\nsecond_fibre = [0.36, -0.8, 0]\n"
      "volumetric = { law = \"simo\", bulk_modulus = \"1 MPa\" }\n" +
      more + "[materials.m.terms]\nt = { law = \"" + law + "\"" + comma + parameters + " }\n");
}

/// One point, with its arrays kept alive.
struct Point {
  Mat3 F = identity, F_old = identity;
  Vec3 fibre{0.8, 0.36, 0.48};
  FibreRate rate = FibreRate::none;
  double time = 0, dt = 0.01;

  PointInput input() const { return {1, &F, &F_old, &fibre, time, dt, rate}; }
};

inline Mat3 stress(const Material& m, const Point& p) {
  Mat3 P;
  m.stress(p.input(), &P, nullptr);
  return P;
}
inline Mat9 tangent(const Material& m, const Point& p) {
  Mat3 P;
  Mat9 A;
  m.stress(p.input(), &P, &A);
  return A;
}
inline double energy(const Material& m, const Point& p) {
  double W = 0, sum = 0;
  for (int t = 0; t < static_cast<int>(m.terms().size()); ++t) m.term_energy(t, p.input(), &W), sum += W;
  return sum;
}

template <class Array>
double size_of(const Array& a) {
  double sum = 0;
  for (double x : a) sum += x * x;
  return std::sqrt(sum);
}
template <class Array>
double distance(const Array& a, const Array& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

inline constexpr Mat3 general_F{1.12, 0.18, -0.07, 0.05, 0.93, 0.11, -0.04, 0.09, 1.06};
inline constexpr Mat3 general_F_old{1.1, 0.17, -0.06, 0.05, 0.935, 0.1, -0.03, 0.09, 1.055};

/// Rotation by `angle` about the unit axis (2, -1, 2) / 3.
inline Mat3 rotation(double angle) {
  const double n[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, c = std::cos(angle), s = std::sin(angle);
  Mat3 Q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q[3 * i + j] = (i == j ? c : 0) + (1 - c) * n[i] * n[j];
  Q[1] -= s * n[2], Q[3] += s * n[2];
  Q[2] += s * n[1], Q[6] -= s * n[1];
  Q[5] -= s * n[0], Q[7] += s * n[0];
  return Q;
}

inline nlohmann::json read_json(const std::string& file) {
  std::ifstream in(std::string(TITIN_TEST_DATA) + "/materials/" + file);
  return nlohmann::json::parse(in);
}
inline Mat3 mat3(const nlohmann::json& rows) {
  Mat3 A;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[3 * i + j] = rows[i][j];
  return A;
}

}  // namespace titin::testing
