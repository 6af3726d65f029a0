#include "scene/advise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/words.hpp"
#include "scene/probe.hpp"
#include "scene/scene.hpp"
#include "scene/scene_facts.hpp"

namespace titin {
namespace {

using Overrides = std::vector<std::string>;

constexpr long probe_unknowns = 3000;
constexpr double for_simplifications = 0.25, for_the_step = 0.25, for_the_mesh = 0.5;               // of the tolerance
constexpr double longest_step = 4, shortest_step = 1.0 / 16, coarsest_mesh = 0.5, finest_mesh = 6;  // over the probe's
/// CPU time of a solve over the number of unknowns: block solver 1.0 to 1.1 (docs/verification/solvers.md),
/// factors 1.5.
constexpr double cost_exponent = 1.2;
constexpr double slowest_rate = 1;
constexpr double vanishing =
    1e-6;  // of the largest quantity of the same unit: what Newton's tolerance leaves of a zero

Overrides joined(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string percent(double x) { return fmt::format("{:.2g} %", 100 * x); }

/// Cells along the edges of a box, or refinements of a file; elements or masses of a rod.
struct MeshChoice {
  std::string key = "mesh.cells";  // "": one element without mass, nothing to choose
  std::vector<int> cells;          // empty: from a file
  int refine = 0;
  Overrides overrides() const {
    if (key.empty()) return {};
    if (cells.empty()) return {fmt::format("mesh.refine={}", refine)};
    if (key != "mesh.cells") return {fmt::format("{}={}", key, cells[0])};
    return {fmt::format("mesh.cells=[{}]", fmt::join(cells, ", "))};
  }
  std::string words() const {
    if (key.empty()) return "one element";
    return cells.empty() ? count(refine, "refinement") : fmt::format("{} cells", fmt::join(cells, " x "));
  }
  std::optional<MeshChoice> halved() const {
    MeshChoice half = *this;
    if (cells.empty()) --half.refine;
    if (cells.empty()) return refine > 0 ? std::optional(half) : std::nullopt;
    for (int& n : half.cells) n = (n + 1) / 2;
    return half.cells == cells ? std::nullopt : std::optional(half);
  }
  /// Cells along an edge over those of `from`, the mean of all edges.
  double over(const MeshChoice& from) const {
    if (cells.empty()) return std::exp2(refine - from.refine);
    double product = 1;
    for (std::size_t i = 0; i < cells.size(); ++i) product *= static_cast<double>(cells[i]) / from.cells[i];
    return std::pow(product, 1.0 / static_cast<double>(cells.size()));
  }
  MeshChoice scaled(double factor) const {
    MeshChoice other = *this;
    if (cells.empty()) other.refine = std::max(0, refine + static_cast<int>(std::ceil(std::log2(factor) - 1e-9)));
    for (int& n : other.cells) n = std::max(1, static_cast<int>(std::ceil(n * factor - 1e-9)));
    return other;
  }
};

/// Something that the scene might do without.
struct Simplification {
  Simplification(std::string of, Overrides by) : what(std::move(of)), overrides(std::move(by)) {}
  std::string what;
  Overrides overrides;
  double changes = 0, cost = 1;  // of the quantity; CPU time over that of the probe with it
  std::string problem;           // why it cannot be had
  bool taken = false;
};

/// An order of the elements or of the scheme, with the mesh and the step that it needs.
struct Candidate {
  int order;
  Overrides overrides;
  MeshChoice mesh;
  double step = 0;  // [s]; 0: explicit, by stability
  double mesh_error = 0, step_error = 0, rate = 1, cost = 0;
  double all() const { return mesh_error + step_error; }
};

class Adviser {
 public:
  explicit Adviser(const AdviseOptions& options)
      : options_(options),
        scene_(Scene::read(options.scene_file, options.overrides)),
        facts_(scene_.settings),
        quantity_(options.quantity.empty() ? scene_.model->shown_quantity() : options.quantity),
        explicit_(scene_.clock.by_stability) {
    if (is_rod()) {
      const std::string kind = facts_.text("rod.kind");
      asked_.key = kind == "continuum" ? "rod.cells" : kind == "chain" ? "rod.masses" : "";
      asked_.cells = {asked_.key.empty() ? 1 : whole(asked_.key)};
    } else if (facts_.has("mesh.box")) {
      for (const double n : facts_.numbers("mesh.cells")) asked_.cells.push_back(static_cast<int>(n));
    }
    if (asked_.cells.empty()) asked_.refine = static_cast<int>(facts_.number("mesh.refine"));
    if (!facts_.below("averages.").empty() && !quantity_.starts_with("mean_")) common_.push_back("~averages");
  }

  void go() {
    choose_mesh();
    logging::info("{}: \"{}\" within {}", options_.scene_file, quantity_, percent(options_.tolerance));
    logging::info("probes on {}, {} unknowns, {}: {:.2g} CPU s each\n", mesh_.words(), base_.unknowns,
                  count(base_.steps, "step"), base_.cpu_seconds);
    logging::info("{:<34}{:>14}{:>12}", "what a probe finds", "changes it by", "costs");
    simplify();
    choose_order();
    propose();
  }

 private:
  /// What the scene says, or the default of a key that it only asks about.
  int whole(const std::string& key) const {
    if (facts_.has(key)) return static_cast<int>(facts_.number(key));
    for (const KeyRecord& record : scene_keys())
      if (record.path == key) return std::stoi(record.default_value);
    return 1;
  }

  bool is_rod() const { return facts_.text("model") == "rod"; }

  Probe run(const Overrides& more) {
    return probe(options_.scene_file, joined(joined(options_.overrides, common_), more), quantity_);
  }

  /// A scene that cannot be had, on a mesh with fewer cells than ranks say, is a probe that failed.
  Probe run_if_possible(const Overrides& more) try { return run(more); } catch (const InputError& error) {
    Probe none;
    none.failure = error.messages().front();
    return none;
  }

  /// The scene's own mesh, halved until it is small; a scene that cannot be read on a coarser one (a box of averages
  /// that then holds no cell) keeps the finer.
  void choose_mesh() {
    mesh_ = asked_;
    long unknowns = scene_.model->unknowns();
    scene_.model.reset();
    for (auto half = mesh_.halved(); unknowns > probe_unknowns && half; half = mesh_.halved()) try {
        const Scene coarse =
            Scene::read(options_.scene_file, joined(joined(options_.overrides, common_), half->overrides()));
        unknowns = coarse.model->unknowns();
        mesh_ = *half;
      } catch (const InputError&) {
        break;
      }
    base_ = run(mesh_.overrides());
    if (!base_.ok())
      throw InputError({fmt::format("{}: the probe on {} does not get to the end: {}", options_.scene_file,
                                    mesh_.words(), base_.failure)});
    if (base_.largest <= vanishing * base_.largest_of_unit)
      throw InputError({fmt::format("{} stays zero here, as far as its own kind goes; name another with --quantity",
                                    in_quotes(quantity_))});
  }

  // ---- simplifications

  std::vector<Simplification> simplifications() const {
    std::vector<Simplification> list;
    const auto is = [&](const char* key, const char* value) { return facts_.text(key) == value; };
    if (is("muscle.inertia", "dynamic")) {
      Overrides rest{"muscle.inertia=quasi-static"};
      if (says("time.scheme")) rest.push_back("~time.scheme");
      list.emplace_back("without inertia and rates", rest);
    }
    if (is_rod() && is("rod.inertia", "dynamic") && !is("rod.kind", "massless")) {
      Overrides rest{"rod.kind=massless"};
      for (const char* key : {"rod.cells", "rod.masses", "rod.order", "rod.spacing", "time.scheme"})
        if (says(key)) rest.push_back(fmt::format("~{}", key));
      list.emplace_back("without mass", rest);
    }
    if (is("muscle.element", "three_field"))
      list.emplace_back("displacement alone", Overrides{"muscle.element=displacement"});
    if (const Overrides plane = in_the_plane(); !plane.empty()) list.emplace_back("in the plane", plane);
    if (explicit_ && is("fv.limiter", "mood")) list.emplace_back("without limiter", Overrides{"fv.limiter=none"});
    return list;
  }

  /// By itself, not as a default.
  bool says(const std::string& key) const try {
    Config::read_file(options_.scene_file, joined(options_.overrides, {"~" + key}));
    return true;
  } catch (const InputError&) {
    return false;
  }

  /// What makes a plane scene of a box that is held between z- and z+; empty where it is not.
  Overrides in_the_plane() const {
    if (asked_.cells.size() != 3) return {};
    Overrides change;
    for (const char* side : {"boundary.z-", "boundary.\"z+\""}) {
      const std::string name = side;
      if (facts_.text(name + ".displacement.z") != "0 m" || facts_.has(name + ".displacement.x") ||
          facts_.has(name + ".displacement.y") || facts_.text(name + ".traction") != "0, 0, 0 Pa")
        return {};
      change.push_back("~" + name);
    }
    const auto box = facts_.numbers("mesh.box");
    return joined(change,
                  {fmt::format("mesh.box={}, {} m", box[0], box[1]), fmt::format("mesh.thickness={} m", box[2])});
  }

  Overrides cells_for(const Simplification& s, const MeshChoice& mesh) const {
    MeshChoice plane = mesh;
    if (s.what == "in the plane") plane.cells.resize(2);
    if (s.what == "without mass") plane.key = "";
    return plane.overrides();
  }

  void simplify() {
    list_ = simplifications();
    double left = for_simplifications * options_.tolerance;
    for (Simplification& s : list_) try_out(s);
    std::sort(list_.begin(), list_.end(), [](const auto& a, const auto& b) { return a.changes < b.changes; });
    for (Simplification& s : list_) {
      s.taken = s.problem.empty() && s.changes <= left && s.cost < 1;
      if (s.taken) left -= s.changes, taken_ = joined(taken_, s.overrides), simplified_ += s.changes;
      is_plane_ = is_plane_ || (s.taken && s.what == "in the plane");
      is_massless_ = is_massless_ || (s.taken && s.what == "without mass");
      const std::string why = s.taken            ? "take it"
                              : s.changes > left ? "no: more than its share"
                                                 : "no: it saves nothing";
      if (s.problem.empty())
        logging::info("{:<34}{:>14}{:>11.2f}x  {}", s.what, percent(s.changes), s.cost, why);
      else
        logging::info("{:<34}{:>14}{:>12}  no: {}", s.what, "-", "-", s.problem);
    }
    for (MeshChoice* mesh : {&mesh_, &asked_}) {
      if (is_plane_) mesh->cells.resize(2);
      if (is_massless_) mesh->key = "", mesh->cells = {1};
    }
    together_ = taken_.empty() ? base_ : run(joined(taken_, mesh_.overrides()));
  }

  void try_out(Simplification& s) {
    try {
      const Probe without = run(joined(s.overrides, cells_for(s, mesh_)));
      s.problem = without.failure;
      if (!without.ok()) return;
      s.changes = difference(without, base_);
      s.cost = without.cpu_seconds / base_.cpu_seconds;
    } catch (const InputError& error) {
      s.problem = error.messages().front();
    }
  }

  // ---- order, mesh and step

  const char* order_key() const { return explicit_ ? "fv.order" : is_rod() ? "rod.order" : "muscle.order"; }
  bool has_order() const { return !is_rod() || mesh_.key == "rod.cells"; }

  void choose_order() {
    const int own = has_order() ? whole(order_key()) : 1;
    std::vector<int> orders{own};
    if (own > 1) orders.push_back(own - 1);
    for (const int order : orders) {
      Candidate c{order, {fmt::format("{}={}", order_key(), order)}, mesh_};
      if (order == own) c.overrides.clear();
      try {
        judge(c);
        candidates_.push_back(c);
      } catch (const InputError&) {  // no such order for these cells
      }
    }
  }

  /// Estimates the errors of mesh and step at the probe, then the mesh and the step that are asked for.
  void judge(Candidate& c) {
    const Overrides settings = joined(taken_, c.overrides);
    const Probe fine = c.overrides.empty() ? together_ : run(joined(settings, mesh_.overrides()));
    if (!fine.ok()) return;
    const double at_probe = mesh_error(c, settings, fine);
    const double share = for_the_mesh * options_.tolerance;
    const double factor = std::clamp(std::pow(at_probe / share, 1 / c.rate), coarsest_mesh, finest_mesh);
    c.mesh = mesh_.scaled(factor);
    const double finer = c.mesh.over(mesh_);
    c.mesh_error = at_probe * std::pow(finer, -c.rate);
    if (!explicit_) choose_step(c, settings, fine);
    const double unknowns = std::pow(finer, static_cast<double>(dimension()));
    const double steps = explicit_ ? finer : scene_.clock.step / c.step;
    c.cost = fine.cpu_seconds * std::pow(unknowns, cost_exponent) * std::max(steps, 1 / longest_step);
    logging::info("{:<34}{:>14}{:>11.2f}x  rate {:.1f}: {} for {}",
                  has_order() ? fmt::format("mesh, with {} = {}", order_key(), c.order) : "elements", percent(at_probe),
                  fine.cpu_seconds / base_.cpu_seconds, c.rate, c.mesh.words(), percent(c.mesh_error));
  }

  double mesh_error(Candidate& c, const Overrides& settings, const Probe& fine) {
    const auto half = mesh_.halved();
    if (!half) return 0;
    const Probe coarse = run_if_possible(joined(settings, half->overrides()));
    if (!coarse.ok()) return 1;
    const double change = difference(coarse, fine), ratio = mesh_.over(*half);
    const auto quarter = half->halved();
    const Probe coarsest = quarter ? run_if_possible(joined(settings, quarter->overrides())) : Probe{};
    if (quarter && coarsest.ok() && change > 0)
      c.rate = std::clamp(std::log(difference(coarsest, coarse) / change) / std::log(half->over(*quarter)),
                          slowest_rate, c.order + 1.0);
    double error = change / (std::pow(ratio, c.rate) - 1);
    if (!c.overrides.empty())
      error = std::max(error, difference(fine, together_));  // a lower order's own trend may deceive
    return error;
  }

  void choose_step(Candidate& c, const Overrides& settings, const Probe& fine) {
    const double dt = scene_.clock.step;
    c.step = dt;
    if (fine.steps < 2 || scene_.clock.tolerance > 0) return;
    const Probe twice = run(joined(joined(settings, mesh_.overrides()), {fmt::format("time.step={:.9g} s", 2 * dt)}));
    const double order = fine.order;
    const double error = twice.ok() ? difference(twice, fine) / (std::exp2(order) - 1) : 1;
    double factor = longest_step;
    if (error > 0) factor = std::pow(for_the_step * options_.tolerance / error, 1 / order);
    factor = std::clamp(factor, shortest_step, twice.ok() ? longest_step : 1.0);
    c.step = scene_.clock.end / std::ceil(scene_.clock.end / (dt * factor) - 1e-9);
    c.step_error = error * std::pow(c.step / dt, order);
    logging::info("{:<34}{:>14}{:>12}  order {:.0f}: {:.4g} s for {}", fmt::format("step of {:.4g} s", dt),
                  percent(error), "", order, c.step, percent(c.step_error));
  }

  std::size_t dimension() const { return asked_.cells.empty() ? 3 : asked_.cells.size(); }

  // ---- the proposal

  void propose() {
    if (candidates_.empty()) throw InputError({fmt::format("{}: no probe got to the end", options_.scene_file)});
    const double wanted = (for_the_mesh + for_the_step) * options_.tolerance;
    const Candidate& best =
        *std::min_element(candidates_.begin(), candidates_.end(), [&](const auto& a, const auto& b) {
          const bool a_good = a.all() <= wanted, b_good = b.all() <= wanted;
          return a_good != b_good ? a_good : a_good ? a.cost < b.cost : a.all() < b.all();
        });
    Overrides proposal = joined(joined(taken_, best.overrides), best.mesh.overrides());
    if (best.step > 0) proposal.push_back(fmt::format("time.step={:.9g} s", best.step));
    const double as_asked = base_.cpu_seconds * std::pow(asked_.over(mesh_), cost_exponent * dimension()) *
                            (explicit_ ? asked_.over(mesh_) : 1);
    logging::info("\nproposal: {}", fmt::join(quoted(proposal), " "));
    logging::info("  within about {} of the answer; about {:.2g} CPU s (the scene as it is: about {:.2g})",
                  percent(best.all() + simplified_), best.cost, as_asked);
    if (best.all() > wanted)
      logging::warning(
          fmt::format("the tolerance of {} is not reached: what this proposes is as far as probes can tell",
                      percent(options_.tolerance)));
    mention_explicit(best);
    if (!options_.apply.empty()) write(proposal);
  }

  static Overrides quoted(Overrides words) {
    for (std::string& word : words) word = "'" + word + "'";
    return words;
  }

  /// Steps of the explicit formulation: c dt = 0.4 h, c^2 = K / rho of the stiffest material.
  void mention_explicit(const Candidate& best) const {
    const auto box = facts_.numbers("mesh.box");
    if (explicit_ || best.mesh.cells.empty() || is_rod()) return;
    double fastest = 0;
    for (const std::string& key : facts_.below("materials.")) {
      const auto at = key.find(".volumetric.bulk_modulus");
      if (at == std::string::npos) continue;
      fastest = std::max(fastest, std::sqrt(facts_.number(key) / facts_.number(key.substr(0, at) + ".density")));
    }
    double h = box[0];
    for (std::size_t i = 0; i < best.mesh.cells.size(); ++i)
      h = std::min(h, box[i] / (best.mesh.cells[i] * std::max(1, best.order)));
    if (fastest > 0)
      logging::info(
          "  explicit steps (model = \"lagrange\") of the same nodes would be about {:.3g}, implicit ones are {:.0f}",
          scene_.clock.end * fastest / (0.4 * h), scene_.clock.end / best.step);
  }

  void write(const Overrides& proposal) const {
    const Overrides all = joined(options_.overrides, proposal);
    const Scene resolved = Scene::read(options_.scene_file, all);
    if (!is_root()) return;
    std::ofstream file(options_.apply);
    file << fmt::format("# {} with what titin advise proposes for \"{}\" within {}.\n", options_.scene_file, quantity_,
                        percent(options_.tolerance))
         << resolved.resolved;
    if (!file.flush()) throw InputError({fmt::format("{} cannot be written; name another file", options_.apply)});
    logging::info("  written: {}", options_.apply);
  }

  const AdviseOptions& options_;
  Scene scene_;
  SceneFacts facts_;
  std::string quantity_;
  bool explicit_;
  Overrides common_, taken_;
  MeshChoice asked_, mesh_;  // of the scene; of the probes
  Probe base_, together_;    // as asked; with all simplifications that were taken
  std::vector<Simplification> list_;
  std::vector<Candidate> candidates_;
  double simplified_ = 0;
  bool is_plane_ = false, is_massless_ = false;
};

}  // namespace

void advise(const AdviseOptions& options) { Adviser(options).go(); }

}  // namespace titin
