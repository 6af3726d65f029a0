#include "fv/exact_flow.hpp"
#include "fv/hugoniot.hpp"
#include "fv/piston.hpp"
#include "fv/radial_gas.hpp"
#include "fv/riemann.hpp"
#include "fv/sedov.hpp"
#include "fv/simple_wave.hpp"

namespace titin {
namespace {

using Flow = std::shared_ptr<const ExactFlow>;

constexpr Range above_one{.min = 1, .open_min = true};

Flow read_kidder(Section s, int dimension) {
  Kidder::Shell shell;
  s.read("inner_radius", shell.inner_radius, {.unit = "m", .range = positive, .doc = "of the shell at the start"});
  s.read("outer_radius", shell.outer_radius, {.unit = "m", .range = positive, .doc = "of the shell at the start"});
  s.read("inner_density", shell.inner_density, {.unit = "kg/m^3", .range = positive, .doc = "at the inner radius"});
  s.read("outer_density", shell.outer_density, {.unit = "kg/m^3", .range = positive, .doc = "at the outer radius"});
  s.read("entropy", shell.entropy, {.range = positive, .doc = "p / rho^gamma in SI units, gamma = 1 + 2 / dimension"});
  if (shell.inner_radius >= shell.outer_radius || shell.inner_density >= shell.outer_density) {
    s.error("", "the shell must be denser outside than inside",
            "take inner_radius < outer_radius and inner_density < outer_density");
    return nullptr;
  }
  return std::make_shared<Kidder>(shell, dimension);
}

void read_side(Section s, Riemann::Side& side) {
  s.read("density", side.density, {.unit = "kg/m^3", .range = positive, .doc = "of this side"});
  s.read("pressure", side.pressure, {.unit = "Pa", .range = any, .doc = "of this side"});
  s.read("velocity", side.velocity, {.unit = "m/s", .doc = "along x"});
  s.read("gamma", side.gamma, {.range = above_one, .doc = "of this side (default: that of both)"});
  s.read("covolume", side.covolume, {.unit = "m^3/kg", .range = non_negative, .doc = "of a Noble-Abel gas"});
  s.read("stiffening", side.stiffening, {.unit = "Pa", .range = non_negative, .doc = "of a stiffened gas"});
  if (s.describing()) return;
  if (side.pressure + side.stiffening <= 0)
    s.error("pressure", "is not above minus the stiffening", "give more pressure, or the stiffening of the fluid");
  if (side.covolume * side.density >= 1)
    s.error("covolume", "leaves the gas no room at this density", "take covolume < 1 / density");
}

Flow read_riemann(Section s) {
  Riemann::Side left{1, 1, 0}, right{0.125, 0.1, 0};
  double position = 0.5, gamma = 1.4;
  s.read("position", position, {.unit = "m", .doc = "x of the plane between the two sides"});
  s.read("gamma", gamma, {.range = above_one, .doc = "of the perfect gas on both sides"});
  left.gamma = right.gamma = gamma;
  read_side(s.section("left", "the state where x is less"), left);
  read_side(s.section("right", "the state where x is more"), right);
  return std::make_shared<Riemann>(left, right, position);
}

void read_gas(Section& s, double& density, double& pressure, double& gamma) {
  s.read("density", density, {.unit = "kg/m^3", .range = positive, .doc = "at the start"});
  s.read("pressure", pressure, {.unit = "Pa", .range = positive, .doc = "at the start"});
  s.read("gamma", gamma, {.range = above_one, .doc = "of the perfect gas"});
}

Flow read_noh(Section s, int dimension) {
  double density = 1, pressure = 1e-6, speed = 1, gamma = 5.0 / 3;
  read_gas(s, density, pressure, gamma);
  s.read("speed", speed, {.unit = "m/s", .range = positive, .doc = "towards the origin"});
  return std::make_shared<Noh>(density, pressure, speed, gamma, dimension);
}

Flow read_sedov(Section s, int dimension) {
  Sedov::Blast blast;
  read_gas(s, blast.density, blast.pressure, blast.gamma);
  s.read("energy", blast.energy,
         {.range = positive, .doc = "all around the origin in J (in the plane J/m), which [initial] must bring"});
  if (blast.gamma >= 2) {
    s.error("gamma", "the solution is known for gamma below 2 alone", "take less");
    return nullptr;
  }
  return std::make_shared<Sedov>(blast, dimension);
}

Flow read_explosion(Section s, int dimension) {
  Explosion::Setup setup;
  const auto read = [](Section side, Explosion::Side& to) {
    side.read("density", to.density, {.unit = "kg/m^3", .range = positive, .doc = "of this side"});
    side.read("pressure", to.pressure, {.unit = "Pa", .range = positive, .doc = "of this side"});
  };
  read(s.section("inside", "the ball, or the cylinder in the plane"), setup.inside);
  read(s.section("outside", "around it"), setup.outside);
  s.read("radius", setup.radius, {.unit = "m", .range = positive, .doc = "between them"});
  s.read("end", setup.end, {.unit = "m", .range = positive, .doc = "radius up to which the reference is computed"});
  s.read("gamma", setup.gamma, {.range = above_one, .doc = "of the perfect gas on both sides"});
  s.read("shells", setup.shells, {.range = {.min = 10, .max = 1e5}, .doc = "of the reference along the radius"});
  if (setup.end <= setup.radius) {
    s.error("end", "the reference ends inside the ball", "take end > radius");
    return nullptr;
  }
  return std::make_shared<Explosion>(setup, dimension);
}

Flow read_piston(Section s) {
  Piston::Setup setup;
  read_gas(s, setup.density, setup.pressure, setup.gamma);
  s.read("speed", setup.speed, {.unit = "m/s", .range = positive, .doc = "of the piston along x, from x = 0"});
  s.read("length", setup.length, {.unit = "m", .range = positive, .doc = "of the gas up to the wall"});
  return std::make_shared<Piston>(setup);
}

Flow read_hugoniot(Section s) {
  HugoniotShock::Setup setup;
  s.read("density", setup.density, {.unit = "kg/m^3", .range = positive, .doc = "at rest"});
  s.read("sound_speed", setup.sound_speed, {.unit = "m/s", .range = positive, .doc = "c0, at rest"});
  s.read("slope", setup.slope, {.range = non_negative, .doc = "s of the shock speed over the particle speed"});
  s.read("speed", setup.speed, {.unit = "m/s", .range = positive, .doc = "of the piston along x, from x = 0"});
  return std::make_shared<HugoniotShock>(setup);
}

Flow read_simple_wave(Section s) {
  SimpleWave::Setup setup;
  read_gas(s, setup.density, setup.pressure, setup.gamma);
  s.read("amplitude", setup.amplitude, {.unit = "m/s", .range = positive, .doc = "of the velocity"});
  s.read("centre", setup.centre, {.unit = "m", .doc = "x of its crest at the start"});
  s.read("width", setup.width, {.unit = "m", .range = positive, .doc = "along x"});
  return std::make_shared<SimpleWave>(setup);
}

enum class Solution { none, kidder, riemann, noh, sedov, explosion, piston, hugoniot, simple_wave };

}  // namespace

Flow ExactFlow::read(Section s, int dimension) {
  Solution solution = Solution::none;
  s.choose("solution", solution,
           {{"none", Solution::none},
            {"kidder", Solution::kidder},
            {"riemann", Solution::riemann},
            {"noh", Solution::noh},
            {"sedov", Solution::sedov},
            {"explosion", Solution::explosion},
            {"piston", Solution::piston},
            {"hugoniot", Solution::hugoniot},
            {"simple_wave", Solution::simple_wave}},
           {.doc = "a flow that is known: the start of the run and what its errors are against"});
  const bool all = s.describing();
  Flow flow;
  const auto take = [&](Solution which, const char* name, const char* doc, const auto& read) {
    if (all || solution == which) flow = read(s.section(name, doc));
  };
  const auto in_dimension = [&](Flow (*read)(Section, int)) {
    return [=](Section from) { return read(from, dimension); };
  };
  take(Solution::kidder, "kidder", "isentropic compression of a shell", in_dimension(read_kidder));
  take(Solution::riemann, "riemann", "two states of fluids beside a plane across x", read_riemann);
  take(Solution::noh, "noh", "implosion onto the origin", in_dimension(read_noh));
  take(Solution::sedov, "sedov", "a blast at the origin", in_dimension(read_sedov));
  take(Solution::explosion, "explosion", "a ball of gas, against a run along the radius alone",
       in_dimension(read_explosion));
  take(Solution::piston, "piston", "a piston and the reflections of its shock", read_piston);
  take(Solution::hugoniot, "hugoniot", "a piston's shock in a material whose shocks run with c0 + s u", read_hugoniot);
  take(Solution::simple_wave, "simple_wave", "a smooth wave along x until it breaks", read_simple_wave);
  return flow;
}

}  // namespace titin
