/// One material point: stress against stretch, relaxation, creep, contraction; one stress and tangent for each entry of
/// a list. docs/howto/material_point.md. Exit codes: 0 finished, 1 input error, 2 no equilibrium, 4 internal error.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "base/log.hpp"
#include "base/text_file.hpp"
#include "base/version.hpp"
#include "point/batch.hpp"
#include "point/experiment.hpp"
#include "point/point_scene.hpp"

namespace titin {
namespace {

constexpr int finished = 0, input_error = 1, no_equilibrium = 2, internal_error = 4;

/// The command line, and what it asks for.
struct Driver {
  CLI::App app{"Titin: what a material does at one point.", "material_point"};
  std::vector<std::string> laws, arguments;
  std::string output, batch;

  Driver() {
    app.set_version_flag("--version", fmt::format("Titin {} ({})", version(), commit()));
    app.add_option("SCENE key=value", arguments,
                   "A TOML file with [materials.NAME] and [point], and replacements of its values");
    app.add_option("--law", laws,
                   "Instead of a file: a law by its name (titin materials lists them); again for more terms")
        ->allow_extra_args(false);
    app.add_option("--batch", batch, "Instead: energy, stress and tangent of a list of points (JSON)")
        ->type_name("IN.json");
    app.add_option("-o", output, "File to write (default: standard output)")->type_name("FILE");
  }

  PointText scene() const {
    std::vector<std::string> files, overrides;
    for (const std::string& a : arguments) (a.find('=') == std::string::npos ? files : overrides).push_back(a);
    if (files.size() + !laws.empty() != 1)
      throw InputError({"give one scene file, or --law NAME; see material_point --help"});
    return laws.empty() ? point_text_of_file(files.front(), overrides) : point_text_of_laws(laws, overrides);
  }

  int act() const { return batch.empty() ? experiment() : answer_list(); }

  int answer_list() const {
    if (!laws.empty() || !arguments.empty()) throw InputError({"--batch takes no scene and no law: the list has them"});
    const TextFile list = read_text_file(batch);
    if (!list.problem.empty()) throw InputError({fmt::format("{}: the file {}", batch, list.problem)});
    write(run_batch(list.text, batch));
    return finished;
  }

  int experiment() const {
    const PointScene point = PointScene::read(scene());
    const CurveTable table = run_experiment(*point.material, point.loading);
    write(table.csv());
    if (table.problem.empty()) return finished;
    logging::error(table.problem);
    return no_equilibrium;
  }

  /// All of it or nothing: a reader never sees a part.
  void write(const std::string& text) const {
    if (output.empty()) {
      std::cout << text;
      return;
    }
    const std::string part = output + ".part";
    std::error_code problem;
    if (std::ofstream file(part); !(file << text << std::flush)) problem = std::make_error_code(std::errc::io_error);
    if (!problem) std::filesystem::rename(part, output, problem);
    if (problem)
      throw InputError(
          {fmt::format("{} cannot be written; look at the folder, its permissions and the free space", output)});
  }
};

int guarded(const Driver& driver) {
  try {
    return driver.act();
  } catch (const InputError& error) {
    for (const std::string& message : error.messages()) logging::error(message);
    return input_error;
  } catch (const std::exception& error) {
    logging::error(fmt::format("internal: {}", error.what()));
    return internal_error;
  }
}

}  // namespace
}  // namespace titin

int main(int argc, char** argv) {
  titin::Driver driver;
  try {
    driver.app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return driver.app.exit(error) == 0 ? 0 : titin::input_error;
  }
  return titin::guarded(driver);
}
