#include "fe/links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/words.hpp"
#include "fe/cell_element.hpp"

namespace titin {

namespace {

/// What takes the mean of a displacement's component over boundaries, by reference area: weights at true dofs.
mfem::Vector mean_over(const mfem::Array<int>& marker, int component, const CellElements& elements,
                       const mfem::ParFiniteElementSpace& space, int points) {
  mfem::ParMesh& mesh = *space.GetParMesh();
  mfem::Vector local(space.GetVSize()), shape, normal(mesh.Dimension()), weights(space.GetTrueVSize());
  mfem::Array<int> dofs;
  double area = 0;
  local = 0.0;
  for (int i = 0; i < mesh.GetNBE(); ++i) {
    auto* map = marker[mesh.GetBdrAttribute(i) - 1] ? mesh.GetBdrFaceTransformations(i) : nullptr;
    if (!map) continue;
    const mfem::FiniteElement& element = *space.GetFE(map->Elem1No);
    const auto& rule = elements.face_rule(map->GetGeometryType(), mesh.GetElementGeometry(map->Elem1No), points);
    space.GetElementVDofs(map->Elem1No, dofs);
    shape.SetSize(element.GetDof());
    for (int q = 0; q < rule.GetNPoints(); ++q) {
      map->SetAllIntPoints(&rule.IntPoint(q));
      element.CalcShape(map->GetElement1IntPoint(), shape);
      mfem::CalcOrtho(map->Jacobian(), normal);
      const double dA = rule.IntPoint(q).weight * normal.Norml2();
      area += dA;
      for (int a = 0; a < shape.Size(); ++a) local(dofs[component * shape.Size() + a]) += dA * shape(a);
    }
  }
  space.GetProlongationMatrix()->MultTranspose(local, weights);
  area = sum(area);
  if (!(area > 0)) throw InputError({"link: one of its boundaries lies inside the body; it must be at its surface"});
  weights /= area;
  return weights;
}

}  // namespace

void LinkConfig::bind(Section& s, const NamedMesh& mesh) {
  s.read("between", between, {.required = true, .doc = "two boundaries of the mesh"});
  s.read("spring", spring,
         {.unit = "N/m", .range = non_negative, .doc = "force over elongation along x, y, z, of the means over both"});
  s.read("damper", damper,
         {.unit = "N s/m", .range = non_negative, .doc = "force over its rate along x, y, z, of the means over both"});
  if (s.describing() || !mesh.mesh) return;
  if (s.has("between") && (between.size() != 2 || between[0] == between[1]))
    s.error("between", "a link joins two boundaries", "give the names of two that differ");
  for (const std::string& boundary : between)
    if (!mesh.boundaries.count(boundary))
      s.error("between", fmt::format("the mesh has no boundary {}", in_quotes(boundary)),
              "it has: " + names_of(mesh.boundaries));
  for (int i = mesh.mesh->Dimension(); i < 3; ++i)
    if (spring[i] != 0 || damper[i] != 0)
      s.error(spring[i] != 0 ? "spring" : "damper", "the body is plane", "let the last be 0: nothing moves in z");
}

Links::Links(const std::vector<LinkConfig>& links, const NamedMesh& mesh, const CellElements& elements,
             const mfem::ParFiniteElementSpace& space, int points) {
  for (const LinkConfig& link : links)
    for (int i = 0; i < space.GetVDim(); ++i) {
      if (link.spring[i] == 0 && link.damper[i] == 0) continue;
      const auto mean = [&](int end) {
        return mean_over(mesh.boundary_marker({link.between[end]}), i, elements, space, points);
      };
      mfem::Vector g = mean(1);
      g -= mean(0);
      links_.push_back({&link, i, g, link.spring[i], link.damper[i]});
    }
}

bool Links::has_damper() const {
  return std::any_of(links_.begin(), links_.end(), [](const Link& link) { return link.damper > 0; });
}

double Links::elongation(const Link& link, const mfem::Vector& u) { return u.Size() > 0 ? sum(link.g * u) : 0.0; }

void Links::update(const mfem::Vector& u, const mfem::Vector& v) {
  for (Link& link : links_) link.force = link.spring * elongation(link, u) + link.damper * elongation(link, v);
}

void Links::add(mfem::Vector& forces, mfem::Vector& absolute) const {
  for (const Link& link : links_) {
    forces.Add(-link.force, link.g);
    for (int i = 0; i < absolute.Size(); ++i) absolute(i) += std::abs(link.force * link.g(i));
  }
}

double Links::energy(const mfem::Vector& u) const {
  double total = 0;
  for (const Link& link : links_) {
    const double e = elongation(link, u);
    total += 0.5 * link.spring * e * e;
  }
  return total;
}

}  // namespace titin
