#include "fe/momenta.hpp"

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "mesh/simplex_geometry.hpp"
#include "mesh/torques.hpp"

namespace titin {

/// Interpolates what MuscleSystem::cell_values() gave.
Vec3 Momenta::at_point(int cell, int q, const std::vector<double>& values) const {
  const CellTables& tables = system_.tables();
  const double* nodal = &values[system_.first_value(cell)];
  Vec3 x{};
  for (int i = 0; i < tables.dimension(); ++i, nodal += tables.nodes(cell))
    for (int a = 0; a < tables.nodes(cell); ++a) x[i] += tables.shape(cell, q)[a] * nodal[a];
  return x;
}

void Momenta::update(const mfem::Vector& u, const mfem::Vector& v) {
  if (!moving()) return;
  mfem::Vector x(X_);
  x += u;
  const std::vector<double> x_cells = system_.cell_values(x), v_cells = system_.cell_values(v);
  kinetic_ = 0;
  linear_ = angular_ = {};
  for (int cell = 0; cell < system_.tables().cells(); ++cell)
    for (int q = 0; q < system_.tables().points(cell); ++q) {
      const double mass = system_.material(cell).density() * system_.tables().weight(cell, q);
      const Vec3 velocity = at_point(cell, q, v_cells), spin = cross(at_point(cell, q, x_cells), velocity);
      kinetic_ += 0.5 * mass * dot(velocity, velocity);
      for (int i = 0; i < 3; ++i) linear_[i] += mass * velocity[i], angular_[i] += mass * spin[i];
    }
}

void Momenta::list(std::vector<Quantity>& quantities) const {
  if (!moving()) return;
  const int dimension = system_.tables().dimension();
  for (int i = 0; i < dimension; ++i)
    quantities.push_back({fmt::format("momentum_{}", "xyz"[i]), "kg m/s", sum(linear_[i])});
  for (int i = first_torque_axis(dimension); i < 3; ++i)
    quantities.push_back({fmt::format("angular_momentum_{}", "xyz"[i]), "kg m^2/s", sum(angular_[i])});
}

}  // namespace titin
