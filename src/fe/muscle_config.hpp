/// What a scene says of the muscle formulation.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fe/cell_element.hpp"
#include "fe/initial_motion.hpp"
#include "fe/links.hpp"
#include "fe/loads.hpp"
#include "fe/point_fields.hpp"
#include "materials/material.hpp"
#include "mesh/averages.hpp"
#include "mesh/exact_motion.hpp"
#include "mesh/mesh.hpp"
#include "mesh/torques.hpp"
#include "solve/integrator.hpp"
#include "solve/newton.hpp"

namespace titin {

enum class Inertia { dynamic, quasi_static };

struct MuscleConfig {
  Inertia inertia = Inertia::dynamic;
  Formulation formulation = Formulation::three_field;
  int order = 2;          // of the displacement
  int quadrature = 0;     // Gauss points per direction; 0: order + 1
  CellElements elements;  // by geometry of the cells
  FibreRate fibre_rate = FibreRate::stretch_difference;
  bool error_estimate = false;
  std::array<double, 3> pennation_axis{1, 0, 0};
  bool ellipticity = false;
  std::array<double, 3> body_acceleration{};  // [m/s^2]
  Table body_scale{1};
  std::vector<BoundaryConfig> boundaries;
  std::vector<LinkConfig> links;
  std::vector<MarkerConfig> markers;
  std::vector<AverageConfig> averages;
  std::vector<TorqueConfig> torques;
  std::map<std::string, std::shared_ptr<const Material>> materials;
  std::map<int, std::string> material_of_region;  // by mesh attribute
  PointFields point_fields;
  InitialMotion initial;
  std::shared_ptr<const ExactMotion> exact_motion;  // null unless the scene names one
  NewtonConfig newton;
  IntegratorConfig integrator;

  int points() const { return quadrature > 0 ? quadrature : order + 1; }
  FibreRate rate() const { return inertia == Inertia::dynamic ? fibre_rate : FibreRate::none; }
  /// What of the rate changes within a step.
  FibreRate varying_rate() const { return integrator.scheme == Scheme::semi_implicit ? FibreRate::none : rate(); }
  /// Why the block and condensed solvers cannot be had; empty where they can.
  std::string block_solver_problem() const;
  void bind(Section& root, const NamedMesh& mesh);

 private:
  void bind_boundaries(Section& root, const NamedMesh& mesh);
  void bind_materials(Section& root, const NamedMesh& mesh);
  void bind_torques(Section& root, const NamedMesh& mesh);
};

}  // namespace titin
