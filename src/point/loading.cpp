#include "point/loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/text_file.hpp"
#include "point/named_columns.hpp"

namespace titin {
namespace {

constexpr int xx = 0, xy = 1, xz = 2, yx = 3, yy = 4, yz = 5, zx = 6, zy = 7, zz = 8;
constexpr double first_of_hold = 1e-4;  // logarithmic steps begin at this part of the time they fill

/// The axis that a shear leaves alone.
int normal_of(int shear) { return 4 * (3 - shear / 3 - shear % 3); }

void free_of_stress(MixedControl& control, std::initializer_list<int> components) {
  for (int q : components) control.by_stress[q] = true, control.value[q] = 0;
}

void drive_component(MixedControl& control, int q, double value, bool by_stress) {
  control.by_stress[q] = by_stress;
  control.value[q] = value;
}

/// The same curve with its values taken away from `rest` and back: cycles.
Table cycle(double rest, double target, double rise, int cycles) {
  std::vector<double> time{0}, value{rest};
  for (int half = 1; half <= 2 * cycles; ++half) {
    time.push_back(half * rise);
    value.push_back(half % 2 ? target : rest);
  }
  return {time, value};
}

/// A sine about rest that takes `rise` to its first crest, sampled so that steps end on it exactly.
Table sine(double rest, double target, double rise, int cycles, int steps) {
  std::vector<double> time{0}, value{rest};
  for (int k = 1; k <= 4 * cycles * steps; ++k) {
    time.push_back(k * rise / steps);
    value.push_back(rest + (target - rest) * std::sin(0.5 * std::numbers::pi * k / steps));
  }
  return {time, value};
}

Table ramp_and_hold(double rest, double target, double rise, double end) {
  if (rise == 0) return {{0, end}, {target, target}};
  if (end > rise) return {{0, rise, end}, {rest, target, target}};
  return {{0, rise}, {rest, target}};
}

void add_steps(std::vector<double>& times, double to, int steps, Spacing spacing) {
  const double from = times.back();
  for (int k = 1; k < steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    times.push_back(from + (to - from) * (spacing == Spacing::equal ? part : std::pow(first_of_hold, 1 - part)));
  }
  times.push_back(to);
}

}  // namespace

Table LoadingConfig::course() const {
  const double target = drive(0);
  if (!drive.is_constant()) return drive;
  if (program == Program::cycle) return cycle(rest(), target, rise, cycles);
  if (program == Program::sine) return sine(rest(), target, rise, cycles, steps);
  if (program == Program::ramp) return ramp_and_hold(rest(), target, rise, rise);
  if (program == Program::hold) return ramp_and_hold(rest(), target, rise, end);
  return {{0, release}, {target, target}};
}

std::vector<double> LoadingConfig::times() const {
  std::vector<double> marks;
  const auto mark = [&](const Table& table) {
    if (!table.is_constant()) marks.insert(marks.end(), table.time().begin(), table.time().end());
  };
  if (loading == Loading::components) {
    for (const ComponentDrive& c : components) mark(c.value);
    marks.push_back(end);
  } else {
    mark(course());
    if (program == Program::isotonic) marks.insert(marks.end(), {release, end});
  }
  std::sort(marks.begin(), marks.end());
  std::vector<double> times{0};
  const bool fine = program == Program::sine && loading != Loading::components;  // its points are steps already
  for (double t : marks)
    if (t > times.back()) add_steps(times, t, fine ? 1 : steps, t > rise ? spacing : Spacing::equal);
  return times;
}

MixedControl LoadingConfig::aligned(double drive, bool by_stress) const {
  MixedControl control;
  drive_component(control, xx, drive, by_stress);
  if (loading == Loading::confined) return control;
  free_of_stress(control, {xz, yz, zz});
  if (loading == Loading::uniaxial) free_of_stress(control, {xy, yy});
  const double share = loading == Loading::equibiaxial ? 1 : ratio;
  if (loading == Loading::equibiaxial || loading == Loading::biaxial) {
    drive_component(control, yy, by_stress ? share * drive : 1 + share * (drive - 1), by_stress);
    if (by_stress) free_of_stress(control, {xy});
  }
  return control;
}

MixedControl LoadingConfig::sheared(double drive, bool by_stress) const {
  MixedControl control;
  drive_component(control, plane, drive, by_stress);
  // The volume stays by itself; what the free axis gives is the pressure.
  if (volume == Volume::incompressible) free_of_stress(control, {normal_of(plane)});
  return control;
}

MixedControl LoadingConfig::control(double time, double drive, bool by_stress) const {
  if (is_shear()) return sheared(drive, by_stress);
  if (loading != Loading::components) return aligned(drive, by_stress);
  MixedControl control;
  for (int q = 0; q < 9; ++q) drive_component(control, q, components[q].value(time), components[q].by_stress);
  return control;
}

void LoadingConfig::bind(Section& s) {
  s.choose("loading", loading,
           {{"uniaxial", Loading::uniaxial},
            {"equibiaxial", Loading::equibiaxial},
            {"planar", Loading::planar},
            {"biaxial", Loading::biaxial},
            {"simple_shear", Loading::simple_shear},
            {"triaxial_shear", Loading::triaxial_shear},
            {"confined", Loading::confined},
            {"components", Loading::components}},
           {.doc = "which components of F are driven; see docs/howto/material_point.md"});
  s.choose("volume", volume, {{"compressible", Volume::compressible}, {"incompressible", Volume::incompressible}},
           {.doc = "incompressible: det F = 1, the pressure follows from the stress-free sides"});
  s.choose("fibre_rate", fibre_rate,
           {{"none", FibreRate::none},
            {"stretch_difference", FibreRate::stretch_difference},
            {"velocity_gradient", FibreRate::velocity_gradient}},
           {.doc = "rate of the fibre's stretch in a step; none: as if infinitely slow"});
  s.read("ratio", ratio, {.doc = "biaxial: strain (or stress) along y over that along x"});
  int shear = 0;
  s.choose_word("plane", shear, {"xy", "xz", "yx", "yz", "zx", "zy"},
                {.doc = "simple shear: the component of F, so xy moves along x in proportion to y"});
  plane = shear_components[shear];
  bind_program(s);
  bind_drive(s);
  bind_components(s);
  if (!s.describing()) check(s);
}

void LoadingConfig::bind_program(Section& s) {
  s.choose("program", program,
           {{"ramp", Program::ramp},
            {"hold", Program::hold},
            {"cycle", Program::cycle},
            {"sine", Program::sine},
            {"isotonic", Program::isotonic}},
           {.doc = "course of a constant drive: to it; to it and stay; there and back; sine about rest; or held until "
                   "the release, and its stress from then on"});
  s.read("rise", rise, {.unit = "s", .range = non_negative, .doc = "time from rest to the drive"});
  s.read("end", end, {.unit = "s", .range = positive, .doc = "end of hold, isotonic and components"});
  s.read("cycles", cycles, {.range = {.min = 1}, .doc = "how often, for cycle and sine"});
  s.read("steps", steps, {.range = {.min = 1}, .doc = "steps of each part of the course, of a quarter of a sine"});
  s.choose("spacing", spacing, {{"equal", Spacing::equal}, {"logarithmic", Spacing::logarithmic}},
           {.doc = "logarithmic: steps after the rise grow from a ten-thousandth of the time that is left"});
  double given = rise;
  s.read("release", given, {.unit = "s", .range = positive, .doc = "isotonic: when stretch control ends"});
  s.read("load", load, {.range = non_negative, .doc = "isotonic: stress from then on over that at the release"});
  if (program == Program::isotonic) release = given;
}

void LoadingConfig::bind_drive(Section& s) {
  struct Kind {
    const char *name, *unit, *doc;
    Range range;
    double rest;
  };
  std::string given;
  for (const Kind& kind :
       {Kind{"stretch", "", "drives F_xx: a constant for the program, or a curve in time", positive, 1},
        Kind{"shear", "", "drives the component of F named by plane, likewise", any, 0},
        Kind{"stress", "Pa", "drives P_xx, or P of the plane: force over reference area", any, 0}}) {
    Table value(kind.rest);
    const bool there = s.has(kind.name);
    s.read(kind.name, value, {.unit = kind.unit, .range = kind.range, .doc = kind.doc});
    if (!there) continue;
    if (!given.empty()) s.error(kind.name, fmt::format("{} drives the point already", given), "drop one of them");
    given = kind.name;
    drive = value;
  }
  by_stress = given == "stress";
  if (s.describing() || loading == Loading::components) return;
  const std::string wanted = is_shear() ? "shear" : "stretch";
  if (given.empty() && needs_drive && program != Program::isotonic)  // which may be isometric before the release
    s.error("", "nothing drives the point",
            fmt::format("add {}, or stress = \"10 kPa\"", is_shear() ? "shear = 0.5" : "stretch = 1.5"));
  else if (!given.empty() && given != wanted && !by_stress)
    s.error(given, fmt::format("this loading is driven by {}", wanted), fmt::format("write {} = ... instead", wanted));
}

void LoadingConfig::bind_components(Section& s) {
  if (loading != Loading::components && !s.describing()) return;
  for (int q = 0; q < 9; ++q) {
    const bool below = q == yx || q == zx || q == zy;  // held, so that the point cannot turn
    components[q] = {!below, 0.0};
  }
  if (s.has("table")) bind_table(s);
  for (const char* name : {"F", "P"}) {
    Section group = s.section(name, name == std::string("F") ? "components: those of F that are given"
                                                             : "components: those of P; 0 where nothing is said, but "
                                                               "F_yx = F_zx = F_zy = 0");
    const bool stress = *name == 'P';
    for (int q = 0; q < 9; ++q) {
      if (!group.describing() && !group.has(component_names[q])) continue;
      if (stress && !s.describing() && s.section("F").has(component_names[q]))
        group.error(component_names[q], "F is given for this component as well", "drop one of them");
      Table value(0.0);
      group.read(component_names[q], value, {.unit = stress ? "Pa" : "", .doc = "constant, or a curve in time"});
      components[q] = {stress, value};
    }
  }
}

void LoadingConfig::bind_table(Section& s) {
  std::string file;
  s.read("table", file, {.doc = "components: CSV with columns time [s], F_xx, P_yy [Pa], ..."});
  const std::string path = s.existing_file("table", file);
  if (path.empty()) return;
  const TextFile text = read_text_file(path);
  const NamedColumns table = parse_named_columns(text.text);
  std::string problem = text.problem.empty() ? table.problem : text.problem;
  const NamedColumn* time = problem.empty() ? table.find("time") : nullptr;
  if (problem.empty() && !time) problem = "has no column time [s]";
  const std::vector<double> at = time ? in_si(*time, "s", problem) : std::vector<double>();
  if (std::adjacent_find(at.begin(), at.end(), std::greater_equal<>()) != at.end())
    problem = "its times do not increase";
  for (int q = 0; q < 9 && problem.empty(); ++q)
    for (const char* kind : {"F", "P"})
      if (const NamedColumn* column = table.find(fmt::format("{}_{}", kind, component_names[q])))
        components[q] = {*kind == 'P', Table(at, in_si(*column, *kind == 'P' ? "Pa" : "", problem))};
  if (!problem.empty()) s.error("table", problem, "write columns time [s], F_xx, P_yy [Pa], ...");
}

void LoadingConfig::check(Section& s) const {
  const MixedControl now = control(0, rest(), by_stress);
  if (volume == Volume::incompressible && std::none_of(now.by_stress.begin(), now.by_stress.end(), std::identity()))
    s.error("volume", "nothing is left free that could keep the volume", "choose volume = \"compressible\"");
  const bool held = program == Program::hold && drive.is_constant() && loading != Loading::components;
  if (held && end <= rise) s.error("end", "is not after the rise", "give a later end");
  if (program == Program::isotonic && end <= release) s.error("end", "is not after the release", "give a later end");
  if (!drive.is_constant() && s.has("program") && program != Program::isotonic)
    s.error("program", "the drive is a curve already", "give a constant drive, or no program");
  if (rise == 0 && program != Program::hold && drive.is_constant())
    s.error("rise", "no time to rise in", "give one above zero; only a hold may begin with a jump");
}

}  // namespace titin
