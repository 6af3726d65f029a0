/// An order of the elements or of the scheme, with the mesh and the step that it needs to stay within a tolerance.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/mesh_choice.hpp"
#include "scene/probe.hpp"
#include "solve/clock.hpp"

namespace titin {

struct Candidate {
  int order = 1;
  std::vector<std::string> overrides = {};  // that set the order; none: it is the scene's own
  MeshChoice mesh = {};
  double step = 0;  // [s]; 0: explicit, by stability
  double mesh_error = 0, step_error = 0, rate = 1;
  double cost = 0;  // [CPU s]
  double all() const { return mesh_error + step_error; }
};

/// What candidates are judged by: probes of a scene without what it can do without.
struct Trial {
  std::function<Probe(const std::vector<std::string>&)> run;  // a scene that cannot be had is a probe that failed
  std::function<void(const std::string&)> say;
  ClockConfig clock;
  std::vector<double> kinks;  // [s] of what drives it
  std::string order_key;      // "": it has no order
  int own_order = 1;
  MeshChoice mesh;                    // of the probes
  std::vector<std::string> taken;     // overrides: what was left out
  Probe asked, base;                  // as the scene asks; and with that left out
  double for_the_mesh, for_the_step;  // errors that each may have
  double dearest;                     // [CPU s] of a probe on a finer mesh, or with a shorter step
};

/// The scene's own order and the one below it, as far as their probes get to the end. Collective.
std::vector<Candidate> candidates(const Trial& trial);

/// CPU time of a run on a mesh with so many times the cells along every edge, over that on this one; steps by stability
/// get shorter with the cells.
double cost_of(double finer, std::size_t dimension, bool by_stability);

}  // namespace titin
