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
#include "scene/candidate.hpp"
#include "scene/explicit_or_implicit.hpp"
#include "scene/mesh_choice.hpp"
#include "scene/probe.hpp"
#include "scene/scene.hpp"
#include "scene/scene_facts.hpp"
#include "scene/simplification.hpp"

namespace titin {
namespace {

using Overrides = std::vector<std::string>;
using Say = std::function<void(const std::string&)>;

/// A probe has at most so many unknowns, or costs at most so much: a part of the scene as it is, or CPU seconds.
constexpr long probe_unknowns = 3000;
constexpr double probe_part = 0.05, probe_seconds = 1;
constexpr double for_simplifications = 0.25, for_the_step = 0.25, for_the_mesh = 0.5;  // of the tolerance
/// Of the largest quantity of the same unit: what Newton's tolerance leaves of a zero, and what round-off does.
constexpr double vanishing = 1e-6, vanishing_explicit = 1e-12;

Overrides joined(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string percent(double x) { return fmt::format("{:.2g} %", 100 * x); }

Overrides quoted(Overrides words) {
  for (std::string& word : words) word = "'" + word + "'";
  return words;
}

class Adviser {
 public:
  Adviser(const AdviseOptions& options, const Say& listen)
      : options_(options),
        listen_(listen),
        scene_(Scene::read(options.scene_file, options.overrides)),
        facts_(scene_.settings),
        kinks_(scene_.model->kinks()),
        explicit_(scene_.clock.by_stability),
        asked_(MeshChoice::of(facts_)) {
    advice_.quantity = options.quantity.empty() ? scene_.fidelity.quantity : options.quantity;
    if (advice_.quantity.empty()) advice_.quantity = scene_.model->shown_quantity();
    advice_.tolerance = options.tolerance > 0 ? options.tolerance : scene_.fidelity.tolerance;
    if (!facts_.below("averages.").empty() && !advice_.quantity.starts_with("mean_")) common_.push_back("~averages");
  }

  Proposal go() {
    choose_mesh();
    say("{}: \"{}\" within {}", options_.scene_file, advice_.quantity, percent(advice_.tolerance));
    say("probes on {}, {} unknowns, {}: {:.2g} CPU s each\n", mesh_.words(), base_.unknowns, count(base_.steps, "step"),
        base_.cpu_seconds);
    say("{:<34}{:>14}{:>12}", "what a probe finds", "changes it by", "costs");
    simplify();
    propose(candidates(trial()));
    return std::move(advice_);
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    tell(fmt::format(text, std::forward<Args>(args)...));
  }
  void tell(const std::string& line) {
    advice_.report.push_back(line);
    if (listen_) listen_(line);
  }

  Probe run(const Overrides& more) {
    return probe(options_.scene_file, joined(joined(options_.overrides, common_), more), advice_.quantity);
  }

  /// A scene that cannot be had, on a mesh with fewer cells than ranks say, is a probe that failed.
  Probe run_if_possible(const Overrides& more) try { return run(more); } catch (const InputError& error) {
    Probe none;
    none.failure = error.messages().front();
    return none;
  }

  /// The scene's own mesh, halved until a probe is small or cheap; a scene that cannot be read on a coarser one (a box
  /// of averages that then holds no cell) keeps the finer.
  void choose_mesh() {
    mesh_ = asked_;
    std::vector<MeshChoice> finer;
    long unknowns = scene_.model->unknowns();
    scene_.model.reset();
    for (auto half = mesh_.halved(); unknowns > probe_unknowns && half; half = mesh_.halved()) try {
        const Scene coarse =
            Scene::read(options_.scene_file, joined(joined(options_.overrides, common_), half->overrides()));
        unknowns = coarse.model->unknowns();
        finer.push_back(mesh_);
        mesh_ = *half;
      } catch (const InputError&) {
        break;
      }
    base_ = run(mesh_.overrides());
    refine_while_cheap(finer);
    if (!base_.ok())
      throw InputError({fmt::format("{}: the probe on {} does not get to the end: {}", options_.scene_file,
                                    mesh_.words(), base_.failure)});
    if (base_.largest <= (explicit_ ? vanishing_explicit : vanishing) * base_.largest_of_unit)
      throw InputError({fmt::format("{} stays zero here, as far as its own kind goes; name another quantity",
                                    in_quotes(advice_.quantity))});
  }

  /// `finer`: the finest first.
  void refine_while_cheap(const std::vector<MeshChoice>& finer) {
    const auto cost = [&](const MeshChoice& mesh) {
      return base_.cpu_seconds * cost_of(mesh.over(mesh_), mesh_.dimension(), explicit_);
    };
    as_asked_ = cost(asked_);
    const auto next =
        std::find_if(finer.begin(), finer.end(), [&](const auto& mesh) { return cost(mesh) <= dearest(); });
    if (!base_.ok() || next == finer.end()) return;
    mesh_ = *next;
    base_ = run(mesh_.overrides());
    as_asked_ = cost(asked_);
  }

  double dearest() const { return std::max(probe_seconds, probe_part * as_asked_); }

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
    double left = for_simplifications * advice_.tolerance;
    for (Simplification& s : list) {
      const bool fits = s.changes <= left;
      s.taken = s.can_be_had() && fits && s.cost < 1;
      if (s.taken) take(s), left -= s.changes;
      if (s.can_be_had())
        say("{:<34}{:>14}{:>11.2f}x  {}", s.what, percent(s.changes), s.cost,
            s.taken ? "take it"
            : fits  ? "no: it saves nothing"
                    : "no: more than its share");
      else
        say("{:<34}{:>14}{:>12}  no: {}", s.what, "-", "-", s.problem);
    }
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

  Trial trial() {
    Trial trial{.run = [this](const Overrides& more) { return run_if_possible(more); },
                .say = [this](const std::string& line) { tell(line); },
                .clock = scene_.clock,
                .kinks = kinks_,
                .order_key = explicit_                ? "fv.order"
                             : facts_.has("rod.kind") ? "rod.order"
                                                      : "muscle.order",
                .mesh = mesh_,
                .taken = taken_,
                .asked = base_,
                .base = taken_.empty() ? base_ : run(joined(taken_, mesh_.overrides())),
                .for_the_mesh = for_the_mesh * advice_.tolerance,
                .for_the_step = for_the_step * advice_.tolerance,
                .dearest = dearest()};
    if (facts_.has("rod.kind") && mesh_.key != "rod.cells") trial.order_key = "";
    if (!trial.order_key.empty()) trial.own_order = facts_.whole(trial.order_key);
    return trial;
  }

  // ---- the proposal

  void propose(const std::vector<Candidate>& candidates) {
    if (candidates.empty()) throw InputError({fmt::format("{}: no probe got to the end", options_.scene_file)});
    const double wanted = (for_the_mesh + for_the_step) * advice_.tolerance;
    Candidate best = *std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
      const bool a_good = a.all() <= wanted, b_good = b.all() <= wanted;
      return a_good != b_good ? a_good : a_good ? a.cost < b.cost : a.all() < b.all();
    });
    refine_until_possible(best);
    advice_.proposal = proposal_of(best);
    advice_.error = best.all() + simplified_;
    advice_.reached = best.all() <= wanted;
    say("\nproposal: {}", fmt::join(quoted(advice_.proposal), " "));
    say("  within about {} of the answer; about {:.2g} CPU s (the scene as it is: about {:.2g})",
        percent(advice_.error), best.cost, as_asked_);
    const double steps = base_.steps * best.mesh.over(mesh_);
    const std::string other = explicit_ ? implicit_instead(facts_, base_, steps, for_the_step * advice_.tolerance)
                                        : explicit_instead(facts_, best, scene_.clock.end);
    if (!other.empty()) tell(other);
  }

  Overrides proposal_of(const Candidate& best) const {
    Overrides proposal = joined(joined(taken_, best.overrides), best.mesh.overrides());
    if (best.step > 0) proposal.push_back(fmt::format("time.step={:.9g} s", best.step));
    return proposal;
  }

  /// On a mesh that is coarser than the scene's own a box of averages may hold no cell, or there are fewer cells than
  /// ranks.
  void refine_until_possible(Candidate& best) const {
    while (best.mesh.over(asked_) < 1) try {
        Scene::read(options_.scene_file, joined(options_.overrides, proposal_of(best)));
        return;
      } catch (const InputError&) {
        best.mesh = best.mesh.scaled(2);
      }
  }

  const AdviseOptions& options_;
  const Say& listen_;
  Scene scene_;
  SceneFacts facts_;
  std::vector<double> kinks_;
  bool explicit_;
  Overrides common_, taken_;
  MeshChoice asked_, mesh_;  // of the scene; of the probes
  Probe base_;               // as asked
  double as_asked_ = 0;      // [CPU s] of the scene, estimated
  double simplified_ = 0;    // what was taken changes, added
  Proposal advice_;
};

void write(const AdviseOptions& options, const Proposal& advice) {
  const Scene scene =
      Scene::read(options.scene_file, joined(options.overrides, as_chosen(advice.proposal, advice.quantity)));
  std::ofstream file;
  if (is_root()) file.open(options.apply);
  file << fmt::format("# {} with what titin advise proposes for \"{}\" within {}.\n{}", options.scene_file,
                      advice.quantity, percent(advice.tolerance), scene.resolved);
  if (any_of(is_root() && !file.flush()))
    throw InputError({fmt::format("{} cannot be written; name another file with --apply", in_quotes(options.apply))});
  logging::info("  written: {}", options.apply);
}

}  // namespace

std::string Proposal::summary() const {
  return fmt::format("for \"{}\" within {}: {}", quantity, percent(tolerance), fmt::join(quoted(proposal), " "));
}

std::string Proposal::problem() const {
  return reached ? ""
                 : fmt::format("the tolerance of {} is not reached: what this proposes is as far as probes can tell",
                               percent(tolerance));
}

Proposal find_advice(const AdviseOptions& options, const Say& listen) { return Adviser(options, listen).go(); }

void advise(const AdviseOptions& options) {
  std::error_code ignored;
  if (!options.apply.empty() && any_of(std::filesystem::exists(options.apply, ignored)))
    throw InputError({fmt::format("{} is there already; name another file with --apply", in_quotes(options.apply))});
  const Proposal advice =
      find_advice(options, [](const std::string& line) { logging::write(logging::Level::normal, line); });
  if (!advice.reached) logging::warning(advice.problem());
  if (!options.apply.empty()) write(options, advice);
}

}  // namespace titin
