/// Rods for tests, made from scene text as a user would.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/config.hpp"
#include "rod/rod.hpp"

namespace titin::test {

/// 100 mm of 1 cm^2, of a base with Young's modulus 600 kPa at rest and a density of 1060 kg/m^3.
inline const std::string linear_rod = R"(
[rod]
length = "100 mm"
area = "1 cm^2"
[materials.base]
density = "1060 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
terms.base = { law = "neo_hookean", mu = "200 kPa" }
)";
constexpr double rod_length = 0.1, rod_area = 1e-4, rod_density = 1060, rod_modulus = 6e5;

using Overrides = std::vector<std::string>;

struct RodParts {
  NamedMesh mesh;
  RodConfig config;
};

inline RodParts read_rod(const std::string& text, const Overrides& set = {}) {
  Config config(text, "test", set);
  Section root = config.root();
  RodParts parts;
  parts.mesh = parts.config.bind(root);
  config.finish();
  return parts;
}

inline std::unique_ptr<Rod> make_rod(const std::string& text, const Overrides& set = {}) {
  RodParts parts = read_rod(text, set);
  return std::make_unique<Rod>(std::move(parts.mesh), std::move(parts.config));
}

inline double quantity(Model& model, const std::string& name) {
  for (const Quantity& q : model.quantities())
    if (q.name == name) return q.value;
  throw std::out_of_range("no quantity " + name);
}

}  // namespace titin::test
