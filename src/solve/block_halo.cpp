#include "solve/block_halo.hpp"

#include <map>

#include "base/parallel.hpp"

namespace titin {

CellHalo::CellHalo(const CellBlocks& blocks) : blocks_(blocks) {
  std::vector<Exchange::Part> parts = choose_cells();
  if (ranks() == 1) return;
  exchange_ = std::make_unique<Exchange>(std::move(parts));
  ghosts_ = static_cast<int>(exchange_->received());
  ghost_dofs_ = fetch(layout().dofs, layout().size());
  ghost_corner_ = fetch(layout().corner, layout().corners);
  ghost_matrices_.resize((ghosts_ + float_lanes - 1) / float_lanes * packed_size(layout().size()));
}

/// Which cells go to which rank: those that touch one of its vertices.
std::vector<Exchange::Part> CellHalo::choose_cells() {
  PetscLayout owners;
  check(PetscLayoutCreate(PETSC_COMM_WORLD, &owners));
  check(PetscLayoutSetLocalSize(owners, layout().owned_corners));
  check(PetscLayoutSetUp(owners));
  check(PetscLayoutGetRange(owners, &first_corner_, nullptr));
  std::map<int, std::vector<int>> cells_for;
  for (int cell = 0; cell < layout().cells; ++cell)
    for (int v = 0; v < layout().corners; ++v) {
      PetscMPIInt owner;
      check(PetscLayoutFindOwner(owners, corner(cell)[v], &owner));
      if (owner == rank()) continue;
      auto& cells = cells_for[owner];
      if (cells.empty() || cells.back() != cell) cells.push_back(cell);
    }
  check(PetscLayoutDestroy(&owners));
  std::vector<Exchange::Part> parts;
  for (const auto& [owner, cells] : cells_for) {
    parts.push_back({owner, cells.size()});
    sent_.insert(sent_.end(), cells.begin(), cells.end());
  }
  return parts;
}

/// The ghosts' share of something that each cell has `size` of.
std::vector<PetscInt> CellHalo::fetch(const std::vector<PetscInt>& own, int size) {
  std::vector<PetscInt> send, received(std::size_t(ghosts_) * size);
  for (int cell : sent_) send.insert(send.end(), &own[std::size_t(cell) * size], &own[std::size_t(cell) * size] + size);
  exchange_->begin(send.data(), received.data(), size);
  exchange_->end();
  return received;
}

const PetscInt* CellHalo::dofs(int cell) const {
  const int n = layout().size();
  if (cell < layout().cells) return &layout().dofs[std::size_t(cell) * n];
  return &ghost_dofs_[std::size_t(cell - layout().cells) * n];
}

const PetscInt* CellHalo::corner(int cell) const {
  const int n = layout().corners;
  if (cell < layout().cells) return &layout().corner[std::size_t(cell) * n];
  return &ghost_corner_[std::size_t(cell - layout().cells) * n];
}

const float* CellHalo::matrix(int cell) const {
  const int own = layout().cells, local = cell < own ? cell : cell - own;
  const std::size_t first = (local / float_lanes) * packed_size(layout().size());
  const FloatLanes* batch = cell < own ? blocks_.matrices(local / float_lanes) : &ghost_matrices_[first];
  return reinterpret_cast<const float*>(batch) + local % float_lanes;
}

void CellHalo::update() {
  if (!exchange_) return;
  const auto entries = static_cast<int>(packed_size(layout().size()));
  std::vector<float> send, received(std::size_t(ghosts_) * entries);
  send.reserve(sent_.size() * entries);
  for (int cell : sent_)
    for (int e = 0; e < entries; ++e) send.push_back(matrix(cell)[e * float_lanes]);
  exchange_->begin(send.data(), received.data(), entries);
  exchange_->end();
  for (int ghost = 0; ghost < ghosts_; ++ghost)
    for (int e = 0; e < entries; ++e)
      ghost_matrices_[std::size_t(ghost / float_lanes) * entries + e][ghost % float_lanes] =
          received[std::size_t(ghost) * entries + e];
}

std::size_t CellHalo::bytes() const {
  return ghost_matrices_.capacity() * sizeof(FloatLanes) + sent_.capacity() * sizeof(int) +
         (ghost_dofs_.capacity() + ghost_corner_.capacity()) * sizeof(PetscInt);
}

}  // namespace titin
