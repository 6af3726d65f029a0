#include "fe/stress_recovery.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "base/timers.hpp"

namespace titin {

namespace {

constexpr double tolerance = 1e-8;   // of the projection's equations: far below any error of discretisation
constexpr int max_iterations = 500;  // mass matrices need some tens

}  // namespace

StressRecovery::StressRecovery(MuscleSystem& system, double thickness)
    : system_(system),
      collection_(system.config().order, system.tables().dimension()),
      space_(system.space().GetParMesh(), &collection_),
      cell_error_(space_.GetNE()) {
  mfem::ParBilinearForm form(&space_);
  mfem::ConstantCoefficient scale(thickness);
  form.AddDomainIntegrator(new mfem::MassIntegrator(scale));
  form.Assemble();
  form.Finalize();
  mass_.reset(form.ParallelAssemble());
  const CellTables& tables = system.tables();
  mfem::Vector N;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    first_point_.push_back(static_cast<int>(stress_.size()));
    stress_.resize(stress_.size() + tables.points(cell));
    auto& shapes = shapes_[space_.GetParMesh()->GetElementGeometry(cell)];
    if (!shapes.empty()) continue;
    const mfem::FiniteElement& element = *space_.GetFE(cell);
    N.SetSize(element.GetDof());
    for (int q = 0; q < tables.points(cell); ++q) {
      element.CalcShape(tables.rule(cell).IntPoint(q), N);
      shapes.insert(shapes.end(), N.begin(), N.end());
    }
  }
}

const std::vector<double>& StressRecovery::shapes(int cell) const {
  return shapes_[space_.GetParMesh()->GetElementGeometry(cell)];
}

void StressRecovery::update(const mfem::Vector& u) {
  Timers::Scope timer("error estimate");
  take_stress(u);
  const CellTables& tables = system_.tables();
  std::vector<double> square(space_.GetNE());
  double norm = 0;
  mfem::Array<int> dofs;
  mfem::Vector values;
  for (int component = 0; component < 9; ++component) {
    const mfem::Vector smoothed = smooth(component);
    for (int cell = 0; cell < space_.GetNE(); ++cell) {
      space_.GetElementDofs(cell, dofs);
      smoothed.GetSubVector(dofs, values);
      for (int q = 0; q < tables.points(cell); ++q) {
        const double* N = &shapes(cell)[std::size_t(q) * dofs.Size()];
        const double stress = stress_[first_point(cell) + q][component], w = tables.weight(cell, q);
        double difference = -stress;
        for (int a = 0; a < dofs.Size(); ++a) difference += N[a] * values(a);
        square[cell] += w * difference * difference;
        norm += w * stress * stress;
      }
    }
  }
  double total = 0;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    cell_error_[cell] = std::sqrt(square[cell]);
    total += square[cell];
  }
  error_ = std::sqrt(sum(total));
  norm_ = std::sqrt(sum(norm));
}

/// The whole first Piola stress at all points.
void StressRecovery::take_stress(const mfem::Vector& u) {
  system_.for_each_cell(u, [&](int cell, const Material& material, const ThreeField& kernel) {
    const PointInput in = kernel.points(system_.point_input(cell));
    Mat3* P = &stress_[first_point(cell)];
    material.stress(in, P, nullptr);
    for (int q = 0; q < in.n; ++q) add(P[q], kernel.pressure()[q], cofactor(kernel.F()[q]));
  });
}

/// Local dofs of the projection of one component.
mfem::Vector StressRecovery::smooth(int component) {
  const CellTables& tables = system_.tables();
  mfem::Vector local(space_.GetVSize()), right(space_.GetTrueVSize()), solution(space_.GetTrueVSize());
  local = 0.0;
  solution = 0.0;
  mfem::Array<int> dofs;
  for (int cell = 0; cell < space_.GetNE(); ++cell) {
    space_.GetElementDofs(cell, dofs);
    for (int q = 0; q < tables.points(cell); ++q) {
      const double* N = &shapes(cell)[std::size_t(q) * dofs.Size()];
      const double weighted = tables.weight(cell, q) * stress_[first_point(cell) + q][component];
      for (int a = 0; a < dofs.Size(); ++a) local(dofs[a]) += weighted * N[a];
    }
  }
  space_.GetProlongationMatrix()->MultTranspose(local, right);
  mfem::HypreSmoother jacobi(*mass_, mfem::HypreSmoother::Jacobi);
  mfem::CGSolver cg(space_.GetComm());
  cg.SetOperator(*mass_);
  cg.SetPreconditioner(jacobi);
  cg.SetRelTol(tolerance);
  cg.SetMaxIter(max_iterations);
  cg.Mult(right, solution);
  space_.GetProlongationMatrix()->Mult(solution, local);
  return local;
}

double StressRecovery::density(int cell) const {
  double volume = 0;
  for (int q = 0; q < system_.tables().points(cell); ++q) volume += system_.tables().weight(cell, q);
  return cell_error_[cell] / std::sqrt(volume);
}

}  // namespace titin
