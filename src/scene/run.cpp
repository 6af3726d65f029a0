#include "scene/run.hpp"

#include <cmath>
#include <filesystem>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "base/version.hpp"
#include "base/words.hpp"
#include "io/output_error.hpp"
#include "io/run_folder.hpp"
#include "scene/output.hpp"
#include "scene/progress.hpp"
#include "scene/run_report.hpp"
#include "scene/scene.hpp"
#include "scene/stop_signals.hpp"

namespace titin {
namespace {

std::string folder_of(const RunOptions& options) {
  if (!options.folder.empty()) return options.folder;
  return "results/" + std::filesystem::path(options.scene_file).stem().string();
}

/// All input errors at once: those of the scene and that of the folder.
Scene read(const RunOptions& options) {
  Timers::Scope timer("set-up");
  const std::string folder_problem = RunFolder::problem(folder_of(options), options.overwrite);
  try {
    Scene scene = Scene::read(options.scene_file, options.overrides);
    if (folder_problem.empty()) return scene;
  } catch (const InputError& error) {
    auto messages = error.messages();
    if (!folder_problem.empty()) messages.push_back(folder_problem);
    throw InputError(messages);
  }
  throw InputError({folder_problem});
}

/// One run: the loop, and run.json around it.
class Run {
 public:
  Run(Scene& scene, const RunOptions& options)
      : scene_(scene), folder_(folder_of(options), options.overwrite), clock_(scene.clock, scene.model->largest_dt()) {
    summary_.scene = options.scene_file;
    summary_.title = scene.title;
    summary_.model = scene.model->name();
    summary_.libraries = library_versions();
    summary_.ranks = ranks();
    summary_.cells = static_cast<long>(scene.model->mesh().GetGlobalNE());
    summary_.unknowns = scene.model->unknowns();
    folder_.write("resolved.toml", fmt::format("# {} as Titin {} understood it: in SI units, with defaults.\n{}",
                                               options.scene_file, version(), scene.resolved));
    folder_.write("run.json", summary_.json());
    if (any_of(!logging::open_file(folder_.file("run.log")))) throw OutputError(folder_.file("run.log"));
  }

  Outcome go() {
    try {
      logging::info("Titin {} ({}), {}", version(), commit(), count(ranks(), "rank"));
      logging::info("{}: {}, {}, output in {}", scene_.title.empty() ? summary_.scene : scene_.title,
                    count(summary_.cells, "cell"), count(summary_.unknowns, "unknown"), folder_.path());
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
  Outcome loop() {
    const double start = wall_seconds();
    clock_.land_on(scene_.model->kinks());
    clock_.land_on(scene_.output.times(scene_.clock.end));
    const StopSignals signals;
    Model& model = *scene_.model;
    Output out(scene_.output, folder_, model);
    scene_.reference.add(0, out.quantities());
    Progress progress(out.shown(), scene_.clock.by_stability);
    Outcome outcome = Outcome::finished;
    while (!clock_.done()) {
      if (const std::string signal = signals.received(); !signal.empty()) {
        outcome = stop_by(signal);
        break;
      }
      const Step step = advance(model);
      if (!step.ok()) {
        model.rewind();
        if (cut(step)) continue;
        outcome = Outcome::not_converged;
        break;
      }
      if (clock_.reject(step)) {
        model.rewind();
        summary_.newton.rejected += step.newton;
        continue;
      }
      if (!scene_.clock.by_stability) add_step(summary_, step);
      accept(model);
      clock_.accept(step, model.largest_dt());
      if (!out.write(clock_)) continue;
      scene_.reference.add(clock_.time(), out.quantities());
      progress.line(clock_, step, out.shown());
    }
    out.finish(clock_);
    summary_.stepping_seconds = wall_seconds() - start;
    return outcome;
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

  Outcome stop_by(const std::string& signal) {
    summary_.reason = fmt::format("stopped by {} at {:.6g} s", signal, clock_.time());
    return Outcome::stopped;
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
      logging::error(fmt::format("{}\n{}", summary_.reason, done));
  }

  Scene& scene_;
  RunFolder folder_;
  Clock clock_;
  RunSummary summary_;
};

}  // namespace

Outcome run(const RunOptions& options) {
  Scene scene = read(options);
  return Run(scene, options).go();
}

void check_scene(const RunOptions& options) {
  const Scene scene = Scene::read(options.scene_file, options.overrides);
  Model& model = *scene.model;
  const double steps = std::ceil(scene.clock.end / scene.clock.step * (1 - 1e-9));
  logging::info("{}: can be run", options.scene_file);
  if (!scene.title.empty()) logging::info("  title     {}", scene.title);
  logging::info("  model     {}", model.name());
  logging::info("  ranks     {}", ranks());
  logging::info("  cells     {}", model.mesh().GetGlobalNE());
  logging::info("  unknowns  {}", model.unknowns());
  if (scene.clock.by_stability)
    logging::info("  time      explicit steps, the first of {:.4g} s, to {:g} s",
                  std::min(scene.clock.step, model.largest_dt()), scene.clock.end);
  else
    logging::info("  time      {} of {:g} s to {:g} s", count(steps, "step"), scene.clock.step, scene.clock.end);
  std::string fields;
  for (const Field& field : model.fields()) fields += (fields.empty() ? "" : ", ") + field.name;
  logging::info("  fields    {}", fields);
  logging::info("  output    {}", folder_of(options));
}

}  // namespace titin
