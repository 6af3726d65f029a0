#include "scene/advise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/words.hpp"
#include "scene/mesh_choice.hpp"
#include "scene/probe.hpp"
#include "scene/scene.hpp"
#include "scene/scene_facts.hpp"
#include "scene/simplification.hpp"

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
        explicit_(scene_.clock.by_stability),
        asked_(MeshChoice::of(facts_)) {
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

  /// By itself, not as a default.
  bool says(const std::string& key) const try {
    Config::read_file(options_.scene_file, joined(options_.overrides, {"~" + key}));
    return true;
  } catch (const InputError&) {
    return false;
  }

  /// Tries each by itself and takes those that fit into their share together, the least harmful first.
  void simplify() {
    auto list = simplifications(facts_, [this](const std::string& key) { return says(key); });
    for (Simplification& s : list) try_out(s);
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.changes < b.changes; });
    double left = for_simplifications * options_.tolerance;
    for (Simplification& s : list) {
      const bool fits = s.changes <= left;
      s.taken = s.can_be_had() && fits && s.cost < 1;
      if (s.taken) take(s), left -= s.changes;
      if (s.can_be_had())
        logging::info("{:<34}{:>14}{:>11.2f}x  {}", s.what, percent(s.changes), s.cost,
                      s.taken ? "take it"
                      : fits  ? "no: it saves nothing"
                              : "no: more than its share");
      else
        logging::info("{:<34}{:>14}{:>12}  no: {}", s.what, "-", "-", s.problem);
    }
    together_ = taken_.empty() ? base_ : run(joined(taken_, mesh_.overrides()));
  }

  void try_out(Simplification& s) {
    const Probe without = run_if_possible(joined(s.overrides, s.mesh(mesh_).overrides()));
    s.problem = without.failure;
    if (!without.ok()) return;
    s.changes = difference(without, base_);
    s.cost = without.cpu_seconds / base_.cpu_seconds;
  }

  void take(const Simplification& s) {
    taken_ = joined(taken_, s.overrides);
    simplified_ += s.changes;
    mesh_ = s.mesh(mesh_), asked_ = s.mesh(asked_);
  }

  // ---- order, mesh and step

  const char* order_key() const {
    return explicit_ ? "fv.order" : facts_.has("rod.kind") ? "rod.order" : "muscle.order";
  }
  bool has_order() const { return !facts_.has("rod.kind") || mesh_.key == "rod.cells"; }

  void choose_order() {
    const int own = has_order() ? facts_.whole(order_key()) : 1;
    std::vector<int> orders{own};
    if (own > 1) orders.push_back(own - 1);
    for (const int order : orders) {
      Candidate c{order, {fmt::format("{}={}", order_key(), order)}, mesh_};
      if (order == own) c.overrides.clear();
      const Overrides settings = joined(taken_, c.overrides);
      const Probe fine = order == own ? together_ : run_if_possible(joined(settings, mesh_.overrides()));
      if (!fine.ok()) continue;  // no such order for these cells, or none that gets to the end
      judge(c, settings, fine);
      candidates_.push_back(c);
    }
  }

  /// Estimates the errors of mesh and step at the probe, then the mesh and the step that are asked for.
  void judge(Candidate& c, const Overrides& settings, const Probe& fine) {
    const double at_probe = mesh_error(c, settings, fine);
    const double share = for_the_mesh * options_.tolerance;
    const double factor = std::clamp(std::pow(at_probe / share, 1 / c.rate), coarsest_mesh, finest_mesh);
    c.mesh = mesh_.scaled(factor);
    const double finer = c.mesh.over(mesh_);
    c.mesh_error = at_probe * std::pow(finer, -c.rate);
    if (!explicit_) choose_step(c, settings, fine);
    const double unknowns = std::pow(finer, static_cast<double>(mesh_.dimension()));
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
    const double as_asked = base_.cpu_seconds *
                            std::pow(asked_.over(mesh_), cost_exponent * static_cast<double>(mesh_.dimension())) *
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
    if (explicit_ || box.empty()) return;
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
    std::ofstream file;
    if (is_root()) file.open(options_.apply);
    file << fmt::format("# {} with what titin advise proposes for \"{}\" within {}.\n", options_.scene_file, quantity_,
                        percent(options_.tolerance))
         << resolved.resolved;
    if (any_of(is_root() && !file.flush()))
      throw InputError(
          {fmt::format("{} cannot be written; name another file with --apply", in_quotes(options_.apply))});
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
  std::vector<Candidate> candidates_;
  double simplified_ = 0;  // what those change, added
};

}  // namespace

void advise(const AdviseOptions& options) {
  std::error_code ignored;
  if (!options.apply.empty() && any_of(std::filesystem::exists(options.apply, ignored)))
    throw InputError({fmt::format("{} is there already; name another file with --apply", in_quotes(options.apply))});
  Adviser(options).go();
}

}  // namespace titin
