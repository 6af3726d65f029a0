#include "math/nearest_points.hpp"

#include <algorithm>
#include <numeric>

namespace titin {
namespace {

bool nearer(const NearestPoints::Neighbour& a, const NearestPoints::Neighbour& b) {
  return a.square != b.square ? a.square < b.square : a.point < b.point;
}

}  // namespace

NearestPoints::NearestPoints(std::vector<Vec3> points)
    : points_(std::move(points)), order_(points_.size()), axis_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, static_cast<int>(order_.size()));
}

/// Parts the range where it is longest.
void NearestPoints::build(int begin, int end) {
  if (end - begin < 2) return;
  Vec3 lower = points_[order_[begin]], upper = lower;
  for (int i = begin; i < end; ++i)
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], points_[order_[i]][d]);
      upper[d] = std::max(upper[d], points_[order_[i]][d]);
    }
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (upper[d] - lower[d] > upper[axis] - lower[axis]) axis = d;
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return points_[a][axis] < points_[b][axis]; });
  axis_[middle] = static_cast<char>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

std::vector<NearestPoints::Neighbour> NearestPoints::find(const Vec3& x, int count) const {
  std::vector<Neighbour> heap;  // the farthest on top
  search(0, static_cast<int>(order_.size()), x, static_cast<std::size_t>(count), heap);
  std::sort_heap(heap.begin(), heap.end(), nearer);
  return heap;
}

void NearestPoints::search(int begin, int end, const Vec3& x, std::size_t count, std::vector<Neighbour>& heap) const {
  if (begin >= end) return;
  const int middle = (begin + end) / 2, point = order_[middle];
  const Vec3 off{x[0] - points_[point][0], x[1] - points_[point][1], x[2] - points_[point][2]};
  const Neighbour here{dot(off, off), point};
  if (heap.size() < count || nearer(here, heap.front())) {
    if (heap.size() == count) {
      std::pop_heap(heap.begin(), heap.end(), nearer);
      heap.pop_back();
    }
    heap.push_back(here);
    std::push_heap(heap.begin(), heap.end(), nearer);
  }
  const double across = off[axis_[middle]];
  const auto below = [&] { search(begin, middle, x, count, heap); };
  const auto above = [&] { search(middle + 1, end, x, count, heap); };
  across < 0 ? below() : above();
  if (heap.size() < count || across * across <= heap.front().square) across < 0 ? above() : below();
}

}  // namespace titin
