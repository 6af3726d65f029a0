#include "materials/spatial_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/units.hpp"
#include "math/spectral.hpp"

namespace titin {
namespace {

constexpr int fewest = 12;         // places of a fit, if there are as many: four numbers are looked for
constexpr double flat = 1e-6;      // of the largest moment: places that extend less than 1e-3 of their width are flat
constexpr double same = 1e-9;      // of the distance of the farthest place: x is a place
constexpr double rounded = 1e-20;  // of weight x radius^2: a moment that is nothing but the rounding of one place
constexpr double wide_reach = 3;   // spacings
constexpr double cancelled = 0.1;  // length of an averaged direction: unit vectors that are up to 84 degrees apart

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

int rank_of(const Eigenpairs& e) {
  const double largest = *std::max_element(e.values.begin(), e.values.end());
  return static_cast<int>(
      std::count_if(e.values.begin(), e.values.end(), [&](double v) { return v > flat * largest; }));
}

int rank_of(const std::vector<Vec3>& points) {
  Vec3 mean{};
  for (const Vec3& x : points)
    for (int d = 0; d < 3; ++d) mean[d] += x[d] / static_cast<double>(points.size());
  Mat3 moment{};
  for (const Vec3& x : points) add(moment, 1.0, dyad(minus(x, mean), minus(x, mean)));
  return points.size() < 2 ? 0 : rank_of(eigenpairs(moment));
}

double median_spacing(const NearestPoints& nearest) {
  std::vector<double> squares;
  for (const Vec3& x : nearest.points())
    if (const auto two = nearest.find(x, 2); two.size() == 2 && two[1].square > 0) squares.push_back(two[1].square);
  if (squares.empty()) return 0;
  std::nth_element(squares.begin(), squares.begin() + squares.size() / 2, squares.end());
  return std::sqrt(squares[squares.size() / 2]);
}

}  // namespace

SpatialField::SpatialField(Data data) : data_(std::move(data)), nearest_(data_.places) {
  spacing_ = median_spacing(nearest_);
  if (data_.reach == 0) data_.reach = wide_reach * spacing_;
  rank_ = rank_of(data_.places);
  if (!data_.directions) return;
  for (Vec3& a : data_.values) {
    const double length = norm(a);
    for (double& component : a) component /= length;
  }
}

std::optional<Vec3> SpatialField::value(const Vec3& x) const {
  const auto next = nearest_.find(x, 1).front();
  if (next.square > data_.reach * data_.reach) return std::nullopt;
  if (data_.between == Between::nearest) return data_.values[next.point];
  Vec3 value = linear(x);
  if (!data_.directions) return value;
  const double length = norm(value);
  if (length < cancelled) return std::nullopt;
  for (double& component : value) component /= length;
  return value;
}

/// Takes more places in until they extend in as many dimensions as all of them do: the nearest of a grid that is much
/// finer along one axis all lie on a line.
Vec3 SpatialField::linear(const Vec3& x) const {
  const int all = static_cast<int>(data_.places.size());
  for (int count = fewest;; count *= 2) {
    const auto around = nearest_.find(x, std::min(count + 1, all));
    if (const auto fitted = fit(x, around)) return *fitted;
    if (count >= all) return data_.values[around.front().point];
  }
}

/// None when the places do not extend far enough, unless they are all there are.
std::optional<Vec3> SpatialField::fit(const Vec3& x, const std::vector<NearestPoints::Neighbour>& around) const {
  const bool all = around.size() == data_.places.size();
  const double farthest = std::sqrt(around.back().square), R = all ? 2 * farthest : farthest;
  const Vec3& lead = data_.values[around.front().point];
  if (around.front().square <= same * same * R * R) return lead;
  double sum = 0;
  Vec3 centre{}, mean{};
  struct Weighted {
    double weight;
    Vec3 place, value;
  };
  std::vector<Weighted> list;
  for (const auto& [square, point] : around) {
    const double d = std::sqrt(square), w = d < R ? (R - d) / (R * d) * ((R - d) / (R * d)) : 0.0;
    Vec3 value = data_.values[point];
    if (data_.directions && dot(value, lead) < 0)
      for (double& component : value) component = -component;
    list.push_back({w, data_.places[point], value});
    sum += w;
    for (int d3 = 0; d3 < 3; ++d3) centre[d3] += w * data_.places[point][d3], mean[d3] += w * value[d3];
  }
  for (int d = 0; d < 3; ++d) centre[d] /= sum, mean[d] /= sum;
  Mat3 moment{}, slope{};  // sum w r r, sum w (value - mean) r
  for (const auto& [w, place, value] : list) {
    const Vec3 r = minus(place, centre);
    add(moment, w, dyad(r, r));
    add(slope, w, dyad(minus(value, mean), r));
  }
  const Eigenpairs e = eigenpairs(moment);
  const bool extends = *std::max_element(e.values.begin(), e.values.end()) > rounded * sum * R * R;
  if (!extends && all) return mean;
  if (!all && (!extends || rank_of(e) < rank_)) return std::nullopt;
  const double largest = *std::max_element(e.values.begin(), e.values.end());
  Vec3 value = mean;
  for (int k = 0; k < 3; ++k) {
    if (!(e.values[k] > flat * largest)) continue;
    const Vec3 change = multiply(slope, e.vectors[k]);
    const double along = dot(e.vectors[k], minus(x, centre)) / e.values[k];
    for (int d = 0; d < 3; ++d) value[d] += along * change[d];
  }
  return value;
}

std::string SpatialField::problem(const Vec3& x, std::string& advice) const {
  const auto found = value(x);
  const std::string where = fmt::format("the undeformed point ({:.4g}) m", fmt::join(x, ", "));
  if (!found && nearest_.find(x, 1).front().square > data_.reach * data_.reach) {
    advice = fmt::format("give values there, or raise reach (now {:.4g} m)", data_.reach);
    return fmt::format("{} is {:.4g} m from the nearest place of the file, whose places are {:.4g} m apart", where,
                       std::sqrt(nearest_.find(x, 1).front().square), spacing_);
  }
  if (!found) {
    advice = "give more places there, or between = \"nearest\"";
    return fmt::format("the directions around {} cancel each other", where);
  }
  if (allows(*found)) return "";
  advice = fmt::format("allowed: {}{}{}", data_.range.text(), unit_.empty() ? "" : " ", unit_);
  return fmt::format("is {} at {}", units::text((*found)[0], unit_), where);
}

void SpatialField::report(const std::string& problem, const std::string& advice) const {
  if (!section_) throw std::logic_error("a field that no scene names: " + problem);
  Section(*section_).error("field", problem, advice);
}

}  // namespace titin
