#include "fe/point_fields.hpp"

#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "materials/spatial_field.hpp"

namespace titin {
namespace {

constexpr double perpendicular = 1e-3;  // cosine: directions are given to three digits or more

Vec3 position(mfem::ElementTransformation& map, const mfem::IntegrationPoint& point) {
  Vec3 at{};  // of plane bodies z = 0
  mfem::Vector x(at.data(), map.GetSpaceDim());
  map.Transform(point, x);
  return at;
}

/// Gets x of the lowest rank that has one to all. False when none has. Collective.
bool share(bool mine, std::vector<double>& x) {
  const double me = mine ? rank() : std::numeric_limits<double>::max(), first = min(me);
  if (me != first || !mine) x.assign(3, 0.0);
  sum(x);
  return first < std::numeric_limits<double>::max();
}

}  // namespace

/// The cells of one material while they are filled in.
struct PointFields::Filling {
  mfem::ParMesh& mesh;
  const CellElements& elements;
  int points;  // per direction
  std::vector<std::pair<int, Cell*>> cells;

  const mfem::IntegrationRule& rule(int cell) const { return elements.rule(mesh.GetElementGeometry(cell), points); }

  /// Values of one field at all points: take(cell, point, value). Collective.
  template <class Take>
  void fill(const SpatialField& field, Take take) const {
    bool missing = false;
    std::vector<double> where;
    for (const auto& [number, cell] : cells) {
      auto& map = *mesh.GetElementTransformation(number);
      const auto& centre = mfem::Geometries.GetCenter(map.GetGeometryType());
      const mfem::IntegrationRule& points_of_cell = rule(number);
      for (int q = 0; q < points_of_cell.GetNPoints() && !missing; ++q) {
        const Vec3 x = position(map, field.at() == SpatialField::At::cells ? centre : points_of_cell.IntPoint(q));
        const auto value = field.value(x);
        missing = !value || !field.allows(*value);
        if (missing) where.assign(x.begin(), x.end());
        if (value) take(*cell, q, *value);
      }
    }
    if (!share(missing, where)) return;
    std::string advice;
    const std::string problem = field.problem({where[0], where[1], where[2]}, advice);
    field.report(problem, advice);
  }

  /// Collective.
  void fill_all(const Material& material) const {
    const MaterialFields& fields = material.fields();
    const std::size_t count = fields.numbers.size();
    for (const auto& [number, cell] : cells) {
      const int points_of_cell = rule(number).GetNPoints();
      cell->numbers.resize(points_of_cell * count);
      cell->fibre.assign(points_of_cell, material.fibre());
      cell->second_fibre.assign(points_of_cell, material.second_fibre());
    }
    for (std::size_t f = 0; f < count; ++f)
      fill(*fields.numbers[f], [&](Cell& cell, int q, const Vec3& value) { cell.numbers[q * count + f] = value[0]; });
    if (fields.fibre) fill(*fields.fibre, [](Cell& cell, int q, const Vec3& a) { cell.fibre[q] = a; });
    if (fields.second_fibre)
      fill(*fields.second_fibre, [](Cell& cell, int q, const Vec3& b) { cell.second_fibre[q] = b; });
    if (fields.fibre || fields.second_fibre) check_right_angles(fields);
  }

  void check_right_angles(const MaterialFields& fields) const {
    double cosine = 0;
    for (const auto& [number, cell] : cells)
      for (std::size_t q = 0; q < cell->fibre.size(); ++q)
        cosine = std::max(cosine, std::abs(dot(cell->fibre[q], cell->second_fibre[q])));
    if (fields.at_right_angles && max(cosine) > perpendicular)
      (fields.second_fibre ? fields.second_fibre : fields.fibre)
          ->report("is somewhere not at a right angle to the other family, as a term needs",
                   "give directions of orthotropy");
  }
};

PointFields::PointFields(mfem::ParMesh& mesh, const std::map<int, std::shared_ptr<const Material>>& materials,
                         const CellElements& elements, int points)
    : index_(mesh.GetNE(), -1) {
  const auto varies = [&](int cell) { return !materials.at(mesh.GetAttribute(cell))->fields().empty(); };
  for (int cell = 0; cell < mesh.GetNE(); ++cell)
    if (varies(cell)) {
      index_[cell] = static_cast<int>(cells_.size());
      cells_.emplace_back();
    }
  std::map<const Material*, Filling> fillings;
  std::vector<const Material*> order;  // the same on all ranks
  for (const auto& [attribute, material] : materials)
    if (!material->fields().empty() && fillings.emplace(material.get(), Filling{mesh, elements, points, {}}).second)
      order.push_back(material.get());
  for (int cell = 0; cell < mesh.GetNE(); ++cell)
    if (index_[cell] >= 0)
      fillings.at(materials.at(mesh.GetAttribute(cell)).get()).cells.emplace_back(cell, &cells_[index_[cell]]);
  for (const Material* material : order) fillings.at(material).fill_all(*material);
}

void PointFields::set(int cell, PointInput& in) const {
  if (index_.empty() || index_[cell] < 0) return;
  const Cell& own = cells_[index_[cell]];
  if (!own.numbers.empty()) in.fields = own.numbers.data();
  in.fibre = own.fibre.data();
  in.second_fibre = own.second_fibre.data();
}

}  // namespace titin
