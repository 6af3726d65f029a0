#include "scene/explicit_or_implicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words.hpp"

namespace titin {
namespace {

/// A square of two triangles; a cube of five tetrahedra: c dt over its edge, cells, CPU seconds of a cell and step (the
/// last from docs/verification/bench, the beryllium plate and the twisting column).
struct CutBox {
  double courant, cells, seconds;
};
constexpr CutBox square{0.4 * 0.586, 2, 0.9e-6}, cube{0.4 * 0.423, 5, 1.8e-6};
/// CPU time of an implicit step over an explicit one with as many unknowns: 40 to 130 there.
constexpr double implicit_step = 80;

double fastest_wave(const SceneFacts& facts) {
  const std::string bulk = ".volumetric.bulk_modulus";
  double fastest = 0;
  for (const std::string& key : facts.below("materials.")) {
    if (!key.ends_with(bulk)) continue;
    const std::string material = key.substr(0, key.size() - bulk.size());
    double modulus = facts.number(key);
    for (const std::string& term : facts.below(material + ".terms."))
      if (term.ends_with(".mu")) modulus += 4 * facts.number(term) / 3;
    fastest = std::max(fastest, std::sqrt(modulus / facts.number(material + ".density")));
  }
  return fastest;
}

/// To two digits.
double rough(double steps) {
  const double unit = std::pow(10, std::floor(std::log10(steps)) - 1);
  return std::round(steps / unit) * unit;
}

const CutBox& cut_of(const MeshChoice& mesh) { return mesh.dimension() == 2 ? square : cube; }

/// Nodes along an edge of the box, but for one.
double along(const Candidate& nodes, std::size_t edge) { return nodes.mesh.cells[edge] * std::max(1, nodes.order); }

}  // namespace

double explicit_steps(const SceneFacts& facts, const Candidate& nodes, double end) {
  const auto box = facts.numbers("mesh.box");
  const double c = fastest_wave(facts);
  if (box.empty() || !(c > 0)) return NAN;
  double h = box[0];
  for (std::size_t i = 0; i < nodes.mesh.cells.size(); ++i) h = std::min(h, box[i] / along(nodes, i));
  return std::ceil(end * c / (cut_of(nodes.mesh).courant * h));
}

std::string explicit_instead(const SceneFacts& facts, const Candidate& best, double end) {
  const double steps = explicit_steps(facts, best, end);
  if (!(steps > 0)) return "";
  const CutBox& cut = cut_of(best.mesh);
  double cells = cut.cells;
  for (std::size_t i = 0; i < best.mesh.cells.size(); ++i) cells *= along(best, i);
  return fmt::format(
      "  implicit: {}, about {:.2g} CPU s; explicit (model = \"lagrange\") on its nodes: about "
      "{:.0f} steps, {:.2g} CPU s, and another error",
      count(std::lround(end / best.step), "step"), best.cost, rough(steps), steps * cells * cut.seconds);
}

std::string implicit_instead(const SceneFacts& facts, const Probe& probe, double steps, double error) {
  for (const std::string& key : facts.below("materials."))
    if (key.find(".fluid") != std::string::npos) return "";
  const int needed = lines_that_follow(probe, error);
  return fmt::format(
      "  explicit: about {:.0f} steps; implicit (model = \"muscle\"): at least {}, each for about {:.0f} "
      "explicit ones on the same nodes (and another error), so {}",
      rough(steps), needed, implicit_step,
      needed * implicit_step < steps ? "they may be cheaper" : "they are hardly cheaper");
}

}  // namespace titin
