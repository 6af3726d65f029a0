#include "scene/mesh_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/words.hpp"

namespace titin {
namespace {

constexpr double whole_number = 1e-9;  // round-off in a number of cells

}  // namespace

MeshChoice MeshChoice::of(const SceneFacts& facts) {
  MeshChoice choice;
  if (facts.text("model") == "rod") {
    const std::string kind = facts.text("rod.kind");
    choice.key = kind == "continuum" ? "rod.cells" : kind == "chain" ? "rod.masses" : "";
    choice.cells = {choice.key.empty() ? 1 : facts.whole(choice.key)};
  } else if (facts.has("mesh.box")) {
    for (const double n : facts.numbers("mesh.cells")) choice.cells.push_back(static_cast<int>(n));
  } else {
    choice.refine = facts.whole("mesh.refine");
  }
  return choice;
}

std::vector<std::string> MeshChoice::overrides() const {
  if (key.empty()) return {};
  if (cells.empty()) return {fmt::format("mesh.refine={}", refine)};
  if (key != "mesh.cells") return {fmt::format("{}={}", key, cells[0])};
  return {fmt::format("mesh.cells=[{}]", fmt::join(cells, ", "))};
}

std::string MeshChoice::words() const {
  if (key.empty()) return "one element";
  return cells.empty() ? count(refine, "refinement") : fmt::format("{} cells", fmt::join(cells, " x "));
}

std::optional<MeshChoice> MeshChoice::halved() const {
  MeshChoice half = *this;
  for (int& n : half.cells) n = (n + 1) / 2;
  half.refine = std::max(0, refine - (cells.empty() ? 1 : 0));
  const bool same = half.cells == cells && half.refine == refine;
  return same ? std::nullopt : std::optional(half);
}

MeshChoice MeshChoice::scaled(double factor) const {
  const auto up = [](double x) { return static_cast<int>(std::ceil(x - whole_number)); };
  MeshChoice other = *this;
  if (cells.empty()) other.refine = std::max(0, refine + up(std::log2(factor)));
  for (int& n : other.cells) n = std::max(1, up(n * factor));
  return other;
}

double MeshChoice::over(const MeshChoice& from) const {
  if (cells.empty()) return std::exp2(refine - from.refine);
  double product = 1;
  for (std::size_t i = 0; i < cells.size(); ++i) product *= static_cast<double>(cells[i]) / from.cells[i];
  return std::pow(product, 1.0 / static_cast<double>(cells.size()));
}

}  // namespace titin
