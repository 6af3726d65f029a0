#include "mesh/named_parts.hpp"

#include <fmt/format.h>

#include "base/words.hpp"

namespace titin {

std::vector<std::string> read_boundaries(Section& s, const std::string& name, const NamedMesh& mesh) {
  std::vector<std::string> on;
  s.read("on", on, {.doc = "boundaries of the mesh (default: the one with this name)"});
  if (on.empty()) on = {name};
  if (s.describing() || !mesh.mesh) return on;
  for (const auto& boundary : on)
    if (!mesh.boundaries.count(boundary))
      s.error(s.has("on") ? "on" : "", fmt::format("the mesh has no boundary {}", in_quotes(boundary)),
              "it has: " + names_of(mesh.boundaries));
  return on;
}

void RegionMaterials::read(Section& s, const std::string& material, const NamedMesh& mesh) {
  std::vector<std::string> regions;
  s.read("regions", regions, {.doc = "regions of the mesh that are made of it (default: all)"});
  any_ = true;
  if (s.describing() || !mesh.mesh) return;
  const auto wrong = [&](const std::string& problem, const std::string& advice) {
    s.error(s.has("regions") ? "regions" : "", problem, advice);
    right_ = false;
  };
  if (regions.empty() && s.has("regions")) return wrong("names no region", "the mesh has: " + names_of(mesh.regions));
  if (regions.empty())
    for (const auto& [region, attribute] : mesh.regions) regions.push_back(region);
  for (const auto& region : regions) {
    const auto found = mesh.regions.find(region);
    if (found == mesh.regions.end())
      wrong(fmt::format("the mesh has no region {}", in_quotes(region)), "it has: " + names_of(mesh.regions));
    else if (const auto [made, is_new] = of_.emplace(found->second, material); !is_new)
      wrong(fmt::format("region {} is made of {} already", in_quotes(region), in_quotes(made->second)),
            "give each material its own regions");
  }
}

void RegionMaterials::finish(Section& root, const NamedMesh& mesh) const {
  if (root.describing() || !mesh.mesh || !right_) return;
  if (!any_) return root.error("materials", "no material", "add a table [materials.NAME]");
  for (const auto& [region, attribute] : mesh.regions)
    if (!of_.count(attribute))
      root.error("materials", fmt::format("region {} has no material", in_quotes(region)),
                 "name it in the regions of one");
}

}  // namespace titin
