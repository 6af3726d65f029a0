/// One material point: stress against stretch, relaxation, creep, contraction; where it loses ellipticity; a fit of its
/// parameters; one stress and tangent for each entry of a list. docs/howto/material_point.md. Exit codes: 0 finished,
/// 1 input error, 2 no equilibrium, 4 internal error.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "base/log.hpp"
#include "base/text_file.hpp"
#include "base/version.hpp"
#include "point/batch.hpp"
#include "point/ellipticity_map.hpp"
#include "point/experiment.hpp"
#include "point/point_scene.hpp"
#include "point/script.hpp"

namespace titin {
namespace {

constexpr int finished = 0, input_error = 1, no_equilibrium = 2, internal_error = 4;

/// The command line, and what it asks for.
struct Driver {
  CLI::App app{"Titin: what a material does at one point.", "material_point"};
  std::vector<std::string> laws, arguments, data, free;
  std::string output, batch;
  bool plot = false, map = false;

  Driver() {
    app.set_version_flag("--version", fmt::format("Titin {} ({})", version(), commit()));
    app.add_option("SCENE key=value", arguments,
                   "A TOML file with [materials.NAME] and [point], and replacements of its values");
    app.add_option("--law", laws, "Instead of a file: a law by its name; again for more terms")
        ->allow_extra_args(false);
    app.add_option("-o", output, "File to write (default: standard output)")->type_name("FILE");
    app.add_flag("--plot", plot, "Also draw it, beside FILE");
    app.add_flag("--map", map, "Instead: smallest Legendre-Hadamard values over stretch and activation");
    app.add_option("--fit", data, "Instead: fit to measured curves, the {NAME}s in the values above")
        ->type_name("DATA.csv")
        ->allow_extra_args(false);
    app.add_option("--free", free, "--fit: a NAME and its bounds")
        ->type_name("NAME=LOWER,UPPER")
        ->allow_extra_args(false);
    app.add_option("--batch", batch, "Instead: energy, stress and tangent of a list of points")->type_name("IN.json");
  }

  int act() {
    if (!batch.empty()) return answer_list();
    if (!data.empty()) return fit();
    const CurveTable table = map ? ellipticity_map(scene()) : experiment();
    if (plot && output.empty()) output = arguments.empty() || !laws.empty() ? laws.front() + ".csv" : stem() + ".csv";
    write(table.csv());
    if (!table.problem.empty()) logging::error(table.problem);
    if (plot && run_script("plot", {output}) != 0) return internal_error;
    return table.problem.empty() ? finished : no_equilibrium;
  }

 private:
  static bool is_override(const std::string& argument) { return argument.find('=') != std::string::npos; }

  PointText scene() const {
    std::vector<std::string> files, overrides;
    for (const std::string& a : arguments) (is_override(a) ? overrides : files).push_back(a);
    if (files.size() + !laws.empty() != 1)
      throw InputError({"give one scene file, or --law NAME; see material_point --help"});
    return laws.empty() ? point_text_of_file(files.front(), overrides) : point_text_of_laws(laws, overrides);
  }
  std::string stem() const {
    for (const std::string& a : arguments)
      if (!is_override(a)) return std::filesystem::path(a).stem().string();
    return "point";
  }

  CurveTable experiment() const {
    const PointScene point = PointScene::read(scene());
    return run_experiment(*point.material, point.loading);
  }

  int answer_list() const {
    if (!laws.empty() || !arguments.empty()) throw InputError({"--batch takes no scene and no law: the list has them"});
    const TextFile list = read_text_file(batch);
    if (!list.problem.empty()) throw InputError({fmt::format("{}: the file {}", batch, list.problem)});
    write(run_batch(list.text, batch));
    return finished;
  }

  int fit() const {
    std::vector<std::string> words{"--program", std::filesystem::read_symlink("/proc/self/exe").string()};
    const auto add = [&](const char* option, const std::vector<std::string>& values) {
      for (const std::string& value : values) words.insert(words.end(), {option, value});
    };
    add("--law", laws), add("--data", data), add("--free", free);
    if (!output.empty()) add("-o", {output});
    if (plot) words.push_back("--plot");
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_script("fit", words);
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

int guarded(Driver& driver) {
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
