#include "solve/block_cells.hpp"

#include <algorithm>
#include <cmath>

#include "solve/block_small.hpp"

namespace titin {

namespace {

/// The augmentation takes at most this part of the volumetric stiffness: what is left must be invertible.
constexpr double largest_part = 0.5;

}  // namespace

CellBlocks::CellBlocks(CellLayout layout, double gamma) : layout_(std::move(layout)), gamma_(gamma) {
  A_.resize(batches() * packed_size(layout_.size()));
  B_.resize(std::size_t(layout_.cells) * layout_.modes * layout_.size());
  small_.resize(std::size_t(layout_.cells) * 4 * square());
  scale_.resize(std::size_t(layout_.cells) * layout_.modes);
  inertia_.resize(std::size_t(layout_.cells) * layout_.nodes, 0.0);
}

void CellBlocks::set(int cell, const CellTangent& tangent) {
  const int m = layout_.modes, n = layout_.size();
  const bool condensed = std::isinf(gamma_);
  if (tangent.inertia) std::copy_n(tangent.inertia, layout_.nodes, &inertia_[std::size_t(cell) * layout_.nodes]);
  const double augmentation = condensed ? 0 : std::min(gamma_ * tangent.shear, largest_part * tangent.bulk);
  if (!condensed) set_small(cell, tangent, augmentation);
  double* B = &B_[std::size_t(cell) * m * n];
  for (int c = 0; c < n; ++c)
    for (int l = 0; l < m; ++l) B[l * n + c] = layout_.dofs[std::size_t(cell) * n + c] < 0 ? 0 : tangent.B[l * n + c];
  // A_g = K + B^T (G - S) B
  std::vector<double> change(m * n, 0.0);
  for (int l = 0; l < m && !condensed; ++l)
    for (int k = 0; k < m; ++k)
      for (int c = 0; c < n; ++c) change[l * n + c] -= stiffness(cell)[l * m + k] * B[k * n + c];
  set_matrix(cell, tangent, change);
}

void CellBlocks::set_small(int cell, const CellTangent& tangent, double augmentation) {
  const int m = layout_.modes;
  const std::size_t entries = square();
  double* S = &small_[4 * cell * entries];
  double *compliance = S + entries, *mass_inverse = compliance + entries, *schur = mass_inverse + entries;
  for (std::size_t e = 0; e < entries; ++e) {
    mass_inverse[e] = tangent.mass_inverse[e];
    S[e] = tangent.stiffness[e] - augmentation * tangent.mass_inverse[e];
  }
  // all modulo the symmetry that round-off takes
  for (int l = 0; l < m; ++l)
    for (int k = 0; k < l; ++k) S[l * m + k] = S[k * m + l] = 0.5 * (S[l * m + k] + S[k * m + l]);
  invert_small(m, S, compliance);
  invert_small(m, mass_inverse, schur);  // M
  const double shear = tangent.shear + augmentation;
  std::vector<double> sum(entries);
  for (std::size_t e = 0; e < entries; ++e) sum[e] = schur[e] / shear + compliance[e];
  invert_small(m, sum.data(), schur);
  for (int l = 0; l < m; ++l)
    scale_[std::size_t(cell) * m + l] = tangent.shear / (tangent.size * layout_.mode_size[std::size_t(cell) * m + l]);
}

void CellBlocks::set_matrix(int cell, const CellTangent& tangent, const std::vector<double>& change) {
  const int m = layout_.modes, n = layout_.size(), lane = cell % float_lanes;
  const double* B = this->B(cell);
  const PetscInt* dofs = &layout_.dofs[std::size_t(cell) * n];
  FloatLanes* A = &A_[(cell / float_lanes) * packed_size(n)];
  std::vector<double> row(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) row[j] = 0.5 * (tangent.K[i * n + j] + tangent.K[j * n + i]);
    for (int l = 0; l < m; ++l)
      for (int j = 0; j <= i; ++j) row[j] += B[l * n + i] * change[l * n + j];
    for (int j = 0; j <= i; ++j)
      A[packed_index(i, j)][lane] = dofs[i] < 0 || dofs[j] < 0 ? 0.0f : static_cast<float>(row[j]);
  }
}

std::size_t CellBlocks::bytes() const {
  const auto size = [](const auto&... list) { return ((list.capacity() * sizeof(list[0])) + ...); };
  return size(A_, B_, small_, scale_, inertia_, layout_.dofs, layout_.corner, layout_.mode_size);
}

}  // namespace titin
