// The quick search for the fastest wave against the thorough one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/config.hpp"
#include "materials/ellipticity.hpp"
#include "materials/fastest_wave.hpp"

namespace titin {
namespace {

std::shared_ptr<const Material> solid(const std::string& terms) {
  Config text(
      "density = \"1000 kg/m^3\"\nfibre = [0.6, 0.8, 0]\nvolumetric = { law = \"quad_log\", bulk_modulus = \"1 MPa\" "
      "}\n" +
          terms,
      "test.toml");
  auto material = Material::read(text.root());
  text.finish();
  return material;
}

const char* const solids[] = {
    "terms.m = { law = \"neo_hookean\", mu = \"300 kPa\" }",
    "terms.m = { law = \"isotropic_family\", mu = \"300 kPa\", a = 0 }",
    "terms.m = { law = \"isotropic_family\", mu = \"300 kPa\", a = 0.5 }",
    "terms.m = { law = \"neo_hookean\", mu = \"30 kPa\" }\nterms.f = { law = \"linear_fibre\", stiffness = \"4 MPa\" }",
    "terms.m = { law = \"mooney_rivlin\", c1 = \"100 kPa\", c2 = \"60 kPa\" }",
};

TEST(FastestWave, IsTheThoroughSearchsToAThousandth) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  for (const char* terms : solids) {
    const auto material = solid(terms);
    double worst = 0;
    for (int k = 0; k < 60; ++k) {
      Mat3 F = identity;
      for (double& x : F) x += part(random);
      if (determinant(F) < 0.3) continue;
      PointInput in;
      in.n = 1;
      in.F = &F;
      double quick = 0, thorough = 0;
      fastest_wave(*material, in, &quick);
      wave_speed(*material, in, &thorough);
      worst = std::max(worst, std::abs(quick / thorough - 1));
    }
    EXPECT_LT(worst, 1e-3) << terms;
    EXPECT_GT(worst, 0) << "two searches, not one";
  }
}

TEST(FastestWave, IsNotANumberWhereTheStressIsNone) {
  const auto material = solid(solids[0]);
  const Mat3 inside_out{-1, 0, 0, 0, 1, 0, 0, 0, 1};
  PointInput in;
  in.n = 1;
  in.F = &inside_out;
  double speed = 0;
  fastest_wave(*material, in, &speed);
  EXPECT_TRUE(std::isnan(speed));
}

}  // namespace
}  // namespace titin
