// What was understood of a scene must read as itself.
#include <cstdlib>

#include "base/config.hpp"
#include "fuzz/targets.hpp"

namespace titin {
namespace {

/// One key of each type that scenes have.
struct Keys {
  std::string title;
  double end = 0, step = 0;
  int cuts = 8;
  bool fields = true;
  std::array<double, 3> axis{};
  std::vector<double> box;
  std::vector<int> cells;
  std::vector<std::string> on;
  Table pull;
  int choice = 0;

  void bind(Section root) {
    root.read("title", title, {.doc = "-"});
    Section time = root.section("time");
    time.read("end", end, {.unit = "s", .range = positive, .required = true, .doc = "-"});
    time.read("step", step, {.unit = "s", .range = positive, .doc = "-"});
    time.read("max_cuts", cuts, {.range = {.min = 0, .max = 60}, .doc = "-"});
    Section mesh = root.section("mesh");
    mesh.read("box", box, {.unit = "m", .range = non_negative, .doc = "-"});
    mesh.read("cells", cells, {.range = {.min = 1, .max = 1e4}, .doc = "-"});
    mesh.choose("kind", choice, {{"tensor", 0}, {"simplices", 1}}, {.doc = "-"});
    root.section("output").read("fields", fields, {.doc = "-"});
    root.each("boundary", "-", [&](const std::string&, Section boundary) {
      boundary.read("on", on, {.doc = "-"});
      boundary.read("axis", axis, {.doc = "-"});
      boundary.read("pull", pull, {.unit = "m", .doc = "-"});
    });
    root.leave("test");
  }
};

std::string resolved(const std::string& text) {
  Config config(text, "fuzz.toml");
  Keys().bind(config.root());
  config.finish();
  return config.resolved();
}

}  // namespace

void fuzz_scene(const std::string& bytes) {
  std::string once;
  try {
    once = resolved(bytes);
  } catch (const InputError&) {
    return;
  }
  if (resolved(once) != once) std::abort();
}

}  // namespace titin
