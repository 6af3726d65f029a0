/// The state of all cells and nodes of a rank, laid out for gathers: what a neighbour reads of a cell is one record.
#pragma once

#include <array>
#include <vector>

#include "math/lanes.hpp"
#include "math/vector.hpp"

namespace titin {

/// Fields that are reconstructed: velocity [m/s], then the Cauchy stress [Pa] in the plane or in space.
template <int D>
inline constexpr int field_count = D + symmetric_size<D>;
template <int D>
using CellFields = std::array<double, field_count<D>>;

/// Fields and a vector after them, filled up to whole registers: gathers and slopes work on it at once.
template <int D>
inline constexpr int packed_registers = (field_count<D> + D + lane_count - 1) / lane_count;
template <int D>
using PackedFields = std::array<double, packed_registers<D> * lane_count>;
template <int D>
using Registers = std::array<Lanes, packed_registers<D>>;

template <int D>
Registers<D> load_registers(const double* x) {
  Registers<D> r;
  for (int k = 0; k < packed_registers<D>; ++k) r[k].copy_from(x + k * lane_count, std::experimental::element_aligned);
  return r;
}
template <int D>
void store_registers(const Registers<D>& r, PackedFields<D>& x) {
  for (int k = 0; k < packed_registers<D>; ++k)
    r[k].copy_to(x.data() + k * lane_count, std::experimental::element_aligned);
}
/// y += s x
template <int D>
void accumulate(Registers<D>& y, double s, const Registers<D>& x) {
  for (int k = 0; k < packed_registers<D>; ++k) y[k] += s * x[k];
}

template <int D, std::size_t n>
Vector<D> velocity_of(const std::array<double, n>& q) {
  Vector<D> v;
  for (int i = 0; i < D; ++i) v[i] = q[i];
  return v;
}
template <int D, std::size_t n>
Symmetric<D> stress_of(const std::array<double, n>& q) {
  Symmetric<D> T;
  for (int k = 0; k < symmetric_size<D>; ++k) T[k] = q[D + k];
  return T;
}

/// In the plane of the components there.
template <int D>
double mean_stress(const CellFields<D>& q) {
  double trace = q[D] + q[D + 1];
  if constexpr (D == 3) trace += q[D + 2];
  return trace / D;
}

/// One cache line in two dimensions, two in three; begins with what PackedFields hold.
template <int D>
struct alignas(64) CellRecord {
  CellFields<D> q{};
  Vector<D> centre{};  // [m]
  double density = 0;  // [kg/m^3]
  Registers<D> packed() const { return load_registers<D>(q.data()); }
};
static_assert(sizeof(CellRecord<2>) == 64 && sizeof(CellRecord<3>) == 128);
static_assert(sizeof(PackedFields<2>) <= sizeof(CellRecord<2>) && sizeof(PackedFields<3>) <= sizeof(CellRecord<3>));

template <int D>
struct FlowState {
  FlowState(int cells, int nodes)
      : cell(cells),
        energy(cells),
        stored(cells),
        most_heat(cells),
        volume(cells),
        speed(cells),
        crossing(cells),
        x(nodes),
        v(nodes) {}

  /// Specific [J/kg].
  double internal_energy(int c) const {
    const Vector<D> v = velocity_of<D>(cell[c].q);
    return energy[c] - 0.5 * dot(v, v);
  }

  std::vector<CellRecord<D>> cell;
  std::vector<double> energy;     // total specific [J/kg]
  std::vector<double> stored;     // of it, by a solid without heat [J/kg]; 0 where nobody asks
  std::vector<double> most_heat;  // the most that the rest has been, since a start without any [J/kg]
  std::vector<double> volume;     // [m^3], or [m^2] per unit thickness
  std::vector<double> speed;      // of the fastest wave [m/s]
  std::vector<double> crossing;   // time that it takes through the cell's inner ball [s]
  std::vector<Vector<D>> x, v;    // nodes: position [m]; velocity of the step that led here [m/s]
};

}  // namespace titin
