/// The driver: `titin run | check | advise | inspect | materials | keys | help`. Exit codes: 0 finished, 1 input error,
/// 2 did not converge, 3 stopped by a signal, 4 internal error, or output that cannot be written.
#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <utility>

#include "base/config.hpp"
#include "base/log.hpp"
#include "base/parallel.hpp"
#include "base/version.hpp"
#include "io/output_error.hpp"
#include "scene/advise.hpp"
#include "scene/manual.hpp"
#include "scene/run.hpp"
#include "solve/petsc.hpp"

namespace titin {
namespace {

constexpr int input_error = 1, internal_error = 4;

/// "2%" to "0.02"; what is wrong with it, or "".
std::string from_percent(std::string& text) {
  if (!text.ends_with('%')) return "";
  double percent = 0;
  if (!CLI::detail::lexical_cast(CLI::detail::trim_copy(text.substr(0, text.size() - 1)), percent))
    return fmt::format("{} is no percentage", text);
  text = fmt::format("{}", percent / 100);
  return "";
}

/// The command line, and what it asks for.
struct Driver {
  CLI::App app{"Titin: solid dynamics of soft tissue and of shocks.", "titin"};
  RunOptions options;
  AdviseOptions advice;
  std::string prefix, law, folder;
  bool json = false, quiet = false;
  int verbosity = 0;
  CLI::App *run = nullptr, *check = nullptr, *advise = nullptr, *inspect = nullptr, *materials = nullptr,
           *keys = nullptr, *help = nullptr;

  Driver() {
    app.set_version_flag("--version", fmt::format("Titin {} ({})", version(), commit()));
    app.require_subcommand(1);
    run = app.add_subcommand("run", "Run a scene");
    check = app.add_subcommand("check", "Read a scene and say what it would be; write nothing");
    advise = app.add_subcommand("advise", "Find the cheapest setting that keeps a quantity within a tolerance");
    inspect = app.add_subcommand("inspect", "Say what is in the folder of a run");
    materials = app.add_subcommand("materials", "List the material laws, or tell all of one");
    keys = app.add_subcommand("keys", "List what a scene may say");
    help = app.add_subcommand("help", "Print this");
    for (CLI::App* with_scene : {run, check, advise}) {
      with_scene->add_option("SCENE", options.scene_file, "Scene file (TOML)")->required(with_scene != run);
      with_scene->add_option("key=value", options.overrides,
                             "Replace values of the scene: time.step=\"10 ms\"; or take one out: ~time.scheme");
    }
    run->add_option("-o", options.folder, "Output folder (default: results/<name of the scene>)")->type_name("DIR");
    run->add_flag("--overwrite", options.overwrite, "Replace an earlier run in the output folder");
    run->add_option("--restart", options.restart,
                    "Go on with an earlier run from its last checkpoint, or from the one named; SCENE may be left out")
        ->type_name("RUN")
        ->excludes("-o")
        ->excludes("--overwrite");
    run->add_flag("-v", verbosity, "Say more; -vv: all");
    run->add_flag("-q", quiet, "Say only warnings and errors");
    advise->add_option(
        "--quantity", advice.quantity,
        "Column of history.csv, without its unit (default: fidelity_quantity of the scene, or what a run shows)");
    advise
        ->add_option("--tolerance", advice.tolerance,
                     "Part of its largest value: 0.02 or 2% (default: fidelity_tolerance of the scene, or 2%)")
        ->transform(CLI::Validator(from_percent, ""))
        ->check(CLI::Range(1e-6, 1.0));
    advise->add_option("--apply", advice.apply, "Write the scene with the proposal into this file")->type_name("FILE");
    inspect->add_option("RUNDIR", folder, "Folder of a run, such as results/block")->required();
    materials->add_option("NAME", law, "Name of a law");
    keys->add_option("PREFIX", prefix, "Only keys that begin so, such as time or boundary.");
    for (CLI::App* list : {materials, keys}) list->add_flag("--json", json, "As JSON");
  }

  int act() {
    using logging::Level;
    logging::set_level(quiet            ? Level::quiet
                       : verbosity == 0 ? Level::normal
                       : verbosity == 1 ? Level::verbose
                                        : Level::debug);
    if (help->parsed()) logging::write(Level::quiet, Driver().app.help());  // of all, not of "help"
    if (inspect->parsed()) print_run(folder);
    if (materials->parsed()) print_materials(law, json);
    if (keys->parsed()) print_keys(prefix, json);
    if (check->parsed()) check_scene(options);
    if (advise->parsed()) {
      advice.scene_file = options.scene_file, advice.overrides = options.overrides;
      titin::advise(advice);
    }
    return run->parsed() ? static_cast<int>(titin::run(options)) : 0;
  }

  /// A restart may leave out the scene: then the first word is an override.
  void sort_words() {
    if (!run->parsed()) return;
    if (options.restart.empty() && options.scene_file.empty()) throw CLI::RequiredError("SCENE");
    if (options.restart.empty() || options.scene_file.find('=') == std::string::npos) return;
    options.overrides.insert(options.overrides.begin(), std::exchange(options.scene_file, ""));
  }
};

/// Usage, help and version: CLI11 tells them as exceptions.
int explain(const CLI::App& app, const CLI::ParseError& e) {
  if (e.get_exit_code() == 0) {
    if (is_root()) app.exit(e);
    return 0;
  }
  logging::error(fmt::format("{}; see titin help", e.what()));
  return input_error;
}

/// One message for all ranks if all met the error; else every rank that met it speaks, and the others are ended.
int report(const std::vector<std::string>& messages, int exit_code) {
  const bool all = all_arrive(2);
  for (const std::string& message : messages)
    all ? logging::error(message) : void(fmt::print(stderr, "error: rank {}: {}\n", rank(), message));
  if (!all) abort_all(exit_code);
  return exit_code;
}

int guarded(const std::function<int()>& act) {
  try {
    return act();
  } catch (const InputError& error) {
    return report(error.messages(), input_error);
  } catch (const OutputError& error) {
    return report({error.what()}, internal_error);
  } catch (const std::bad_alloc&) {
    return report({"out of memory; use more nodes, or fewer cells"}, internal_error);
  } catch (const std::exception& error) {
    return report({fmt::format("internal: {}", error.what())}, internal_error);
  } catch (...) {
    return report({"internal: an exception of no known type"}, internal_error);
  }
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  using namespace titin;
  const MpiSession mpi(argc, argv);
  Driver driver;
  try {
    driver.app.parse(argc, argv);
    driver.sort_words();
  } catch (const CLI::ParseError& error) {
    return explain(driver.app, error);
  }
  return guarded([&] {
    const PetscSession petsc;
    return driver.act();
  });
}
