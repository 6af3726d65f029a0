#include "fv/lagrange_fields.hpp"

#include "base/parallel.hpp"

namespace titin {

template <int D>
LagrangeFields<D>::LagrangeFields(mfem::ParMesh& mesh, const FlowScheme<D>& scheme)
    : mesh_(mesh),
      scheme_(scheme),
      constant_(0, D),
      scalars_(&mesh, &constant_),
      vectors_(&mesh, &constant_, D, mfem::Ordering::byVDIM),
      tensors_(&mesh, &constant_, 6, mfem::Ordering::byVDIM) {
  density_ = fields_.add("density", "kg/m^3", scalars_);
  pressure_ = fields_.add("pressure", "Pa", scalars_);
  energy_ = fields_.add("internal_energy", "J/kg", scalars_);
  ratio_ = fields_.add("volume_ratio", "", scalars_);
  order_ = fields_.add("order", "", scalars_);
  velocity_ = fields_.add("velocity", "m/s", vectors_);
  stress_ = fields_.add("cauchy_stress", "Pa", tensors_);
  bool has_fibres = false;
  for (int c = 0; c < scheme.mesh().cells(); ++c) has_fibres = has_fibres || scheme.closure(c).has_fibres();
  if (any_of(has_fibres)) fibre_stretch_ = fields_.add("fibre_stretch", "", scalars_);
}

template <int D>
void LagrangeFields<D>::update(double time) {
  const SimplexMesh<D>& cells = scheme_.mesh();
  for (int p = 0; p < cells.nodes(); ++p)
    for (int i = 0; i < D; ++i) mesh_.GetVertex(cells.vertex_of[p])[i] = scheme_.state().x[p][i];
  scheme_.for_blocks(scheme_.all_cells(),
                     [&](std::span<const int> run, const Closure& closure) { write(run, closure, time); });
}

/// Stress in VTK's order xx, yy, zz, xy, yz, xz, which is ours.
template <int D>
void LagrangeFields<D>::write(std::span<const int> cells, const Closure& closure, double time) {
  std::array<Mat3, cells_per_block> F;
  std::array<double, cells_per_block> density, energy;
  std::array<Sym3, cells_per_block> T;
  const FlowState<D>& state = scheme_.state();
  for (std::size_t b = 0; b < cells.size(); ++b) {
    F[b] = scheme_.deformation(cells[b], state);
    density[b] = state.cell[cells[b]].density;
    energy[b] = state.internal_energy(cells[b]);
  }
  const CellBatch batch{static_cast<int>(cells.size()), F.data(), density.data(), energy.data(), nullptr, time};
  closure.stress(batch, T.data());
  std::array<double, cells_per_block> stretch{};
  if (fibre_stretch_) closure.fibre_stretch(batch, stretch.data());
  for (std::size_t b = 0; b < cells.size(); ++b) {
    const int e = scheme_.mesh().element_of[cells[b]];
    for (int i = 0; i < 3; ++i) T[b][i] += scheme_.stress_shift(cells[b]);
    if (fibre_stretch_) (*fibre_stretch_)(e) = stretch[b];
    (*density_)(e) = density[b];
    (*energy_)(e) = energy[b];
    (*pressure_)(e) = -(T[b][0] + T[b][1] + T[b][2]) / 3;
    (*ratio_)(e) = determinant(F[b]);
    (*order_)(e) = static_cast<int>(scheme_.order(cells[b]));
    for (int i = 0; i < D; ++i) (*velocity_)(D * e + i) = state.cell[cells[b]].q[i];
    for (int k = 0; k < 6; ++k) (*stress_)(6 * e + k) = T[b][k];
  }
}

template class LagrangeFields<2>;
template class LagrangeFields<3>;

}  // namespace titin
