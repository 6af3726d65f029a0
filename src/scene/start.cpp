#include "scene/start.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/timers.hpp"
#include "base/words.hpp"
#include "io/run_folder.hpp"

namespace titin {

std::string folder_of(const RunOptions& options) {
  if (!options.restart.empty()) return folder_of_restart(options.restart);
  if (!options.folder.empty()) return options.folder;
  const std::string name = std::filesystem::path(options.scene_file).stem().string();
  const bool is_folder = name.empty() || name == "." || name == "..";  // of a scene called "...toml"
  return "results/" + (is_folder ? "scene" : name);
}

std::string Start::chosen() const {
  std::string words;
  for (const std::string& word : choice)
    if (!word.starts_with("fidelity")) words += fmt::format(" '{}'", word);
  return words.empty() ? "" : fmt::format("fidelity = \"auto\" has chosen{}", words);
}

namespace {

Scene chosen_scene(const RunOptions& options, const std::vector<std::string>& choice) {
  std::vector<std::string> overrides = options.overrides;
  overrides.insert(overrides.end(), choice.begin(), choice.end());
  return Scene::read(options.scene_file, overrides);
}

/// A run that goes on has chosen before: its checkpoint knows what, and the scene in it is the chosen one.
Scene read_scene(const RunOptions& options, const FoundCheckpoint& from) {
  if (options.scene_file.empty()) return Scene::of_text(from.head.scene, from.path, options.overrides);
  return chosen_scene(options, from.head.choice);
}

bool is_to_choose(const Start& start) { return start.scene.fidelity.fidelity == Fidelity::automatic; }

/// Collective. Throws InputError.
void choose(Start& start, const RunOptions& options) {
  Timers::Scope timer("advice");
  logging::info("{}: fidelity is auto: probing what it needs", options.scene_file);
  start.scene = Scene();  // probes need its memory, and its options of PETSc
  start.advice = find_advice({.scene_file = options.scene_file, .overrides = options.overrides});
  start.choice = as_chosen(start.advice.proposal, start.advice.quantity);
  start.scene = chosen_scene(options, start.choice);
}

}  // namespace

Start read_start(const RunOptions& options) {
  Timers::Scope timer("set-up");
  Start start;
  std::vector<std::string> messages, others;
  const bool again = !options.restart.empty();
  if (again) start.checkpoint = find_checkpoint(options.restart);
  others.push_back(again ? start.checkpoint.problem : RunFolder::problem(folder_of(options), options.overwrite));
  const bool readable = !again || start.checkpoint.problem.empty() || !options.scene_file.empty();
  if (readable) try {
      start.scene = read_scene(options, start.checkpoint);
      if (again && start.checkpoint.problem.empty())
        others = restart_problems(start.checkpoint.path, start.checkpoint.head, start.scene);
    } catch (const InputError& error) {
      messages = error.messages();
    }
  std::erase(others, "");
  messages.insert(messages.end(), others.begin(), others.end());
  if (!messages.empty()) throw InputError(messages);
  if (again)
    start.choice = start.checkpoint.head.choice;
  else if (is_to_choose(start))
    choose(start, options);
  return start;
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
  if (scene.fidelity.fidelity == Fidelity::automatic)
    logging::info("  fidelity  auto: a run chooses mesh and step first; titin advise tells what");
  logging::info("  output    {}", folder_of(options));
}

}  // namespace titin
