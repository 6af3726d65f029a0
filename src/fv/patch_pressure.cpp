#include "fv/patch_pressure.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/parallel.hpp"

namespace titin {
namespace {

/// Regions of all ranks, numbered from 0 in the order of their attributes.
std::map<int, int> number_regions(const std::vector<int>& attributes) {
  const double most = attributes.empty() ? 0 : *std::max_element(attributes.begin(), attributes.end());
  std::vector<double> used(static_cast<std::size_t>(max(most)) + 1);
  for (int a : attributes) used[a] = 1;
  sum(used);
  std::map<int, int> number;
  for (std::size_t a = 0; a < used.size(); ++a)
    if (used[a] > 0) number.emplace(static_cast<int>(a), static_cast<int>(number.size()));
  return number;
}

}  // namespace

template <int D>
PatchPressure<D>::PatchPressure(const SimplexMesh<D>& mesh, NodeExchange& exchange,
                                const std::vector<const Closure*>& closure)
    : mesh_(mesh),
      exchange_(exchange),
      closure_(closure),
      patch_of_(mesh.cells()),
      volume_at_rest_(mesh.cells()),
      shift_(mesh.cells()) {
  const std::map<int, int> number = number_regions(mesh.region);
  regions_ = static_cast<int>(number.size());
  for (int attribute : mesh.region) region_.push_back(number.at(attribute));
  for (int c = 0; c < mesh.cells(); ++c) volume_at_rest_[c] = simplex_volume<D>(mesh.corners_of(c, mesh.x));
  at_nodes_.resize(static_cast<std::size_t>(mesh.nodes()) * regions_);
  find_patches();
}

template <int D>
void PatchPressure<D>::find_patches() {
  std::map<std::pair<int, int>, int> place;  // of (node, region)
  for (int c = 0; c < mesh_.cells(); ++c)
    for (int p = 0; p <= D; ++p) {
      const int node = mesh_.nodes_of[c][p];
      const auto [found, is_new] = place.try_emplace({node, region_[c]}, static_cast<int>(patches_.size()));
      if (is_new) patches_.push_back({node, region_[c]});
      patch_of_[c][p] = found->second;
      patches_[found->second].now += volume_at_rest_[c];
    }
  sum_over_ranks();
  for (Patch& patch : patches_) patch.at_rest = patch.now;
}

template <int D>
void PatchPressure<D>::sum_over_ranks() {
  std::fill(at_nodes_.begin(), at_nodes_.end(), 0.0);
  for (const Patch& patch : patches_) at_nodes_[patch.node * regions_ + patch.region] = patch.now;
  exchange_.sum(at_nodes_.data(), regions_);
  for (Patch& patch : patches_) patch.now = at_nodes_[patch.node * regions_ + patch.region];
}

template <int D>
void PatchPressure<D>::apply(FlowState<D>& state) {
  for (Patch& patch : patches_) patch.now = 0, patch.is_known = false;
  for (int c = 0; c < mesh_.cells(); ++c)
    for (int patch : patch_of_[c]) patches_[patch].now += state.volume[c];
  sum_over_ranks();
  for (int c = 0; c < mesh_.cells(); ++c) {
    if (!closure_[c]->is_solid()) continue;
    Closure::Volumetric mean{};
    for (int p : patch_of_[c]) {
      Patch& patch = patches_[p];
      if (!patch.is_known) patch.law = closure_[c]->volumetric(patch.now / patch.at_rest);
      patch.is_known = true;
      mean.U += patch.law.U / (D + 1);
      mean.dU += patch.law.dU / (D + 1);
    }
    const Closure::Volumetric own = closure_[c]->volumetric(state.volume[c] / volume_at_rest_[c]);
    shift_[c] = {mean.dU - own.dU, mean.U - own.U};
    for (int i = 0; i < D; ++i) state.cell[c].q[D + i] += shift_[c].first;
  }
}

template class PatchPressure<2>;
template class PatchPressure<3>;

}  // namespace titin
