#include "solve/block_patches.hpp"

#include <algorithm>

namespace titin {

/// One vertex: its dofs (local numbers, increasing) and what lies in the star of each of its cells.
struct VertexPatches::Star {
  struct CellPart {
    int cell;
    std::vector<std::uint16_t> cell_dofs;
    std::vector<int> dofs;
  };
  std::vector<int> dofs;
  std::vector<CellPart> parts;
};

VertexPatches::VertexPatches(const CellHalo& halo, const LocalDofs& dofs, BlockMatrices::Entries entries)
    : halo_(halo), inverses_(entries) {
  std::vector<Star> all = stars(dofs);
  std::stable_sort(all.begin(), all.end(), [](const Star& a, const Star& b) { return a.dofs.size() > b.dofs.size(); });
  while (!all.empty() && all.back().dofs.empty()) all.pop_back();  // all constrained
  patches_ = all.size();
  for (std::size_t first = 0; first < all.size(); first += float_lanes) add_batch(all, first, dofs.zero());
  for (const Batch& batch : batches_) inverses_.add(batch.size);
}

std::vector<VertexPatches::Star> VertexPatches::stars(const LocalDofs& dofs) const {
  const CellLayout& layout = halo_.layout();
  std::vector<Star> all(layout.owned_corners);
  for (int cell = 0; cell < halo_.cells(); ++cell)
    for (int v = 0; v < layout.corners; ++v) {
      const PetscInt corner = halo_.corner(cell)[v] - halo_.first_corner();
      if (corner < 0 || corner >= layout.owned_corners) continue;
      Star& star = all[corner];
      Star::CellPart part{cell, {}, {}};
      for (int c = 0; c < layout.size(); ++c) {
        const PetscInt dof = halo_.dofs(cell)[c];
        if (dof < 0 || layout.hat[(c % layout.nodes) * layout.corners + v] == 0) continue;
        part.cell_dofs.push_back(static_cast<std::uint16_t>(c));
        part.dofs.push_back(dofs.local(dof));
      }
      star.dofs.insert(star.dofs.end(), part.dofs.begin(), part.dofs.end());
      star.parts.push_back(std::move(part));
    }
  for (Star& star : all) {
    std::sort(star.dofs.begin(), star.dofs.end());
    star.dofs.erase(std::unique(star.dofs.begin(), star.dofs.end()), star.dofs.end());
  }
  return all;
}

void VertexPatches::add_batch(const std::vector<Star>& all, std::size_t first, int zero) {
  Batch batch;
  batch.size = static_cast<int>(all[first].dofs.size());
  largest_ = std::max(largest_, batch.size);
  batch.dofs = dofs_.size();
  batch.first_part = parts_.size();
  dofs_.resize(dofs_.size() + std::size_t(batch.size) * float_lanes, zero);
  for (int lane = 0; lane < float_lanes && first + lane < all.size(); ++lane) {
    const Star& star = all[first + lane];
    batch.sizes.push_back(static_cast<int>(star.dofs.size()));
    for (std::size_t i = 0; i < star.dofs.size(); ++i) dofs_[batch.dofs + i * float_lanes + lane] = star.dofs[i];
    for (const Star::CellPart& part : star.parts) {
      const std::size_t begin = pairs_.size();
      for (std::size_t i = 0; i < part.dofs.size(); ++i) {
        const auto place = std::lower_bound(star.dofs.begin(), star.dofs.end(), part.dofs[i]) - star.dofs.begin();
        pairs_.push_back({part.cell_dofs[i], static_cast<std::uint16_t>(place)});
      }
      parts_.push_back({part.cell, lane, begin, pairs_.size()});
    }
  }
  batch.end_part = parts_.size();
  batch.sizes.resize(float_lanes, 0);
  batches_.push_back(std::move(batch));
}

void VertexPatches::update() {
  std::vector<FloatLanes> A(packed_size(largest_));
  for (std::size_t number = 0; number < batches_.size(); ++number) {
    assemble(batches_[number], A.data());
    invert_packed(batches_[number].size, A.data());
    inverses_.set(number, A.data());
  }
}

void VertexPatches::assemble(const Batch& batch, FloatLanes* A) const {
  std::fill_n(A, packed_size(batch.size), FloatLanes{});
  for (int lane = 0; lane < float_lanes; ++lane)  // unit rows fill up smaller patches
    for (int i = batch.sizes[lane]; i < batch.size; ++i) A[packed_index(i, i)][lane] = 1;
  for (std::size_t p = batch.first_part; p < batch.end_part; ++p) {
    const Part& part = parts_[p];
    const float* cell = halo_.matrix(part.cell);
    float* to = reinterpret_cast<float*>(A) + part.lane;
    for (std::size_t i = part.first; i < part.end; ++i)
      for (std::size_t j = part.first; j <= i; ++j)
        to[packed_index(pairs_[i].to, pairs_[j].to) * float_lanes] +=
            cell[packed_index(pairs_[i].from, pairs_[j].from) * float_lanes];
  }
}

void VertexPatches::apply(const float* r, float* z) const {
  std::vector<FloatLanes> in(largest_), out(largest_);
  for (std::size_t number = 0; number < batches_.size(); ++number) {
    const Batch& batch = batches_[number];
    const int* dofs = &dofs_[batch.dofs];
    float* values = reinterpret_cast<float*>(in.data());
    for (int c = 0; c < batch.size * float_lanes; ++c) values[c] = r[dofs[c]];
    inverses_.multiply(number, in.data(), out.data());
    values = reinterpret_cast<float*>(out.data());
    for (int c = 0; c < batch.size * float_lanes; ++c) z[dofs[c]] += values[c];
  }
}

std::size_t VertexPatches::bytes() const {
  const auto size = [](const auto&... list) { return ((list.capacity() * sizeof(list[0])) + ...); };
  return size(batches_, parts_, pairs_, dofs_) + inverses_.bytes();
}

}  // namespace titin
