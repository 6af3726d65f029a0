/// Values given at scattered places of the undeformed body, in a file of columns x, y, z and values, and what lies
/// between the places.
///
/// linear: the weighted least-squares plane through the values of the nearest places (moving least squares; Lancaster
/// and Salkauskas 1981, Math. Comput. 37, 141) with the weights ((R - d) / (R d))^2 of Franke and Nielson (1980), Int.
/// J. Numer. Meth. Eng. 15, 1691, d being a place's distance and R that of the first one left out: it goes through the
/// values, is continuous, and exact where the values are linear in space. Where all places lie in a plane or on a line,
/// values do not change across it. nearest: the value of the nearest place.
///
/// Directions have no sense: those of places around are turned to that of the nearest before they are averaged, and
/// what comes out has length 1.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "math/nearest_points.hpp"
#include "math/tensor.hpp"

namespace titin {

class SpatialField {
 public:
  enum class Between { linear, nearest };
  enum class At { points, cells };  ///< evaluated at each quadrature point, or once for a cell at its centre

  struct Data {
    std::vector<Vec3> places;  ///< [m]
    std::vector<Vec3> values;  ///< numbers in SI as the first component; directions of any length but zero
    bool directions = false;
    Between between = Between::linear;
    At at = At::points;
    double reach = 0;  ///< farther from all places nothing is known [m]; 0: three times the places' spacing
    Range range = any;
  };
  explicit SpatialField(Data data);

  /// The number or the directions that the table {field, column(s), between, at, reach} describes; null after an error.
  static std::shared_ptr<const SpatialField> read_number(Section table, const Key& key);
  static std::shared_ptr<const SpatialField> read_directions(Section table);

  At at() const { return data_.at; }
  bool has_directions() const { return data_.directions; }
  double first() const { return data_.values.front()[0]; }
  Vec3 first_direction() const { return data_.values.front(); }
  double reach() const { return data_.reach; }
  double spacing() const { return spacing_; }  ///< median distance of a place from its nearest other

  /// The value at x; none farther than `reach` from all places. Directions that cancel give none either.
  std::optional<Vec3> value(const Vec3& x) const;
  /// Why there is no value at x or none that the key allows, "" when there is one; `advice` says what to do.
  std::string problem(const Vec3& x, std::string& advice) const;
  bool allows(const Vec3& value) const { return data_.directions || data_.range.contains(value[0]); }
  /// Reports an error where the scene names the field.
  void report(const std::string& problem, const std::string& advice) const;
  void stands_in(Section section, std::string unit) { section_ = std::move(section), unit_ = std::move(unit); }

 private:
  Vec3 linear(const Vec3& x) const;
  std::optional<Vec3> fit(const Vec3& x, const std::vector<NearestPoints::Neighbour>& around) const;

  std::optional<Section> section_;
  std::string unit_;  // SI
  Data data_;
  NearestPoints nearest_;
  double spacing_ = 0;
  int rank_ = 0;  // dimensions that the places extend in
};

}  // namespace titin
