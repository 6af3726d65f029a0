#include "scene/run.hpp"

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "base/version.hpp"
#include "base/words.hpp"
#include "io/checkpoint.hpp"
#include "io/output_error.hpp"
#include "io/run_folder.hpp"
#include "scene/output.hpp"
#include "scene/progress.hpp"
#include "scene/run_report.hpp"
#include "scene/saving.hpp"
#include "scene/start.hpp"
#include "scene/stop_signals.hpp"

namespace titin {
namespace {

/// One run: the loop, and run.json around it.
class Run {
 public:
  Run(Start& start, const RunOptions& options, const StopSignals& signals)
      : scene_(start.scene),
        signals_(signals),
        start_(start),
        checkpoint_(start.checkpoint),
        folder_(options.restart.empty() ? RunFolder(folder_of(options), options.overwrite)
                                        : RunFolder::of_restart(folder_of(options))),
        clock_(scene_.clock, scene_.model->largest_dt()),
        output_(scene_.output, folder_, *scene_.model),
        saving_(scene_.saving),
        checkpoints_(folder_.path(), scene_.saving.keep) {
    summary_.scene = options.scene_file.empty() ? checkpoint_.head.scene_file : options.scene_file;
    summary_.title = scene_.title;
    summary_.model = scene_.model->name();
    summary_.libraries = library_versions();
    summary_.ranks = ranks();
    summary_.cells = static_cast<long>(scene_.model->mesh().GetGlobalNE());
    summary_.unknowns = scene_.model->unknowns();
    if (!checkpoint_.path.empty()) go_on();
    folder_.write(
        "resolved.toml",
        fmt::format("# {} as Titin {} understood it: in SI units, with defaults.\n{}{}", summary_.scene, version(),
                    start_.choice.empty() ? "" : fmt::format("# {}.\n", start_.chosen()), scene_.resolved));
    folder_.write("run.json", summary_.json());
    if (any_of(!logging::open_file(folder_.file("run.log")))) throw OutputError(folder_.file("run.log"));
  }

  Outcome go() {
    try {
      logging::info("Titin {} ({}), {}", version(), commit(), count(ranks(), "rank"));
      logging::info("{}: {}, {}, output in {}", scene_.title.empty() ? summary_.scene : scene_.title,
                    count(summary_.cells, "cell"), count(summary_.unknowns, "unknown"), folder_.path());
      tell_choice();
      if (!checkpoint_.path.empty())
        logging::info("going on from {}: step {}, {:.6g} s", checkpoint_.path, clock_.steps(), clock_.time());
      const Outcome outcome = loop();
      conclude(outcome);
      return outcome;
    } catch (const std::exception& error) {
      summary_.status = "failed";
      summary_.reason = error.what();
      try {
        folder_.write("run.json", summary_.json());
      } catch (const OutputError&) {
      }  // the first error tells more
      throw;
    }
  }

 private:
  void tell_choice() const {
    for (const std::string& line : start_.advice.report) logging::info("{}", line);
    if (!start_.advice.reached) logging::warning(start_.advice.problem());
    if (!start_.choice.empty()) logging::info("\n{}", start_.chosen());
  }

  Outcome loop() {
    const double start = wall_seconds();
    clock_.land_on(scene_.model->kinks());
    clock_.land_on(scene_.output.times(scene_.clock.end));
    if (checkpoint_.path.empty()) {
      output_.begin();
      scene_.reference.add(0, output_.quantities());
    }
    Progress progress(output_.shown(), scene_.clock.by_stability, clock_.fraction());
    Outcome outcome = Outcome::finished;
    while (!clock_.done()) {
      if (stop_is_asked()) {
        outcome = Outcome::stopped;
        break;
      }
      const Tried tried = try_step(progress);
      saving_.stepped();
      if (tried == Tried::hopeless) {
        outcome = Outcome::not_converged;
        break;
      }
      if (tried == Tried::again) continue;
      if (saving_.due_by_steps(clock_)) {
        save();
        scene_.model->forget();  // a run that goes on from here has not what was left either
      } else if (saving_.due_by_time()) {
        save();
      }
    }
    if (outcome != Outcome::finished && saving_.last_step() != clock_.steps()) save();
    output_.finish(clock_);
    summary_.stepping_seconds = wall_seconds() - start;
    return outcome;
  }

  enum class Tried { accepted, again, hopeless };
  Tried try_step(Progress& progress) {
    Model& model = *scene_.model;
    const Step step = advance(model);
    if (!step.ok()) {
      model.rewind();
      return cut(step) ? Tried::again : Tried::hopeless;
    }
    if (clock_.reject(step)) {
      model.rewind();
      summary_.newton.rejected += step.newton;
      return Tried::again;
    }
    if (!scene_.clock.by_stability) add_step(summary_, step);
    accept(model);
    clock_.accept(step, model.largest_dt());
    if (!output_.write(clock_)) return Tried::accepted;
    scene_.reference.add(clock_.time(), output_.quantities());
    progress.line(clock_, step, output_.shown());
    return Tried::accepted;
  }

  /// What a run is, for a checkpoint and back.
  void walk(StateWalk& walk) {
    scene_.model->walk_state(walk);
    clock_.walk(walk);
    output_.walk(walk);
    scene_.reference.walk(walk);
    summary_.walk(walk);
  }

  /// From the checkpoint.
  void go_on() {
    Timers::Scope timer("restart");
    try {
      read_checkpoint(checkpoint_.path, [&](StateWalk& reader) { walk(reader); });
    } catch (const OutputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw InputError({fmt::format("restart {}", error.what())});
    }
    checkpoints_.forget_after(clock_.steps());
    summary_.restarted_at = clock_.steps();
    saving_.saved(clock_.steps(), 0);
  }

  void save() {
    Timers::Scope timer("checkpoint");
    const double start = wall_seconds();
    output_.sync();
    CheckpointHead head;
    head.version = version();
    head.commit = commit();
    head.model = scene_.model->name();
    head.ranks = ranks();
    head.step = clock_.steps();
    head.time = clock_.time();
    head.mesh = scene_.mesh_identity;
    head.settings = scene_.settings;
    head.scene_file = summary_.scene;
    head.scene = scene_.resolved;
    head.choice = start_.choice;
    checkpoints_.write(head, [&](StateWalk& writer) { walk(writer); });
    saving_.saved(clock_.steps(), wall_seconds() - start);
    logging::detail("checkpoint of step {} in {}", clock_.steps(), duration(wall_seconds() - start));
  }

  Step advance(Model& model) {
    Timers::Scope timer("step");
    const Step step = model.advance(clock_.dt());
    summary_.krylov += step.krylov;
    if (!step.ok()) summary_.newton.failed += step.newton;
    return step;
  }

  static void accept(Model& model) {
    Timers::Scope timer("accept");
    model.accept();
  }

  bool cut(const Step& step) {
    const double tried = clock_.dt();
    const std::string failure = fmt::format("step {} from {:.6g} s by {:.4g} s failed: {}", clock_.steps() + 1,
                                            clock_.time(), tried, step.failure);
    if (clock_.cut(step)) {
      logging::info("{}; trying {:.4g} s", failure, clock_.dt());
      return true;
    }
    summary_.reason = fmt::format(
        "{}; the step was halved {} in a row: allow more (time.max_cuts), load more slowly or refine the mesh", failure,
        count(scene_.clock.max_cuts, "time"));
    return false;
  }

  bool stop_is_asked() {
    if (const std::string signal = signals_.received(); !signal.empty())
      summary_.reason = fmt::format("stopped by {} at {:.6g} s", signal, clock_.time());
    else if (saving_.out_of_time())
      summary_.reason = fmt::format("stopped at {:.6g} s: the next step could pass output.wall_limit", clock_.time());
    return !summary_.reason.empty();
  }

  void conclude(Outcome outcome) {
    summary_.unused_options = scene_.petsc->unused();
    for (const std::string& option : summary_.unused_options)
      logging::warning(
          fmt::format("{}: no solver of this run asked for it; its name may lack the solver's prefix", option));
    summary_.status = outcome == Outcome::finished  ? "finished"
                      : outcome == Outcome::stopped ? "stopped"
                                                    : "not_converged";
    summary_.steps = clock_.steps();
    summary_.time = clock_.time();
    summary_.newton.cuts = clock_.cuts();
    summary_.rejected = clock_.rejected();
    for (const Quantity& q : scene_.model->conservation()) summary_.conservation[q.name] = q.value;
    summary_.errors = scene_.reference.errors();
    for (const Quantity& q : scene_.model->errors()) summary_.errors[q.name] = q.value;
    add_costs(summary_);
    if (scene_.clock.by_stability) add_explicit_speed(summary_, *scene_.model);
    folder_.write("run.json", summary_.json());
    log_timers(summary_);
    if (scene_.clock.by_stability) log_explicit_speed(summary_);
    const std::string done = fmt::format("{} in {}; output up to {:.6g} s is in {}", count(clock_.steps(), "step"),
                                         duration(summary_.stepping_seconds), clock_.time(), folder_.path());
    if (outcome == Outcome::finished)
      logging::info("finished: {}", done);
    else
      logging::error(fmt::format("{}\n{}; titin run --restart {} goes on", summary_.reason, done, folder_.path()));
  }

  Scene& scene_;
  const StopSignals& signals_;
  const Start& start_;
  const FoundCheckpoint& checkpoint_;
  RunFolder folder_;
  Clock clock_;
  Output output_;
  Saving saving_;
  Checkpoints checkpoints_;
  RunSummary summary_;
};

}  // namespace

Outcome run(const RunOptions& options) {
  const StopSignals signals;  // from here on: one that comes while the scene is read stops before the first step
  Start start = read_start(options);
  return Run(start, options, signals).go();
}

}  // namespace titin
