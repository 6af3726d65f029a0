#include "io/drawn_mesh.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/parallel.hpp"

namespace titin {
namespace {

constexpr double same_place = 1e-9;  // in the reference cell
constexpr int space_components = 3;

/// Of cells with straight edges VTK's oldest types, which every reader knows.
std::uint8_t type_of(mfem::Geometry::Type geometry, int order) {
  switch (geometry) {
    case mfem::Geometry::SEGMENT:
      return order == 1 ? 3 : 68;
    case mfem::Geometry::TRIANGLE:
      return order == 1 ? 5 : 69;
    case mfem::Geometry::SQUARE:
      return order == 1 ? 9 : 70;
    case mfem::Geometry::TETRAHEDRON:
      return order == 1 ? 10 : 71;
    case mfem::Geometry::CUBE:
      return order == 1 ? 12 : 72;
    case mfem::Geometry::PRISM:
      return 73;
    default:
      throw std::logic_error("a cell that VTK has no Lagrange type for");
  }
}

/// Places of VTK's nodes among those of the element.
std::vector<int> order_of_vtk(mfem::Geometry::Type geometry, int order, const mfem::IntegrationRule& nodes) {
  mfem::Array<int> place;
  mfem::CreateVTKElementConnectivity(place, geometry, order);
  const mfem::IntegrationRule& points = mfem::GlobGeometryRefiner.Refine(geometry, order, 1)->RefPts;
  std::vector<int> of_vtk(place.Size());
  for (int i = 0; i < place.Size(); ++i) {
    const mfem::IntegrationPoint& wanted = points.IntPoint(place[i]);
    int node = 0;
    const auto apart = [&](const mfem::IntegrationPoint& at) {
      return std::abs(at.x - wanted.x) + std::abs(at.y - wanted.y) + std::abs(at.z - wanted.z);
    };
    while (node < nodes.GetNPoints() && apart(nodes.IntPoint(node)) > same_place) ++node;
    if (node == nodes.GetNPoints()) throw std::logic_error("a node of VTK's that the element has not");
    of_vtk[i] = node;
  }
  // MFEM has the order that VTK had before 9.1, in which the last two of a hexahedron's edges were the other way round.
  if (geometry == mfem::Geometry::CUBE) {
    const auto edge = of_vtk.begin() + 8 + 10 * (order - 1);
    std::swap_ranges(edge, edge + (order - 1), edge + (order - 1));
  }
  return of_vtk;
}

int order_of(const std::vector<Field>& fields, const mfem::ParMesh& mesh) {
  int order = mesh.GetNodes() ? mesh.GetNodes()->FESpace()->GetMaxElementOrder() : 1;
  for (const Field& field : fields)
    if (dynamic_cast<const mfem::H1_FECollection*>(field.values->FESpace()->FEColl()))
      order = std::max(order, field.values->FESpace()->GetMaxElementOrder());
  return order;
}

/// Vectors of the plane get a third component.
int components_of(const Field& field) {
  const int n = field.values->FESpace()->GetVDim();
  return n == 2 ? space_components : n;
}

}  // namespace

DrawnMesh::DrawnMesh(mfem::ParMesh& mesh, const std::vector<Field>& fields, Jumps jumps)
    : mesh_(mesh),
      fields_(fields),
      jumps_(jumps),
      collection_(order_of(fields, mesh), mesh.Dimension(), mfem::BasisType::ClosedUniform),
      space_(&mesh, &collection_),
      region_(mesh.GetNE(), 0),
      shapes_(mfem::Geometry::NumGeom),
      first_(1, 0) {
  const bool averages = jumps == Jumps::nodes && std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
                          return !is_constant(field) && !is_continuous(field);
                        });
  if (averages) {
    regions_ = mesh.attributes.Size();
    for (int cell = 0; cell < mesh.GetNE(); ++cell) region_[cell] = mesh.attributes.Find(mesh.GetAttribute(cell));
  }
  number_points();
}

void DrawnMesh::number_points() {
  std::vector<int> known(static_cast<std::size_t>(space_.GetVSize()) * regions_, -1);
  mfem::Array<int> dofs;
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
    space_.GetElementDofs(cell, dofs);
    for (int dof : dofs) {
      int& point = known[static_cast<std::size_t>(dof) * regions_ + region_[cell]];
      if (point < 0 || jumps_ == Jumps::kept) point = static_cast<int>(points_++);
      point_of_.push_back(point);
    }
    first_.push_back(static_cast<int>(point_of_.size()));
    const Shape& shape = this->shape(cell);
    for (const int node : shape.node_of_vtk) connectivity_.push_back(point(cell, node));
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(shape.type);
  }
}

const DrawnMesh::Shape& DrawnMesh::shape(int cell) {
  const mfem::Geometry::Type geometry = mesh_.GetElementGeometry(cell);
  Shape& shape = shapes_[geometry];
  const int order = collection_.GetOrder();
  if (shape.type == 0)
    shape = {order_of_vtk(geometry, order, space_.GetFE(cell)->GetNodes()), type_of(geometry, order)};
  return shape;
}

bool DrawnMesh::is_constant(const Field& field) const { return field.values->FESpace()->GetMaxElementOrder() == 0; }
bool DrawnMesh::is_continuous(const Field& field) const {
  return dynamic_cast<const mfem::H1_FECollection*>(field.values->FESpace()->FEColl()) != nullptr;
}
bool DrawnMesh::is_at_points(const Field& field) const {
  return !is_constant(field) && (is_continuous(field) || jumps_ != Jumps::means);
}

std::vector<double> DrawnMesh::positions() {
  std::vector<double> x(points_ * space_components, 0.0);
  mfem::DenseMatrix at;
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
    mesh_.GetElementTransformation(cell)->Transform(space_.GetFE(cell)->GetNodes(), at);
    for (int node = 0; node < nodes(cell); ++node)
      for (int i = 0; i < at.Height(); ++i) x[space_components * std::size_t(point(cell, node)) + i] = at(i, node);
  }
  return x;
}

mfem::DenseMatrix DrawnMesh::node_values(const Field& field, int cell) const {
  const mfem::ParFiniteElementSpace& space = *field.values->ParFESpace();
  const mfem::FiniteElement& element = *space.GetFE(cell);
  const mfem::IntegrationRule& at = space_.GetFE(cell)->GetNodes();
  mfem::Array<int> dofs;
  mfem::Vector values, shape(element.GetDof());
  space.GetElementVDofs(cell, dofs);
  field.values->GetSubVector(dofs, values);
  mfem::DenseMatrix result(at.GetNPoints(), components_of(field));
  result = 0.0;
  for (int node = 0; node < at.GetNPoints(); ++node) {
    element.CalcShape(at.IntPoint(node), shape);
    for (int c = 0; c < space.GetVDim(); ++c)
      for (int a = 0; a < shape.Size(); ++a) result(node, c) += shape(a) * values(c * shape.Size() + a);
  }
  return result;
}

/// Sums over all ranks' cells of a region at a node, over their number.
DrawnArray DrawnMesh::averaged(const Field& field) {
  const int n = components_of(field);
  const std::size_t size = space_.GetVSize();
  DrawnArray array{field.name, field.unit, n, std::vector<double>(points_ * n)};
  std::vector<std::vector<double>> sums(regions_ * (n + 1), std::vector<double>(size, 0.0));  // the last: how many
  mfem::Array<int> dofs;
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
    const mfem::DenseMatrix values = node_values(field, cell);
    auto* of_region = &sums[region_[cell] * (n + 1)];
    space_.GetElementDofs(cell, dofs);
    for (int node = 0; node < dofs.Size(); ++node) {
      for (int c = 0; c < n; ++c) of_region[c][dofs[node]] += values(node, c);
      of_region[n][dofs[node]] += 1;
    }
  }
  for (auto& sum : sums) {
    space_.GroupComm().Reduce<double>(sum.data(), mfem::GroupCommunicator::Sum<double>);
    space_.GroupComm().Bcast<double>(sum.data());
  }
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
    const auto* of_region = &sums[region_[cell] * (n + 1)];
    space_.GetElementDofs(cell, dofs);
    for (int node = 0; node < dofs.Size(); ++node)
      for (int c = 0; c < n; ++c)
        array.values[std::size_t(point(cell, node)) * n + c] = of_region[c][dofs[node]] / of_region[n][dofs[node]];
  }
  return array;
}

std::vector<DrawnArray> DrawnMesh::at_points() {
  std::vector<DrawnArray> arrays;
  for (const Field& field : fields_) {
    if (!is_at_points(field)) continue;
    if (!is_continuous(field) && jumps_ == Jumps::nodes) {
      arrays.push_back(averaged(field));
      continue;
    }
    const int n = components_of(field);
    DrawnArray array{field.name, field.unit, n, std::vector<double>(points_ * n)};
    for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
      const mfem::DenseMatrix values = node_values(field, cell);
      for (int node = 0; node < nodes(cell); ++node)
        for (int c = 0; c < n; ++c) array.values[std::size_t(point(cell, node)) * n + c] = values(node, c);
    }
    arrays.push_back(std::move(array));
  }
  return arrays;
}

DrawnArray DrawnMesh::mean(const Field& field) const {
  const mfem::ParFiniteElementSpace& space = *field.values->ParFESpace();
  const int n = components_of(field);
  DrawnArray array{field.name, field.unit, n, std::vector<double>(cells() * n, 0.0)};
  mfem::Vector value;
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
    mfem::ElementTransformation& map = *mesh_.GetElementTransformation(cell);
    const mfem::IntegrationRule& rule =
        mfem::IntRules.Get(mesh_.GetElementGeometry(cell), space.GetMaxElementOrder() + map.OrderW());
    double volume = 0;
    for (int q = 0; q < rule.GetNPoints(); ++q) {
      map.SetIntPoint(&rule.IntPoint(q));
      const double weight = rule.IntPoint(q).weight * map.Weight();
      field.values->GetVectorValue(map, rule.IntPoint(q), value);
      for (int c = 0; c < value.Size(); ++c) array.values[std::size_t(cell) * n + c] += weight * value(c);
      volume += weight;
    }
    for (int c = 0; c < n; ++c) array.values[std::size_t(cell) * n + c] /= volume;
  }
  return array;
}

std::vector<DrawnArray> DrawnMesh::at_cells() {
  std::vector<DrawnArray> arrays;
  for (const Field& field : fields_) {
    if (is_at_points(field) || field.name == "region") continue;
    if (!is_constant(field)) {
      arrays.push_back(mean(field));
      continue;
    }
    const int n = components_of(field);
    DrawnArray array{field.name, field.unit, n, std::vector<double>(cells() * n, 0.0)};
    mfem::Array<int> dofs;
    for (int cell = 0; cell < mesh_.GetNE(); ++cell) {
      field.values->FESpace()->GetElementVDofs(cell, dofs);
      for (int c = 0; c < dofs.Size(); ++c) array.values[std::size_t(cell) * n + c] = (*field.values)(dofs[c]);
    }
    arrays.push_back(std::move(array));
  }
  DrawnArray region{"region", "", 1, {}}, rank{"rank", "", 1, std::vector<double>(cells(), titin::rank())};
  for (int cell = 0; cell < mesh_.GetNE(); ++cell) region.values.push_back(mesh_.GetAttribute(cell));
  arrays.push_back(std::move(region));
  arrays.push_back(std::move(rank));
  return arrays;
}

}  // namespace titin
