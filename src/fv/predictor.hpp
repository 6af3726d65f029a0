/// Fields of a cell at the middle of a step, from those at its start and their slopes: what its corners see.
///
/// Hancock: one Taylor step in the moving frame, v = v_c + dt/2 div T / rho, T from the law at
/// F = (I - dt/4 G)^-1 (I + dt/4 G) F_c (solids, G = grad v) or at rho / (1 + dt/2 tr G), e + dt/2 T : G / rho
/// (fluids). ADER: the linear space-time solution of the same equations in the moving cell alone, by Picard iteration:
/// the velocity gradient itself is that of the middle of the step, and densities, distances and stresses follow it.
/// Corners then see q(x_p) = q_half + g . (x_p - x_c): the frame moves with the material.
/// van Leer (1984), SIAM J. Sci. Stat. Comput. 5:1; Boscheri, Loubere, Maire (2022), J. Comput. Phys. 449:110779.
#pragma once

#include "fv/closure.hpp"
#include "fv/fv_config.hpp"
#include "fv/reconstruct.hpp"

namespace titin {

/// Cells of one closure that are predicted at a time: what they need stays in the first cache.
inline constexpr int cells_per_block = 64;

template <int D>
struct PredictedBlock {
  int n = 0;
  std::array<Slopes<D>, cells_per_block> g;
  std::array<PackedFields<D>, cells_per_block> q;       // in: at the start of the step; out: at its middle
  std::array<Mat3, cells_per_block> F;                  // solids; in and out alike
  std::array<double, cells_per_block> density, energy;  // specific internal
  std::array<double, cells_per_block> shift;            // of the mean stress (fv/patch_pressure.hpp), held
};

template <int D>
void predict(Predictor predictor, const Closure& closure, double t, double dt, PredictedBlock<D>& block);

extern template void predict<2>(Predictor, const Closure&, double, double, PredictedBlock<2>&);
extern template void predict<3>(Predictor, const Closure&, double, double, PredictedBlock<3>&);

}  // namespace titin
