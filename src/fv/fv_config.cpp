#include "fv/fv_config.hpp"

namespace titin {
namespace {

/// What makes a cell of MOOD lose an order.
void read_detectors(Section& s, FvConfig& c) {
  s.read("principle_tolerance", c.principle_tolerance,
         {.range = non_negative,
          .doc = "how far density, mean stress and velocity of fluids, density of solids may leave the range of their "
                 "neighbours where the flow is not smooth, relative to rho, rho c^2, c"});
  s.read("smooth_jump", c.smooth_jump,
         {.range = non_negative,
          .doc = "a flow is smooth in a cell whose nodes differ from its linear velocity by less than this part of "
                 "their differences from its mean"});
  s.read("small_jump", c.small_jump, {.range = non_negative, .doc = "or by less than this part of the wave speed"});
  s.read(
      "shock_jump", c.shock_jump,
      {.range = positive,
       .doc = "a fluid is shocked, and loses its slopes, in a cell that shrinks while its nodes differ from its mean "
              "velocity by more than this part of the wave speed"});
  s.read("rest", c.rest,
         {.range = non_negative,
          .doc = "a fluid's cell that has lost its slopes in a shock faster than sound stays without them while a wave "
                 "crosses it this many times"});
  s.read("heat_tolerance", c.heat_tolerance,
         {.range = non_negative,
          .doc = "a solid's cell whose heat falls, and is below minus this part of its stored energy and of the motion "
                 "within it, loses an order: it would take motion out of nothing"});
  s.read("range_tolerance", c.range_tolerance,
         {.range = non_negative, .doc = "the same, relative to that range; the larger of both holds"});
}

}  // namespace

void FvConfig::bind(Section& s) {
  s.read("order", order, {.range = {.min = 1, .max = 2}, .doc = "of the scheme in space and time"});
  s.choose("predictor", predictor,
           {{"hancock", Predictor::hancock}, {"ader", Predictor::ader}, {"rk2", Predictor::rk2}},
           {.doc = "how cells get to the middle of a step: one Taylor step, the local space-time solution, or a half "
                   "step of the whole scheme"});
  s.choose("limiter", limiter,
           {{"mood", Limiter::mood}, {"barth_jespersen", Limiter::barth_jespersen}, {"none", Limiter::none}},
           {.doc = "mood: where a step has failed, again with limited slopes, then without; barth_jespersen: limited "
                   "slopes everywhere; none: slopes as they are"});
  s.choose("cascade", cascade, {{"limited", Cascade::limited}, {"constant", Cascade::constant}},
           {.doc = "what a cell of mood falls to first: limited slopes, then constant; or constant at once"});
  s.read("cfl", cfl,
         {.range = {.min = 0, .max = 1, .open_min = true},
          .doc = "part of the time that the fastest wave takes through a cell's inner ball"});
  s.read(
      "volume_change", volume_change,
      {.range = {.min = 0, .max = 0.5, .open_min = true}, .doc = "part of a cell's volume that one step may change"});
  s.read("growth", growth, {.range = positive, .doc = "how much longer than the last a step may be"});
  s.read(
      "first_step", first_step,
      {.range = {.min = 0, .max = 1, .open_min = true}, .doc = "part of the acoustic step that the first one takes"});
  s.read(
      "patch_pressure", patch_pressure,
      {.doc =
           "solids take their pressure from the volumes of the patches of cells about their nodes, of each region by "
           "itself: for nearly incompressible ones, which are else too stiff"});
  s.read("impedance", impedance,
         {.range = {.min = 0.5, .max = 4}, .doc = "factor of density times wave speed in the nodal solver"});
  s.read("shock_impedance", shock_impedance,
         {.range = {.min = 0, .max = 4},
          .doc = "s of the shock speed c + s |dv| that stands for the wave speed where the velocity jumps by dv at a "
                 "node: without it cold cells do not resist a strong shock; (gamma + 1) / 2 of a perfect gas"});
  read_detectors(s, *this);
  s.read("collapse", collapse,
         {.range = {.min = 0, .max = 0.1},
          .doc = "the run ends, and says where, when cells allow steps of no more than this part of the longest one so "
                 "far: a cell has collapsed, and steps would get shorter without end"});
}

}  // namespace titin
