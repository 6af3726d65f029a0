/// Small blocks for the tests of the muscle formulation, made from scene text as a user would.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "base/config.hpp"
#include "fe/muscle.hpp"

namespace titin::test {

inline const std::string muscle_material = R"(
[materials.muscle]
density = "1060 kg/m^3"
fibre = [0.8, 0.2, 0.5]
volumetric = { law = "simo", bulk_modulus = "10 MPa" }
[materials.muscle.terms]
base = { law = "yeoh", c1 = "40 kPa", c2 = "73 kPa" }
passive = { law = "hill_passive", peak_stress = "200 kPa" }
[materials.muscle.terms.active]
law = "hill_active"
peak_stress = "200 kPa"
max_strain_rate = "5 1/s"
activation = { time = "0, 0.1 s", value = [0, 1] }
)";

inline const std::string soft_material = R"(
[materials.soft]
density = "1000 kg/m^3"
volumetric = { law = "simo", bulk_modulus = "500 kPa" }
[materials.soft.terms]
base = { law = "neo_hookean", mu = "100 kPa" }
)";

struct Parts {
  MeshConfig mesh;
  MuscleConfig muscle;
  NamedMesh named;
};

using Overrides = std::vector<std::string>;

/// A block of 30 x 10 x 10 mm unless `text` or `set` say otherwise; `bend` moves the vertices so that cells are no
/// bricks.
inline Parts read_block(const std::string& text, bool bend = false, const Overrides& set = {}) {
  Config config("[mesh]\nbox = \"30, 10, 10 mm\"\ncells = [2, 2, 2]\n" + text, "test", set);
  Section root = config.root();
  Parts parts;
  Section mesh = root.section("mesh");
  parts.mesh.bind(mesh);
  parts.named = NamedMesh::read(parts.mesh, mesh);
  parts.muscle.bind(root, parts.named);
  config.finish();
  if (bend)
    parts.named.mesh->Transform([](const mfem::Vector& x, mfem::Vector& y) {
      y = x;
      y(0) += 0.15 * x(1) * std::sin(200 * x(2)) + 8 * x(0) * x(1);
      y(2) += 0.2 * x(0) * std::cos(100 * x(1)) + 10 * x(1) * x(2);
    });
  return parts;
}

inline std::unique_ptr<Muscle> make_block(const std::string& text, bool bend = false, const Overrides& set = {}) {
  Parts parts = read_block(text, bend, set);
  return std::make_unique<Muscle>(std::move(parts.named), std::move(parts.muscle));
}

inline double quantity(Model& model, const std::string& name) {
  for (const Quantity& q : model.quantities())
    if (q.name == name) return q.value;
  throw std::out_of_range("no quantity " + name);
}

/// Steps to `end`; returns the steps. Stops at the first that fails.
inline std::vector<Step> march(Model& model, double end, double dt) {
  std::vector<Step> steps;
  const int count = static_cast<int>(std::lround(end / dt));
  for (int n = 0; n < count; ++n) {
    steps.push_back(model.advance(dt));
    if (!steps.back().ok()) break;
    model.accept();
  }
  return steps;
}

/// True-dof vector of a displacement given as a function of the reference position.
inline mfem::Vector interpolate(mfem::ParFiniteElementSpace& space,
                                std::function<void(const mfem::Vector&, mfem::Vector&)> f) {
  mfem::VectorFunctionCoefficient coefficient(3, std::move(f));
  mfem::ParGridFunction field(&space);
  field.ProjectCoefficient(coefficient);
  mfem::Vector u(space.GetTrueVSize());
  field.GetTrueDofs(u);
  return u;
}

}  // namespace titin::test
