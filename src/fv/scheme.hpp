/// The explicit updated Lagrangian cell-centred finite volume scheme: one step of a rank's cells and nodes.
///
///   m_c d(1/rho_c)/dt = sum_p (a n)_pc . v_p    m_c dv_c/dt = sum_p f_pc    m_c de_c/dt = sum_p f_pc . v_p    dx_p/dt
///   = v_p
///
/// with total specific energy e, corner forces and nodal velocities of fv/nodal_solver.hpp. The first equation is
/// solved exactly by the nodes themselves, rho_c = m_c / |w_c|, as is dF/dt = L F by F_c = D_s D_m^-1
/// (mesh/simplex_geometry.hpp). One step: half way nodes, slopes, cells at the middle of the step, corner forces in the
/// half way geometry, nodal velocities, update, judgement (fv/judgement.hpp, fv/mood.hpp). Maire (2009), J. Comput.
/// Phys. 228:2391; Boscheri, Loubere, Maire (2022), J. Comput. Phys. 449:110779. Units SI; in the plane per unit
/// thickness.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "fv/closure.hpp"
#include "fv/judgement.hpp"
#include "fv/mood.hpp"
#include "fv/nodal_solver.hpp"
#include "fv/patch_pressure.hpp"
#include "fv/predictor.hpp"
#include "solve/state_walk.hpp"

namespace titin {

/// What cells are made of and how they start.
struct CellStart {
  const Closure* closure = nullptr;
  double density = 0;    // [kg/m^3]
  double energy = 0;     // specific internal [J/kg]
  Vector<3> velocity{};  // [m/s]
};

template <int D>
class FlowScheme {
 public:
  /// `start` has one entry for each cell of the mesh. Collective.
  FlowScheme(const SimplexMesh<D>& mesh, NodeExchange& exchange, const FvConfig& config,
             std::vector<BoundaryCondition<D>> conditions, const std::vector<CellStart>& start);

  /// Tries a step from the accepted state; returns what went wrong in words, alike on all ranks. Collective.
  std::string advance(double t, double dt);
  /// Makes the tried step the accepted state. Collective.
  void accept(double dt);
  /// The accepted state and what is kept to save work. Collective.
  void walk(StateWalk& walk, const StateRows& cells, const StateRows& nodes);
  double largest_dt() const { return largest_dt_; }  ///< longest step from the accepted state [s]

  const FlowState<D>& state() const { return now_; }
  const SimplexMesh<D>& mesh() const { return mesh_; }
  const Boundary<D>& boundary() const { return boundary_; }
  const std::vector<Vector<D>>& middle() const { return half_x_; }  ///< nodes in the middle of the last step
  const Closure& closure(int cell) const { return *closure_[cell]; }
  double mass(int cell) const { return mass_[cell]; }
  CellOrder order(int cell) const { return mood_.order(cell); }
  Mat3 deformation(int cell, const FlowState<D>& state) const;
  /// By how much averaged pressures change the mean stress [Pa] and the stored energy [J/kg] of the accepted state.
  double stress_shift(int cell) const { return patches_ ? patches_->stress(cell) : 0; }
  double stored_shift(int cell) const;
  /// Calls work(cells, closure) for runs of at most cells_per_block of these cells that share a closure.
  template <class Work>
  void for_blocks(std::span<const int> cells, Work work) const;
  std::span<const int> all_cells() const { return all_; }
  /// What a step moves at the least when no array stays in a cache from one loop over it to the next; this rank's.
  double bytes_per_step() const;

 private:
  struct Source {  // where fields, slopes and impedances come from, and the geometry of the forces
    const FlowState<D>* state;
    const std::vector<Vector<D>>* x;
    double predicted;  // time from the state to the forces, doubled [s]; 0: none
  };
  CellOrder first_order() const;
  bool has_cascade() const { return config_.order == 2 && config_.limiter == Limiter::mood; }
  void solve_all(double dt, CellOrder order);
  void find_corners(std::span<const int> cells, double t);
  void load(int b, int cell, PredictedBlock<D>& block) const;
  void write_corners(int cell, const Slopes<D>& g, const PackedFields<D>& q);
  void move(std::span<const int> nodes, double dt);
  void update(std::span<const int> cells, double t, double dt);
  void take_forces(int cell, double dt);
  std::string judge(double t, double dt);
  std::string failure(bool judged) const;
  double next_dt(double dt) const;
  void take_rest(double dt);
  double filling_time() const;
  void half_step(double t, double dt);

  const SimplexMesh<D>& mesh_;
  NodeExchange& exchange_;
  FvConfig config_;
  std::vector<const Closure*> closure_;
  std::vector<double> mass_;
  std::vector<Matrix<D>> inverse_edges_;  // D_m^-1
  std::vector<int> all_, all_nodes_, troubled_;
  mutable std::vector<WaveMemory> waves_;
  std::vector<double> stiffening_;  // by which shocks are faster than sound [m/s]
  std::vector<double> rest_;        // crossings of a wave for which a cell stays constant
  Boundary<D> boundary_;
  Reconstruction<D> reconstruction_;
  NodalSolver<D> nodes_;
  Mood<D> mood_;
  FlowState<D> now_, next_;
  Judgement<D> judgement_;
  std::unique_ptr<FlowState<D>> half_;         // of rk2 alone
  std::unique_ptr<PatchPressure<D>> patches_;  // of fv.patch_pressure alone
  std::vector<Vector<D>> half_x_;
  Source source_{};
  double largest_dt_ = 0;
  bool nodes_have_moved_ = false;  // is there a velocity of nodes to compare cells with?
};

/// Each loop reads or writes an array once, a write also reads (fetch of the line): node arrays that cells gather from
/// are still in the cache, since neighbours are near. In the order of the loops; the rare repair of cells is left out.
template <int D>
double FlowScheme<D>::bytes_per_step() const {
  constexpr double index = sizeof(int), number = sizeof(double), record = sizeof(CellRecord<D>);
  constexpr double corners = (D + 1) * sizeof(CornerForce<D>), place = sizeof(Vector<D>), write = 2;
  constexpr double cell_nodes = (D + 1) * index, judged = 2 * Reconstruction<D>::judged_count * number;
  const double gather_cell = record + cell_nodes,
               gather_node = place + write * (Reconstruction<D>::moment_bytes + judged);
  const double corners_cell = record + number + cell_nodes + sizeof(Matrix<D>) + sizeof(void*) + 2 * number +
                              write * corners,  // energy; closure; speed and stiffening
      corners_node = 3 * place + Reconstruction<D>::moment_bytes;
  const double solve_cell = corners + cell_nodes, solve_node = write * (sizeof(Symmetric<D>) + 2 * place);
  const double move_node = 2 * place + write * place;
  const double update_cell = corners + cell_nodes + (1 + write) * record + sizeof(Matrix<D>) + sizeof(void*) +
                             sizeof(WaveMemory) + (3 + 4 * write) * number,  // mass, energies, volume, speed, crossing
      update_node = 2 * place;
  const double judge_cell = 2 * record + cell_nodes + 6 * number + sizeof(void*), judge_node = judged + place;
  const double accept_cell = 3 * number;
  return mesh_.cells() * (gather_cell + corners_cell + solve_cell + update_cell + judge_cell + accept_cell) +
         mesh_.nodes() * (gather_node + corners_node + solve_node + move_node + update_node + judge_node);
}

template <int D>
template <class Work>
void FlowScheme<D>::for_blocks(std::span<const int> cells, Work work) const {
  for (std::size_t first = 0; first < cells.size();) {
    const Closure* closure = closure_[cells[first]];
    std::size_t end = first + 1;
    while (end < cells.size() && end - first < cells_per_block && closure_[cells[end]] == closure) ++end;
    work(cells.subspan(first, end - first), *closure);
    first = end;
  }
}

extern template class FlowScheme<2>;
extern template class FlowScheme<3>;

}  // namespace titin
