/// The nearest of many points: a k-d tree. Bentley (1975), Commun. ACM 18, 509.
#pragma once

#include <vector>

#include "math/tensor.hpp"

namespace titin {

class NearestPoints {
 public:
  explicit NearestPoints(std::vector<Vec3> points);
  const std::vector<Vec3>& points() const { return points_; }

  struct Neighbour {
    double square = 0;  ///< of the distance
    int point = -1;
  };
  /// The `count` nearest points, or all if there are fewer; the nearest first, of equally near ones the lowest number.
  std::vector<Neighbour> find(const Vec3& x, int count) const;

 private:
  void build(int begin, int end);
  void search(int begin, int end, const Vec3& x, std::size_t count, std::vector<Neighbour>& heap) const;

  std::vector<Vec3> points_;
  std::vector<int> order_;  // of a range the middle parts those below from those above along axis_[middle]
  std::vector<char> axis_;
};

}  // namespace titin
