/// Means over the cells whose centre lay in a box at the start, wherever they have moved.
///
/// Density is mass over volume and velocity momentum over mass, so that they are those of the cells as one body;
/// pressure, minus a third of the stress's trace as among the fields, is weighted with present volume.
#pragma once

#include "fv/scheme.hpp"
#include "mesh/averages.hpp"
#include "solve/model.hpp"

namespace titin {

template <int D>
class LagrangeMeans {
 public:
  LagrangeMeans(const FlowScheme<D>& scheme, const std::vector<AverageConfig>& averages);
  /// Adds the columns of the accepted state. Collective.
  void list(double time, std::vector<Quantity>& quantities) const;

 private:
  struct Box {
    std::string name;
    std::vector<int> cells;  // of the scheme, this rank's
  };
  double pressure_volume(const Box& box, double time) const;

  const FlowScheme<D>& scheme_;
  std::vector<Box> boxes_;
};

extern template class LagrangeMeans<2>;
extern template class LagrangeMeans<3>;

}  // namespace titin
